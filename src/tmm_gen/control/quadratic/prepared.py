"""What real-time iterations prepare of a sample before its measurement."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.quadratic.condensed import Condensed

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Prepared:
    """What a sample's quadratic program needs, before its measurement.

    Parameters
    ----------
    estimate : array, (s + m,)
        State and disturbances that the motion below starts from, before the look over the delay.
    read : tuple of int
        Which sensors besides the encoders were read in the sample before.
    along : array, (4 m N + r + w N,)
        Outputs along the last plan, stacked as :func:`~tmm_gen.control.quadratic.response.split_outputs` has them.
    by_estimate : array, (4 m N + r + w N, s + m)
        What changes of the estimate make of them.
    condensed : Condensed
        With the sensitivities by the torques.
    """

    estimate: Array
    read: tuple[int, ...]
    along: Array
    by_estimate: Array
    condensed: Condensed
