"""Inputs as functions of time: constant, harmonic, or a table that is linear in between.

Each of these consists of pieces on which ``u'' = -w^2 u``, so that a reference solution can carry the input
along as part of a linear system and be exact. Others are in :mod:`tmm_gen.inputs.profiles` and
:mod:`tmm_gen.inputs.curve`.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


@runtime_checkable
class Signal(Protocol):
    """An input over time."""

    @property
    def knots(self) -> Array:
        """Instants at which a new piece begins, s, increasing."""

    @property
    def ends(self) -> float:
        """Instant from which on it stays as it is, s; infinite where there is none."""

    def at(self, time: ArrayLike) -> Array:
        """Return the values at instants, of the same shape."""

    def slope(self, time: ArrayLike) -> Array:
        """Return the first derivatives at instants; at a knot, that of the piece which begins there."""

    def curvature(self, time: ArrayLike) -> Array:
        """Return the second derivatives at instants; at a knot, that of the piece which begins there."""


@runtime_checkable
class Harmonic(Signal, Protocol):
    """An input of pieces on which ``u'' = -w^2 u``."""

    @property
    def frequency(self) -> float:
        """Angular frequency ``w`` of all pieces, rad/s."""


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

    @property
    def ends(self) -> float:
        """It never moves."""
        return -np.inf

    def at(self, time: ArrayLike) -> Array:
        """Return the values at instants."""
        return np.full(np.shape(time), self.value)

    def slope(self, time: ArrayLike) -> Array:
        """Return zeros."""
        return np.zeros(np.shape(time))

    def curvature(self, time: ArrayLike) -> Array:
        """Return zeros."""
        return np.zeros(np.shape(time))


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

    @property
    def ends(self) -> float:
        """It never does."""
        return np.inf

    def at(self, time: ArrayLike) -> Array:
        """Return the values at instants."""
        return self.amplitude * np.sin(self.frequency * np.asarray(time) + self.phase)

    def slope(self, time: ArrayLike) -> Array:
        """Return the first derivatives at instants."""
        slope: Array = (
            self.amplitude * self.frequency * np.cos(self.frequency * np.asarray(time) + self.phase)
        )
        return slope

    def curvature(self, time: ArrayLike) -> Array:
        """Return the second derivatives at instants."""
        return -(self.frequency**2) * self.at(time)


@dataclass(frozen=True, eq=False)
class Table:
    """Values at instants, linear in between; before the first and after the last it stays.

    Parameters
    ----------
    times : array, (k,)
        s, increasing.
    values : array, (k,)
        In the unit of the input.
    source : str
        Where it is from, for messages.
    lines : tuple of int
        Line of each row in its file; empty where there is none.
    """

    times: Array
    values: Array
    frequency: float = 0.0
    source: str = field(default="", compare=False)
    lines: tuple[int, ...] = field(default=(), compare=False)

    @property
    def knots(self) -> Array:
        """The instants of the table."""
        return self.times

    @property
    def ends(self) -> float:
        """The last instant."""
        return float(self.times[-1])

    def row(self, index: int) -> str:
        """Say where a row is: file and line, or its instant alone."""
        return f"{self.source}:{self.lines[index]}" if self.lines else f"t = {self.times[index]:g} s"

    def at(self, time: ArrayLike) -> Array:
        """Return the values at instants."""
        values: Array = np.interp(np.asarray(time, float), self.times, self.values)
        return values

    def slope(self, time: ArrayLike) -> Array:
        """Return the slopes at instants; at a knot, that to its right."""
        slopes = np.concatenate([[0.0], np.diff(self.values) / np.diff(self.times), [0.0]])
        found: Array = slopes[np.searchsorted(self.times, np.asarray(time, float), side="right")]
        return found

    def curvature(self, time: ArrayLike) -> Array:
        """Return zeros: the second derivative is a blow at each row, and nothing in between."""
        return np.zeros(np.shape(time))
