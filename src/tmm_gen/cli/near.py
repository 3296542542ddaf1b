"""Choosing an equilibrium on the command line: ``--near JOINT=ANGLE``."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import click

from tmm_gen.errors import UserError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from tmm_gen.scene import Scene

near_option = click.option(
    "--near",
    "near",
    metavar="JOINT=ANGLE",
    multiple=True,
    help="Take the equilibrium near this angle of a joint, in rad, stable or not. Repeatable; the rest is [initial].",
)
"""The option; gives a command the argument ``near``."""

_MOST = 1000.0
"""rad; after so many turns nothing is near."""

FROM_START = "the start"
"""Where a search begins without it."""


def start_of(scene: Scene, near: Sequence[str]) -> NDArray[np.float64] | None:
    """Return the free angles from where an equilibrium is looked for; None where nothing is asked for.

    Raises
    ------
    UserError
        If a word is not ``JOINT=ANGLE``, names no joint, or the scene is a chain.
    """
    if not near:
        return None
    if scene.model.linear:
        raise UserError(
            f"--near {near[0]}: a chain is linear, its motion is the same about any rest. Leave it out."
        )
    from tmm_gen.modal.near import start_near

    angles: dict[str, float] = {}
    for text in near:
        name, _, value = text.partition("=")
        try:
            angles[name.strip()] = float(value)
        except ValueError:
            angles[name.strip()] = math.nan
        if not abs(angles[name.strip()]) <= _MOST:  # no number is not either
            raise UserError(
                f"--near {text}: write JOINT=ANGLE, the angle in rad, at most {_MOST:g}; for example --near elbow=0.5."
            )
    return start_near(scene, angles)
