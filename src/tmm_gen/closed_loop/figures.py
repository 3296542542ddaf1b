"""By what closed loops are judged: settling, overshoot, residual vibration."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tmm_gen.closed_loop.loop import Loop
from tmm_gen.simulate.metrics import step_figures

BAND = 0.005
"""Half-width of the band the tip has to stay in, relative to its way."""
RESIDUAL_FROM = 1.0
"""Instant from which the tip's peak-to-peak motion counts as residual vibration, s."""


@dataclass(frozen=True)
class Figures:
    """Of one closed loop.

    Parameters
    ----------
    settling : float or None
        From then on the tip stays within `BAND`, s; None if it does not.
    overshoot : float
        By how much the tip passes the reference, relative to its way.
    residual : float
        Peak to peak of the tip from `RESIDUAL_FROM` on, rad.
    offset : float
        Mean of the tip less the reference over the last fifth of that time, rad.
    fallbacks : int
        Samples whose status was not OK.
    """

    settling: float | None
    overshoot: float
    residual: float
    offset: float
    fallbacks: int


def loop_figures(loop: Loop, reference: float) -> Figures:
    """Return the figures of a closed loop; see :class:`Figures`."""
    figures = step_figures(loop.time, loop.tip, reference, BAND)
    late = loop.tip[loop.time >= min(RESIDUAL_FROM, 0.5 * float(loop.time[-1])) - 1e-9]
    last = late[-max(1, len(late) // 5) :]
    return Figures(
        settling=figures.settling_time,
        overshoot=figures.overshoot,
        residual=float(np.ptp(late)),
        offset=float(np.mean(last)) - reference,
        fallbacks=loop.fallbacks,
    )
