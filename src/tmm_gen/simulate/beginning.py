"""What much shorter steps make of a run's beginning, where modes may ring that neither its own nor longer ones follow.

A blow at the start, such as a spin that stretches an arm at once, rings in fast modes until they are damped. What steps
make of that leaves a wrong speed for good: a drift, which no comparison with steps of twice the length need show.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.simulate.displacement import lengths
from tmm_gen.simulate.repetition import Again, Repetition

Array = NDArray[np.float64]

_FIRST, _FINER = 20, 16
"""Steps at the start that are taken again, and how many times shorter."""

_PART, _SHORTER = 16, 4
"""Share of the run whose beginning it is, one in so many, and how many times shorter its steps are taken then: both
together cost a quarter of the run."""

_INSTANTS = 8
"""In the beginning, at least: two in each of its quarters."""


def begun(again: Repetition) -> float:
    """Return the error that grows from what the first few steps make of the start, as a share of the motion.

    How fast the motion parts from one with steps sixteen times shorter is taken to last.
    """
    if again.trace.every > 1 or again.course.steps < 2 * _FIRST:
        return 0.0
    fine = again(1.0 / _FINER, every=1, steps=_FIRST)
    if fine is None:
        return 0.0
    mine, others = again.beside(fine)
    apart = (mine - others)[:, 1:]
    half = _FIRST // 2
    drift = (np.mean(apart[:, half:], axis=1) - np.mean(apart[:, :half], axis=1)) / half
    return float(np.max(lengths(drift))) * again.course.steps / again.way


def lasting(again: Repetition, other: Again, share: float) -> float:
    """Return the error that grows from a drift which much shorter steps show at first, as a share of the motion.

    Parameters
    ----------
    again : Repetition
        Of the run.
    other : Again
        The motion by which the run was judged.
    share : float
        How much at most of the difference from that is the run's error by the order of the integrator. What of the
        drift this explains is known already, and does not count.
    """
    every, steps = other.every, again.course.steps
    count = max(_INSTANTS, steps // _PART // every) // 4 * 4
    if 2 * count * every > steps:
        return 0.0
    fine = again(1.0 / _SHORTER, every=every, steps=count * every)
    if fine is None:
        return 0.0
    mine, others = again.beside(fine)
    drift = _late_drift(mine - others)
    mine, others = (places[:, : count + 1] for places in again.beside(other))
    known = _late_drift(others - mine)
    size = float(np.sum(known**2))
    explained = 0.0 if size == 0.0 else float(np.sum(drift * known)) / size
    explained = float(np.clip(explained, min(0.0, share), max(0.0, share)))
    left = drift - explained * known
    return float(np.max(lengths(left))) * steps / every / again.way


def _late_drift(apart: Array) -> Array:
    """Return how fast two motions part from an instant to the next, (d, p), when the beginning is nearly over.

    By means over its last two quarters, (d, k + 1, p) with the start: vibrations do not count.
    """
    quarter = (apart.shape[1] - 1) // 4
    third, last = apart[:, -2 * quarter : -quarter], apart[:, -quarter:]
    found: Array = (np.mean(last, axis=1) - np.mean(third, axis=1)) / quarter
    return found
