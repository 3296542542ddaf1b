"""Signals that profiles stand for: a step, a smooth way, a chirp.

The smooth way is the polynomial of degree five whose rate and acceleration vanish at both ends, as robots are driven.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import Polynomial
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

_WAY = Polynomial([0.0, 0.0, 0.0, 10.0, -15.0, 6.0])
_RATE, _ACCELERATION = _WAY.deriv(), _WAY.deriv(2)


@dataclass(frozen=True)
class Step:
    """One value before an instant, another from then on.

    Parameters
    ----------
    before, after : float
        In the unit of the input.
    instant : float
        s.
    """

    before: float
    after: float
    instant: float = 0.0

    @property
    def knots(self) -> Array:
        """The instant."""
        return np.array([self.instant])

    @property
    def ends(self) -> float:
        """The instant."""
        return self.instant

    def at(self, time: ArrayLike) -> Array:
        """Return the values at instants."""
        return np.where(np.asarray(time, float) < self.instant, self.before, self.after)

    def slope(self, time: ArrayLike) -> Array:
        """Return zeros: all of it is in the jump."""
        return np.zeros(np.shape(time))

    def curvature(self, time: ArrayLike) -> Array:
        """Return zeros: all of it is in the jump."""
        return np.zeros(np.shape(time))


@dataclass(frozen=True)
class Smooth:
    """From one value to another by a polynomial of degree five, at rest at both ends.

    Parameters
    ----------
    before, after : float
        In the unit of the input.
    duration, start : float
        Of the way, s.
    """

    before: float
    after: float
    duration: float
    start: float = 0.0

    @property
    def knots(self) -> Array:
        """Begin and end of the way, s."""
        return np.array([self.start, self.ends])

    @property
    def ends(self) -> float:
        """End of the way, s."""
        return self.start + self.duration

    def at(self, time: ArrayLike) -> Array:
        """Return the values at instants."""
        share = self._share(time)
        # exact at both ends
        return np.where(share < 1.0, self.before + (self.after - self.before) * _WAY(share), self.after)

    def slope(self, time: ArrayLike) -> Array:
        """Return the first derivatives at instants."""
        slopes: Array = (self.after - self.before) / self.duration * _RATE(self._share(time))
        return slopes

    def curvature(self, time: ArrayLike) -> Array:
        """Return the second derivatives at instants."""
        curvatures: Array = (self.after - self.before) / self.duration**2 * _ACCELERATION(self._share(time))
        return curvatures

    def _share(self, time: ArrayLike) -> Array:
        share: Array = np.clip((np.asarray(time, float) - self.start) / self.duration, 0.0, 1.0)
        return share


@dataclass(frozen=True)
class Chirp:
    """A sine whose frequency goes straight from one value to another, and stays there.

    Parameters
    ----------
    amplitude : float
        In the unit of the input.
    first, last : float
        Frequencies, Hz.
    duration : float
        From the first to the last, s.
    """

    amplitude: float
    first: float
    last: float
    duration: float

    @property
    def knots(self) -> Array:
        """Where the last frequency is reached, s."""
        return np.array([self.duration])

    @property
    def ends(self) -> float:
        """It never does."""
        return math.inf

    def at(self, time: ArrayLike) -> Array:
        """Return the values at instants."""
        values: Array = self.amplitude * np.sin(self._phase(time)[0])
        return values

    def slope(self, time: ArrayLike) -> Array:
        """Return the first derivatives at instants."""
        phase, rate, _ = self._phase(time)
        slopes: Array = self.amplitude * rate * np.cos(phase)
        return slopes

    def curvature(self, time: ArrayLike) -> Array:
        """Return the second derivatives at instants."""
        phase, rate, growth = self._phase(time)
        curvatures: Array = self.amplitude * (growth * np.cos(phase) - rate**2 * np.sin(phase))
        return curvatures

    def _phase(self, time: ArrayLike) -> tuple[Array, Array, Array]:
        """Return the phase and its derivatives, rad, rad/s, rad/s^2."""
        now = np.asarray(time, float)
        sweeping = np.minimum(now, self.duration)
        growth = (self.last - self.first) / self.duration
        turns = (self.first + 0.5 * growth * sweeping) * sweeping + self.last * (now - sweeping)
        each = 2.0 * math.pi
        return (
            each * turns,
            each * (self.first + growth * sweeping),
            each * np.where(now < self.duration, growth, 0.0),
        )
