"""A smooth way from zero to a value, for a base that is moved."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import Polynomial
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

SMOOTH = 6
"""Derivatives that are continuous at both ends: more than any integrator of ours can see."""


def _way() -> Polynomial:
    """Return the odd polynomial from -1/2 to 1/2 on [-1/2, 1/2] whose first `SMOOTH` derivatives vanish at the ends."""
    u = Polynomial([0.0, 1.0])
    way = ((0.25 - u**2) ** SMOOTH).integ()
    return way / (2.0 * way(0.5))


_WAY = 0.5 + _way()


@dataclass(frozen=True)
class Rise:
    """From 0 to an amplitude, then constant.

    Parameters
    ----------
    amplitude : float
        In the unit of the input.
    duration : float
        s.
    """

    amplitude: float
    duration: float

    @property
    def knots(self) -> Array:
        """Begin and end of the rise, s."""
        return np.array([0.0, self.duration])

    @property
    def ends(self) -> float:
        """End of the rise, s."""
        return self.duration

    def way(self, order: int) -> Polynomial:
        """Return the way, or its derivative of an order, by how far on it is: -1/2 before it begins, 1/2 at its end."""
        return self.amplitude / self.duration**order * (_WAY.deriv(order) if order else _WAY)

    def at(self, time: ArrayLike) -> Array:
        """Return the values at instants."""
        values: Array = self.way(0)(self._share(time))
        return values

    def slope(self, time: ArrayLike) -> Array:
        """Return the rates at instants."""
        slopes: Array = self.way(1)(self._share(time))
        return slopes

    def curvature(self, time: ArrayLike) -> Array:
        """Return the accelerations at instants."""
        curvatures: Array = self.way(2)(self._share(time))
        return curvatures

    def _share(self, time: ArrayLike) -> Array:
        """Return how far on the way it is, from -1/2 to 1/2."""
        share: Array = np.clip(np.asarray(time, float) / self.duration, 0.0, 1.0) - 0.5
        return share
