"""How a controller without a model goes from where it starts to its goal: hubs and torques, sample by sample."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Way:
    """Of the m hubs over k samples; what comes after the last is the last again.

    Parameters
    ----------
    share : array, (k, m)
        Of the way that is to be gone, from 0 to 1.
    speed : array, (k, m)
        How fast that grows, 1/s.
    torque : array, (k, m)
        That is to be given at once, N m.
    """

    share: Array
    speed: Array
    torque: Array

    def at(self, sample: int) -> tuple[Array, Array, Array]:
        """Return share, speed and torque of a sample, (m,) each."""
        place = min(sample, len(self.share) - 1)
        return self.share[place], self.speed[place], self.torque[place]


def stepped_way(torque: Array, shapers: Sequence[Array] | None = None) -> Way:
    """Return the way of a step, or of one convolved with impulses.

    Parameters
    ----------
    torque : array, (m,)
        That holds the arm at the goal, N m; given throughout.
    shapers : sequence of array, (k,), optional
        For each motor impulses, one per sample, whose sum is 1.
    """
    every = [np.cumsum(each) for each in shapers or [np.ones(1)] * len(torque)]
    count = max(map(len, every))
    share = np.column_stack([np.pad(each, (0, count - len(each)), "edge") for each in every])
    return Way(share, np.zeros_like(share), np.tile(torque, (count, 1)))
