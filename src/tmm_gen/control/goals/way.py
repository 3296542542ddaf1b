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
    absolute : bool
        Whether shares and speeds are the hubs' own angles and rates, rad and rad/s, wherever it starts.
    """

    share: Array
    speed: Array
    torque: Array
    absolute: bool = False

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


def shaped_way(angles: Array, rates: Array, torque: Array, shapers: Sequence[Array] | None = None) -> Way:
    """Return the way along a course, or along one convolved with impulses.

    Parameters
    ----------
    angles, rates : array, (k, m)
        Of the hubs, rad and rad/s.
    torque : array, (k, m)
        To be given along it, N m.
    shapers : sequence of array, (j,), optional
        For each motor impulses, one per sample, whose sum is 1.
    """
    if shapers is None:
        return Way(angles, rates, torque, absolute=True)
    longest = max(map(len, shapers)) - 1

    def shaped(values: Array) -> Array:
        padded = np.pad(values, ((longest, longest), (0, 0)), "edge")
        columns = [np.convolve(column, each) for column, each in zip(padded.T, shapers, strict=True)]
        return np.column_stack([column[longest : longest + len(values) + longest] for column in columns])

    return Way(shaped(angles), shaped(rates), shaped(torque), absolute=True)
