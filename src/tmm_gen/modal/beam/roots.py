"""All natural frequencies of an arm of beams: bracketed by bisection of their count, refined by Newton."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.beam.arm import BeamArm
from tmm_gen.modal.beam.conditions import refine
from tmm_gen.modal.beam.counting import modes_below, rigid_motions

Array = NDArray[np.float64]

_SMALLEST = 1e-6
"""Of the lowest unit frequency: where the search for the lowest frequency begins, downward if need be."""

_BISECTIONS = 120
_WIDTH = 1e-9
"""Relative width of the final bracket: next to a pole of the dynamic stiffness the count is no finer."""

_DOUBLINGS = 200

_LEAST = 1e-60
"""Of the upper end of the search: its square must stay a number."""


def natural_frequencies(arm: BeamArm, count: int) -> Array:
    """Return the lowest undamped natural frequencies, rigid-body motions (zero) among them.

    Parameters
    ----------
    arm : BeamArm
        Its damping is left out.
    count : int
        How many.

    Returns
    -------
    array, (count,)
        rad/s, increasing; multiple ones as often as they occur.
    """
    high = 10.0 * max(member.unit_frequency for member in arm.members)
    for _ in range(_DOUBLINGS):
        if modes_below(arm, high)[0] >= count:
            break
        high *= 2.0
    else:
        raise ArithmeticError(f"fewer than {count} natural frequencies below {high:g} rad/s")
    return _bisect(arm, count, high)


def frequencies_below(arm: BeamArm, limit: float) -> Array:
    """Return all undamped natural frequencies below a limit (rad/s), increasing, none missed."""
    count = int(modes_below(arm, limit)[0])
    if count == 0:
        return np.zeros(0)
    return _bisect(arm, count, limit)


def _below_all(arm: BeamArm, high: float) -> float:
    """Return a frequency below all but those of rigid-body motions: a soft joint's may be tiny."""
    low = min(_SMALLEST * min(member.unit_frequency for member in arm.members), high / 2.0)
    rigid = rigid_motions(arm)
    while modes_below(arm, low)[0] > rigid:
        low *= _SMALLEST
        if low < _LEAST * high:
            raise ArithmeticError(f"a natural frequency below {low:g} rad/s cannot be told from none")
    return low


def _bisect(arm: BeamArm, count: int, high: float) -> Array:
    """Bisect for all modes at once: the k-th lies where the count goes from below k to k."""
    arm = arm.undamped()
    rigid = min(rigid_motions(arm), count)
    numbers = np.arange(rigid + 1, count + 1)
    if not len(numbers):
        return np.zeros(count)
    below, above = np.full(len(numbers), _below_all(arm, high)), np.full(len(numbers), high)
    # geometric: frequencies of an arm span many decades
    for _ in range(_BISECTIONS):
        wide = above > 2.0 * below
        middle = np.where(wide, np.sqrt(below * above), 0.5 * (below + above))
        reached = modes_below(arm, middle) >= numbers
        above = np.where(reached, middle, above)
        below = np.where(reached, below, middle)
        if np.all(above - below <= _WIDTH * above):
            break
    return np.concatenate(
        [np.zeros(rigid), [_refined(arm, 0.5 * float(w + v)) for w, v in zip(below, above, strict=True)]]
    )


def _refined(arm: BeamArm, omega: float) -> float:
    """Return the root at a bracketed frequency; a neighbour's is not taken for it."""
    root = refine(arm, 1j * omega)
    return float(root.imag) if abs(root - 1j * omega) <= 10.0 * _WIDTH * omega else omega
