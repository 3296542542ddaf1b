"""Rate and acceleration of a prescribed base of which a function of time tells the angle alone."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from tmm_gen.program.inputs import prescribed_names
from tmm_gen.program.statements import Program

_CENTRAL = {1: (1.0, -8.0, 0.0, 8.0, -1.0), 2: (-1.0, 16.0, -30.0, 16.0, -1.0)}
_FORWARD = {1: (-25.0, 48.0, -36.0, 16.0, -3.0), 2: (35.0, -104.0, 114.0, -56.0, 11.0)}
"""Weights of differences of fourth order (Fornberg 1988, Math. Comp. 51), times 12."""


def with_derivatives(program: Program, signals: Mapping[str, Any], step: float) -> dict[str, Any]:
    """Return signals, with rate and acceleration of what is prescribed by a function, where they are absent.

    Parameters
    ----------
    program : Program
        Whose inputs are meant.
    signals : mapping from str
        Constants or functions of time.
    step : float
        s; differences are taken over quarters of it.
    """
    found = dict(signals)  # derivatives stand behind: what is wrong with a function is said of it
    for names in prescribed_names(program.inputs):
        if callable(told := signals.get(names[0])):
            for order, name in enumerate(names[1:], start=1):
                found.setdefault(name, _difference(told, order, 0.25 * step))
    return found


def _difference(angle: Callable[[Any], Any], order: int, apart: float) -> Callable[[Any], Any]:
    def derivative(time: Any) -> Any:
        inside = np.asarray(time) >= 2.0 * apart  # at time zero look forward only
        first = time - 2.0 * apart * inside
        weights = zip(_CENTRAL[order], _FORWARD[order], strict=True)
        values = (np.where(inside, *pair) * angle(first + k * apart) for k, pair in enumerate(weights))
        return sum(values) / (12.0 * apart**order)

    return derivative
