"""The order by which errors fall, fitted where it shows: with steps so short that one slope is like the next."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

from tmm_gen.simulate.metrics import convergence_slope
from tmm_gen.verify.check_row import SLOPE
from tmm_gen.verify.unbroken import BREAKS

_FEWEST = 8
"""Steps: with fewer no order is looked for."""
_HALVINGS = 4
"""How often steps are halved at most, to find where the order shows."""
_WINDOW = 3
"""Errors that are fitted: two slopes."""


@dataclass(frozen=True)
class Asymptotic:
    """An order of convergence.

    Parameters
    ----------
    order : float
        Errors go with ``step**order``.
    counts : tuple of int
        Numbers of steps by which it was fitted.
    """

    order: float
    counts: tuple[int, ...]


def asymptotic_order(
    error: Callable[[int], float],
    counts: Sequence[int],
    holds: Callable[[float], bool],
    rounded: float,
    small: float = math.inf,
) -> Asymptotic:
    """Fit the order on steps short enough to show it and long enough not to show rounding.

    Steps are halved until both slopes between the last three errors hold, or have stayed what they are, or the next
    error would be one of rounding. A method of another order than the derived one shows that with short steps too.

    Parameters
    ----------
    error : callable
        From a number of steps to its error.
    counts : sequence of int
        To begin with, each twice the one before; three at least.
    holds : callable
        Whether a slope is what is expected.
    rounded : float
        Errors below this are of rounding: coarser steps are fitted.
    small : float
        Of errors larger than this the order says nothing yet.

    Raises
    ------
    ArithmeticError
        If the motion breaks off at the shortest steps too.
    """

    def off(steps: int) -> float:
        try:
            return error(steps)
        except BREAKS:  # too long a step
            return math.inf

    tried, errors = list(counts), [off(steps) for steps in counts]
    while errors[-1] < rounded and tried[0] > _FEWEST:
        tried, errors = [tried[0] // 2, *tried[:-1]], [off(tried[0] // 2), *errors[:-1]]
    for _ in range(_HALVINGS):
        slopes = _slopes(errors, small)
        if all(math.isfinite(slope) and holds(slope) for slope in slopes[1 - _WINDOW :]) or _settled(
            slopes[-_WINDOW:]
        ):
            break
        finer = off(2 * tried[-1])
        if finer < rounded:
            break
        tried, errors = [*tried, 2 * tried[-1]], [*errors, finer]
    shown = tuple(tried[-_WINDOW:])
    if math.inf in errors[-_WINDOW:]:
        error(shown[errors[-_WINDOW:].index(math.inf)])  # says why it breaks off
    return Asymptotic(convergence_slope([1.0 / steps for steps in shown], errors[-_WINDOW:]).order, shown)


def _slopes(errors: Sequence[float], small: float) -> list[float]:
    """Return the slopes from each error to the next; no number where one is too large to tell, or none."""
    return [
        math.log2(coarse / fine) if fine > 0.0 and coarse <= small and math.isfinite(coarse) else math.nan
        for coarse, fine in pairwise(errors)
    ]


def _settled(slopes: Sequence[float]) -> bool:
    """Whether slopes have become one, whatever it is."""
    return all(map(math.isfinite, slopes)) and max(slopes) - min(slopes) <= 0.5 * SLOPE
