"""Comparisons of motions that may not last."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from tmm_gen.errors import CheckFailed
from tmm_gen.scene import Scene
from tmm_gen.simulate.divergence import BrokenOffError
from tmm_gen.verify.check_row import CheckRow
from tmm_gen.verify.lasting import broken_off

BREAKS = (CheckFailed, BrokenOffError, ArithmeticError, np.linalg.LinAlgError)
"""What ends a motion that does not last."""


def unless_broken(scene: Scene, check: str, bound: float, compare: Callable[[], CheckRow]) -> CheckRow:
    """Return a comparison, or why it broke off.

    Parameters
    ----------
    scene : Scene
        What moves.
    check : str
        The comparison's name.
    bound : float
        Its own.
    compare : callable
        Makes it; may end in one of `BREAKS`.
    """
    try:
        return compare()
    except BREAKS as error:
        return CheckRow(check, math.inf, bound, "broke off", broken_off(scene, error))
