"""What a study says: the cheapest way to each error, and how many times cheaper it is than Newmark's."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from tmm_gen.measure.trade.configuration import Family, own
from tmm_gen.measure.trade.point import Point
from tmm_gen.measure.trade.study import Study

LEVELS = (1e-2, 1e-4, 1e-6)
"""Time errors, relative to the travel of the output, at which ways are compared."""

BASELINE = "newmark"

Price = Callable[[Point], float | None]


@dataclass(frozen=True)
class Way:
    """What a family needs for an error.

    Parameters
    ----------
    family : Family
        What is generated.
    step : float
        s, by interpolation between the steps of the study, in logarithms.
    ns : float, optional
        Nanoseconds for a simulated second; None where times were not measured.
    operations : float
        Floating-point operations for a simulated second.
    coarsest : bool
        Whether the coarsest step tried that does not diverge is already as accurate: a longer one may be too.
    """

    family: Family
    step: float
    ns: float | None
    operations: float
    coarsest: bool

    @property
    def cost(self) -> float:
        """By which ways are ordered: time, or operations where there is none."""
        return self.operations if self.ns is None else self.ns


@dataclass(frozen=True)
class Finding:
    """Who wins at an error.

    Parameters
    ----------
    level : float
        The time error.
    ways : tuple of Way
        Of all families that reach it, cheapest first.
    """

    level: float
    ways: tuple[Way, ...]

    @property
    def baseline(self) -> Way | None:
        """Newmark's way with the same links, linearisation and number type as the scene."""
        return next((way for way in self.ways if way.family.integrator == BASELINE), None)

    def factor(self, way: Way) -> float | None:
        """Return how many times as much time Newmark's way takes."""
        if self.baseline is None or self.baseline.ns is None or not way.ns:
            return None
        return self.baseline.ns / way.ns

    def operations_factor(self, way: Way) -> float | None:
        """Return how many times as many operations Newmark's way takes."""
        return None if self.baseline is None else self.baseline.operations / way.operations

    def sentence(self) -> str:
        """Say it in words."""
        if not self.ways:
            return f"At an error of {self.level:g} nothing gets there."
        best = self.ways[0]
        steps = "the longest steps tried, " if best.coarsest else "steps of "
        text = f"At an error of {self.level:g}, {best.family.integrator} is the cheapest, with {steps}{best.step:.2g} s"
        if best.ns is not None:
            text += f": {time_text(best.ns)} for a simulated second"
        by_time, by_count = self.factor(best), self.operations_factor(best)
        if best.family.integrator == BASELINE:
            return f"{text}."
        if by_count is None:
            return f"{text}; Newmark's method does not get there within the grid."
        told = [_times(by_time, "less time", "more time")] if by_time is not None else []
        told.append(_times(by_count, "fewer operations", "more operations"))
        return f"{text}, {' and '.join(told)} than Newmark's method."


def _times(factor: float, saved: str, spent: str) -> str:
    return f"{factor:.1f} times {saved}" if factor >= 1.0 else f"{1.0 / factor:.1f} times {spent}"


def findings(study: Study, levels: Sequence[float] = LEVELS) -> tuple[Finding, ...]:
    """Return who wins at some errors, among families with the scene's own links, linearisation and sweeps.

    Judged by the time error alone: how the arm was cut into links is no concern of an integrator.
    """
    mine = own(study.scene).family
    alike = [
        (family, points)
        for family, points in by_family(study.points)
        if (family.links, family.linearisation, family.iterations, family.real, family.backend)
        == (mine.links, mine.linearisation, mine.iterations, mine.real, mine.backend)
    ]
    found = []
    for level in levels:
        ways = [way for family, points in alike if (way := _way(family, points, level)) is not None]
        found.append(Finding(level, tuple(sorted(ways, key=lambda way: way.cost))))
    return tuple(found)


def by_family(points: Sequence[Point]) -> Iterator[tuple[Family, list[Point]]]:
    """Yield each family with its finished points, longest step first."""
    for family in dict.fromkeys(point.configuration.family for point in points):
        members = [p for p in points if p.configuration.family == family and p.finished]
        yield family, sorted(members, key=lambda p: -p.configuration.step)


def _way(family: Family, points: list[Point], level: float) -> Way | None:
    """Return the longest step that has, with all shorter ones, at most an error; interpolated in logarithms."""
    good = len(points)
    while good > 0 and _time_error(points[good - 1]) <= level:
        good -= 1
    if good == len(points):
        return None
    first = points[good]
    step = first.configuration.step
    if good > 0:
        before = points[good - 1]
        step = _interpolated(before, first, level)
    ns = first.cost.ns_per_step / step if first.cost else None
    return Way(family, step, ns, (first.result.operations or 0) / step, coarsest=good == 0)


def _interpolated(before: Point, after: Point, level: float) -> float:
    """Return the step between two at which the error is just the level."""
    high, low = _time_error(before), max(_time_error(after), 1e-300)
    share = math.log(level / low) / math.log(high / low)
    steps = after.configuration.step, before.configuration.step
    return math.exp(math.log(steps[0]) + share * math.log(steps[1] / steps[0]))


def _time_error(point: Point) -> float:
    error = point.result.error
    return math.inf if error is None else error


def time_text(ns: float) -> str:
    """Return a time with the unit that suits it."""
    for size, unit in ((1e9, "s"), (1e6, "ms"), (1e3, "µs")):
        if ns >= size:
            return f"{ns / size:.3g} {unit}"
    return f"{ns:.3g} ns"
