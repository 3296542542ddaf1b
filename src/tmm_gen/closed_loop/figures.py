"""By what closed loops are judged: settling, overshoot, residual vibration."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.closed_loop.loop import Loop
from tmm_gen.simulate.metrics import step_figures

Array = NDArray[np.float64]

BAND = 0.005
"""Half-width of the band all tips have to stay in, relative to the longest of their ways."""
RESIDUAL_FROM = 1.0
"""Instant from which the tips' peak-to-peak motion counts as residual vibration, s."""


@dataclass(frozen=True)
class Figures:
    """Of one closed loop; of several tips, those of the worst.

    Parameters
    ----------
    settling : float or None
        From then on all tips stay within `BAND`, s; None if they do not.
    overshoot : float
        By how much a tip passes its reference, relative to the longest way.
    residual : float
        Peak to peak of a tip from `RESIDUAL_FROM` on, rad.
    offset : float
        Mean of a tip less its reference over the last fifth of that time, rad.
    fallbacks : int
        Samples whose status was not OK.
    """

    settling: float | None
    overshoot: float
    residual: float
    offset: float
    fallbacks: int


def loop_figures(loop: Loop, after: float = RESIDUAL_FROM) -> Figures:
    """Return the figures of a closed loop; see :class:`Figures`. Vibration counts from an instant, s."""
    longest = float(np.max(np.abs(loop.goal - loop.tip[0])))
    every = [
        _figures(loop, tip, float(goal), longest, after)
        for tip, goal in zip(loop.tip.T, loop.goal, strict=True)
    ]
    settling = [figures.settling for figures in every if figures.settling is not None]
    return Figures(
        settling=max(settling) if len(settling) == len(every) else None,
        overshoot=max(figures.overshoot for figures in every),
        residual=max(figures.residual for figures in every),
        offset=max((figures.offset for figures in every), key=abs),
        fallbacks=loop.fallbacks,
    )


def _figures(loop: Loop, tip: Array, goal: float, longest: float, after: float) -> Figures:
    own = abs(goal - float(tip[0]))
    figures = step_figures(loop.time, tip, goal, BAND * longest / own if own else BAND)
    late = tip[loop.time >= min(after, 0.5 * float(loop.time[-1])) - 1e-9]
    last = late[-max(1, len(late) // 5) :]
    return Figures(
        settling=figures.settling_time,
        overshoot=figures.overshoot * own / longest if longest else 0.0,
        residual=float(np.ptp(late)),
        offset=float(np.mean(last)) - goal,
        fallbacks=0,
    )
