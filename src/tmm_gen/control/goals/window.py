"""A reference that moves, as far ahead as a controller looks: joint angles of the samples to come."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Window:
    """Motion of the hubs over N samples, the first a sample after the measurement that comes.

    Parameters
    ----------
    motion : array, (3, N, m)
        Angles, rates and accelerations: rad, rad/s, rad/s^2.
    """

    motion: Array

    @classmethod
    def of(cls, angles: Array, sample_time: float) -> Window:
        """Return the window of joint angles, (N, m), rad: rates and accelerations are their differences.

        Central ones; at both ends rates are those of the parabola through the three angles there.
        """
        rates, growth = np.zeros_like(angles), np.zeros_like(angles)
        if len(angles) == 2:
            rates[:] = (angles[1] - angles[0]) / sample_time
        elif len(angles) > 2:
            rates[1:-1] = (angles[2:] - angles[:-2]) / (2.0 * sample_time)
            rates[0] = (4.0 * angles[1] - 3.0 * angles[0] - angles[2]) / (2.0 * sample_time)
            rates[-1] = (3.0 * angles[-1] - 4.0 * angles[-2] + angles[-3]) / (2.0 * sample_time)
            growth[1:-1] = (angles[2:] - 2.0 * angles[1:-1] + angles[:-2]) / sample_time**2
            growth[0], growth[-1] = growth[1], growth[-2]
        return cls(np.stack([angles, rates, growth]))

    @property
    def count(self) -> int:
        """N."""
        return int(self.motion.shape[1])

    def at(self, sample: int) -> Array:
        """Return the motion at one of the samples, (3, m): behind the last it rests there."""
        if sample < self.count:
            return self.motion[:, sample]
        still = np.zeros_like(self.motion[:, 0])
        still[0] = self.motion[0, -1]
        return still

    def before(self, sample_time: float) -> Array:
        """Return the motion a sample before the first, (3, m), as if it were evenly accelerated."""
        angle, rate, growth = self.motion[:, 0]
        earlier = angle - sample_time * rate + 0.5 * sample_time**2 * growth
        return np.stack([earlier, rate - sample_time * growth, growth])
