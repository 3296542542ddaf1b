"""Inputs as functions of time: constant, harmonic, or a table that is linear in between.

Each consists of pieces on which ``u'' = -w^2 u``, so that a reference solution can carry the input
along as part of a linear system and be exact.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


class Signal(Protocol):
    """An input over time."""

    @property
    def knots(self) -> Array:
        """Instants at which a new piece begins, s, increasing."""

    @property
    def frequency(self) -> float:
        """Angular frequency ``w`` of all pieces, rad/s."""

    def at(self, time: ArrayLike) -> Array:
        """Return the values at instants, of the same shape."""

    def slope(self, time: float) -> float:
        """Return the rate at an instant; at a knot, that of the piece which begins there."""


@dataclass(frozen=True)
class Constant:
    """The same value at all times.

    Parameters
    ----------
    value : float
        In the unit of the input.
    """

    value: float
    frequency: float = 0.0

    @property
    def knots(self) -> Array:
        """None."""
        return np.zeros(0)

    def at(self, time: ArrayLike) -> Array:
        """Return the values at instants."""
        return np.full(np.shape(time), self.value)

    def slope(self, time: float) -> float:
        """Return zero."""
        return 0.0


@dataclass(frozen=True)
class Sine:
    """``amplitude sin(frequency t + phase)``.

    Parameters
    ----------
    amplitude : float
        In the unit of the input.
    frequency : float
        rad/s.
    phase : float
        rad.
    """

    amplitude: float
    frequency: float
    phase: float = 0.0

    @property
    def knots(self) -> Array:
        """None."""
        return np.zeros(0)

    def at(self, time: ArrayLike) -> Array:
        """Return the values at instants."""
        return self.amplitude * np.sin(self.frequency * np.asarray(time) + self.phase)

    def slope(self, time: float) -> float:
        """Return the rate at an instant."""
        return float(self.amplitude * self.frequency * np.cos(self.frequency * time + self.phase))


@dataclass(frozen=True, eq=False)
class Table:
    """Values at instants, linear in between; before the first and after the last it stays.

    Parameters
    ----------
    times : array, (k,)
        s, increasing.
    values : array, (k,)
        In the unit of the input.
    """

    times: Array
    values: Array
    frequency: float = 0.0

    @property
    def knots(self) -> Array:
        """The instants of the table."""
        return self.times

    def at(self, time: ArrayLike) -> Array:
        """Return the values at instants."""
        values: Array = np.interp(np.asarray(time, float), self.times, self.values)
        return values

    def slope(self, time: float) -> float:
        """Return the slope at an instant; at a knot, that to its right."""
        right = int(np.searchsorted(self.times, time, side="right"))
        if right in (0, len(self.times)):
            return 0.0
        rise, run = np.diff(self.values[right - 1 : right + 1]), np.diff(self.times[right - 1 : right + 1])
        return float(rise[0] / run[0])
