"""The motion of a prescribed base from a table: angle, rate and acceleration.

Rows are samples of a smooth motion: a cubic spline goes through them, whose rate and acceleration are continuous.
Where the rows themselves have a corner, the spline would ring about it, and the motion would be another one than the
table's: there the rate jumps, as the rows say. So a table of a few rows far apart is what it looks like, straight in
between. Where the file has the rates too, a curve of third degree takes both up, and one of fifth the accelerations.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tmm_gen.inputs.signals import Table

Array = NDArray[np.float64]

SHARP, CORNER, _ALONE = 0.5, 0.25, 2.0
"""A slope that changes by more than the first share of the table's largest slope at one row has a corner there; by more
than the second, if it changes that many times less at the rows beside. Samples of a smooth motion do neither."""

_FEW = 4
"""So many rows are no samples: wherever their slope changes there is a corner."""

_LONG = 3.0
"""An interval this many times longer than one beside it is a pause between samples: straight."""

_AT_REST = 0.02
"""A spline whose rate at an end differs by less than this share of the largest slope from what follows, joins it."""

_BESIDE = 1e-9
"""An instant that is before a row by less than this share of an interval is that of the row: rounding put it there."""


@dataclass(frozen=True, eq=False)
class Curve:
    """A motion in pieces; before the first instant and after the last it stays, at the last it still moves.

    Parameters
    ----------
    times : array, (k,)
        Where pieces meet, s, increasing.
    coefficients : array, (degree + 1, k - 1)
        Of each piece in powers of the time since its beginning, highest first.
    last : float
        Value at the last instant.
    table : Table
        What it was made from.
    corners : tuple of (int, float)
        Rows at which the rate jumps, and by how much; the first and the last count too, as the motion stays beyond.
    """

    times: Array
    coefficients: Array
    last: float
    table: Table = field(compare=False)
    corners: tuple[tuple[int, float], ...] = field(default=(), compare=False)

    @property
    def knots(self) -> Array:
        """Where pieces meet, s."""
        return self.times

    @property
    def ends(self) -> float:
        """The last instant."""
        return float(self.times[-1])

    def on_clock(self, start: float, scale: float = 1.0) -> Curve:
        """Return the same motion on another clock: what was at ``t`` is at ``scale*t - start``."""
        powers = np.arange(len(self.coefficients) - 1, -1, -1)
        return Curve(
            times=scale * self.times - start,
            coefficients=self.coefficients / scale ** powers[:, np.newaxis],
            last=self.last,
            table=replace(self.table, times=scale * self.table.times - start),
            corners=tuple((row, jump / scale) for row, jump in self.corners),
        )

    def at(self, time: ArrayLike) -> Array:
        """Return the values at instants."""
        return self._evaluated(time, 0)

    def slope(self, time: ArrayLike) -> Array:
        """Return the rates at instants; at a corner, that of the piece which begins there."""
        return self._evaluated(time, 1)

    def curvature(self, time: ArrayLike) -> Array:
        """Return the accelerations at instants; at a corner, that of the piece which begins there."""
        return self._evaluated(time, 2)

    def _evaluated(self, time: ArrayLike, derivative: int) -> Array:
        now = np.asarray(time, float)
        place = np.searchsorted(self._begins, now, side="right") - 1
        inside = np.clip(place, 0, len(self.times) - 2)
        since = np.maximum(now - self.times[inside], 0.0)
        values = np.zeros(now.shape)
        for row in self._derivatives[derivative]:
            values = values * since + row[inside]
        before, beyond = (self.table.values[0], self.last) if derivative == 0 else (0.0, 0.0)
        # the last row itself still belongs to the motion: a run may end there
        after = now > self.times[-1] + (self.times[-1] - self._begins[-1])
        return np.where(place < 0, before, np.where(after, beyond, values))

    @cached_property
    def _begins(self) -> Array:
        """Instants from which on a piece is in force."""
        spans = np.diff(self.times)
        beside = np.minimum(np.append(spans, np.inf), np.insert(spans, 0, np.inf))
        begins: Array = self.times - _BESIDE * beside
        return begins

    @cached_property
    def _derivatives(self) -> tuple[Array, ...]:
        """Coefficients of angle, rate and acceleration."""
        found = [self.coefficients]
        for _ in range(2):
            powers = np.arange(len(found[-1]) - 1, 0, -1)[:, None]
            found.append(found[-1][:-1] * powers)
        return tuple(found)


def through(table: Table) -> Curve:
    """Return the motion through the rows of a table: a cubic spline that keeps corners."""
    times, values = table.times, table.values
    if len(times) == 1:
        return Curve(np.array([times[0], times[0] + 1.0]), np.array([[values[0]]]), float(values[0]), table)
    slopes = np.diff(values) / np.diff(times)
    largest = float(np.max(np.abs(slopes)))
    breaks = _breaks(times, slopes, largest)
    coefficients = np.zeros((4, len(slopes)))
    for first, last in itertools.pairwise(breaks):
        coefficients[:, first:last] = _piece(times, values, slopes, first, last, largest)
    return Curve(times, coefficients, float(values[-1]), table, _corners(times, coefficients, largest))


def with_rates(table: Table, rates: Array, accelerations: Array | None) -> Curve:
    """Return the motion that has the angles, rates and, where they are given, accelerations of all rows."""
    from scipy.interpolate import BPoly, PPoly  # slow to import

    times, values = table.times, table.values
    if len(times) == 1:
        return through(table)
    given = [values, rates] if accelerations is None else [values, rates, accelerations]
    made = PPoly.from_bernstein_basis(BPoly.from_derivatives(times, np.stack(given, axis=1)))
    largest = float(np.max(np.abs(rates))) or 1.0
    return Curve(times, made.c, float(values[-1]), table, _corners(times, made.c, largest))


def rates_fit(curve: Curve, rates: Array) -> float:
    """Return how many times the slopes of the rows the rates are that are given for them; 1 for a few rows."""
    table = curve.table
    if len(rates) <= _FEW:
        return 1.0
    slopes = np.diff(table.values) / np.diff(table.times)
    between = 0.5 * (rates[1:] + rates[:-1])
    # weighed by time, so that rows close together do not count for more
    spans = np.diff(table.times)
    square = float(np.sum(spans * slopes**2))
    return float(np.sum(spans * slopes * between)) / square if square > 0.0 else 1.0


def _breaks(times: Array, slopes: Array, largest: float) -> list[int]:
    """Return the rows between which one spline goes: the ends, corners, and both ends of a pause."""
    change = np.abs(np.diff(slopes, prepend=0.0, append=0.0))
    beside = np.maximum(change[:-2], change[2:])
    change = change[1:-1]
    corner = change > SHARP * largest
    corner |= (change > CORNER * largest) & (change > _ALONE * beside)
    if len(times) <= _FEW:
        corner |= change > _AT_REST * largest
    spans = np.diff(times)
    pause = np.zeros(len(spans), bool)
    pause[1:] |= spans[1:] > _LONG * spans[:-1]
    pause[:-1] |= spans[:-1] > _LONG * spans[1:]
    inner = corner | pause[1:] | pause[:-1]
    return [0, *(np.flatnonzero(inner) + 1).tolist(), len(slopes)]


def _piece(times: Array, values: Array, slopes: Array, first: int, last: int, largest: float) -> Array:
    """Return the coefficients of the spline from one row to another, (4, intervals)."""
    from scipy.interpolate import CubicSpline  # slow to import

    if last == first + 1:
        return np.array([[0.0], [0.0], [slopes[first]], [values[first]]])
    rows = slice(first, last + 1)
    ends = CubicSpline(times[rows], values[rows])(times[[first, last]], 1)
    # what comes before and after: rest beyond the table, a straight line beside a pause
    beside = (slopes[first - 1] if first else 0.0, slopes[last] if last < len(slopes) else 0.0)
    joins = [
        (1, rate) if abs(end - rate) <= _AT_REST * largest else "not-a-knot"
        for end, rate in zip(ends, beside, strict=True)
    ]
    made: Array = CubicSpline(times[rows], values[rows], bc_type=tuple(joins)).c
    return made


def _corners(times: Array, coefficients: Array, largest: float) -> tuple[tuple[int, float], ...]:
    """Return the rows at which the rate jumps, and by how much."""
    spans, degree = np.diff(times), len(coefficients) - 1
    powers = np.arange(degree, 0, -1)
    begin = coefficients[-2]
    end = sum(
        (n * c * spans ** (n - 1) for n, c in zip(powers, coefficients[:-1], strict=True)),
        np.zeros(len(spans)),
    )
    jumps = np.concatenate([begin, [0.0]]) - np.concatenate([[0.0], end])
    return tuple((int(k), float(jumps[k])) for k in np.flatnonzero(np.abs(jumps) > _AT_REST * largest))
