"""By what closed loops are judged: settling, overshoot, residual vibration."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.closed_loop.loop import Loop
from tmm_gen.simulate.metrics import settled_from

Array = NDArray[np.float64]

BAND = 0.005
"""Half-width of the band all tips have to stay in, relative to the longest of their ways; see :func:`way_of`."""
STILL = 1e-6
"""Ways no longer than this are none, rad: encoders do not tell, and rests are found up to rounding."""
RESIDUAL_FROM = 1.0
"""Instant from which the tips' peak-to-peak motion counts as residual vibration, s."""


@dataclass(frozen=True)
class Figures:
    """Of one closed loop; of several tips, those of the worst.

    Parameters
    ----------
    settling : float or None
        From then on all tips stay within `BAND`, s; None if they do not, or if none has anywhere to go.
    overshoot : float or None
        By how much a tip passes its reference, or one that is to stay leaves it, relative to the longest way; None if
        none has anywhere to go.
    residual : float
        Peak to peak of a tip from `RESIDUAL_FROM` on, rad.
    offset : float
        Mean of a tip less its reference over the last fifth of that time, rad.
    fallbacks : int
        Samples whose status was not OK.
    """

    settling: float | None
    overshoot: float | None
    residual: float
    offset: float
    fallbacks: int


def way_of(loop: Loop) -> float:
    """Return the longest way of a tip, rad, which deviations are relative to; 0 if all start where they are to be."""
    longest = float(np.max(np.abs(loop.goal - loop.tip[0])))
    return longest if longest > STILL else 0.0


def loop_figures(loop: Loop, after: float = RESIDUAL_FROM) -> Figures:
    """Return the figures of a closed loop; see :class:`Figures`. Vibration counts from an instant, s."""
    way, worst = way_of(loop), np.max(np.abs(loop.tip - loop.goal), axis=1)
    late = loop.tip[loop.time >= min(after, 0.5 * float(loop.time[-1])) - 1e-9]
    offsets = np.mean(late[-max(1, len(late) // 5) :], axis=0) - loop.goal
    return Figures(
        settling=settled_from(loop.time, worst, BAND * way) if way else None,
        overshoot=float(np.max(_passed(loop, BAND * way))) / way if way else None,
        residual=float(np.max(np.ptp(late, axis=0))),
        offset=float(max(offsets, key=abs)),
        fallbacks=loop.fallbacks,
    )


def _passed(loop: Loop, band: float) -> Array:
    """Return how far each tip passes its reference, (m,), rad: one that is to stay does so to either side."""
    way = loop.goal - loop.tip[0]
    beyond = (loop.tip - loop.goal) * np.sign(way)
    passed = np.where(np.abs(way) > band, beyond, np.abs(loop.tip - loop.goal))
    return np.asarray(np.maximum(0.0, np.max(passed, axis=0)), float)
