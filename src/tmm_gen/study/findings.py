"""What a study says: the cheapest way to each error, and how many times cheaper it is than Newmark's.

Compared are costs at one and the same error, each at the longest step that keeps it. Where no step that is too long was
tried, that step is not known but for a bound, and neither is any ratio: then none is told.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

from tmm_gen.study.chosen_steps import ChosenSteps
from tmm_gen.study.configuration import Family
from tmm_gen.study.excitation import unit
from tmm_gen.study.grid import alike
from tmm_gen.study.outcome import Outcome
from tmm_gen.study.point import Point
from tmm_gen.study.single_precision import single_precision
from tmm_gen.study.study import Study

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
        s, by interpolation between the steps of the study, in logarithms; the longest good one where there is nothing
        to interpolate.
    ns : float, optional
        Nanoseconds for a simulated second; None where times were not measured for all families.
    operations : float, optional
        Floating-point operations for a simulated second.
    known : bool
        Whether the step is interpolated; a longer one than this may be as accurate, else.
    longer : float
        s; the shortest step tried that is too long: the next one. Infinite where there is none.
    """

    family: Family
    step: float
    ns: float | None
    operations: float | None
    known: bool
    longer: float = math.inf

    @property
    def cost(self) -> float:
        """By which ways are ordered: time, or operations where there is none."""
        found = self.operations if self.ns is None else self.ns
        return math.inf if found is None else found

    @property
    def least(self) -> float:
        """What it costs at least: with a longer step than those tried it may be less than `cost`."""
        return self.cost if self.known else self.cost * self.step / self.longer


@dataclass(frozen=True)
class Finding:
    """Who wins at an error.

    Parameters
    ----------
    level : float
        The time error.
    ways : tuple of Way
        Of all families that reach it, cheapest first.
    tried : bool
        Whether Newmark's method was tried at all, with the same links, linearisation and number type as the scene.
    """

    level: float
    ways: tuple[Way, ...]
    tried: bool = True

    @property
    def baseline(self) -> Way | None:
        """Newmark's way with the same links, linearisation and number type as the scene."""
        return next((way for way in self.ways if way.family.integrator == BASELINE), None)

    @property
    def rivals(self) -> tuple[Way, ...]:
        """Ways that may be cheaper than the first, with longer steps than those tried."""
        return tuple(way for way in self.ways[1:] if way.least < self.ways[0].cost)

    def factor(self, way: Way) -> float | None:
        """Return how many times as much time Newmark's way takes; None unless both steps are known."""
        return _ratio(self.baseline, way, lambda each: each.ns)

    def operations_factor(self, way: Way) -> float | None:
        """Return how many times as many operations Newmark's way takes; None unless both steps are known."""
        return _ratio(self.baseline, way, lambda each: each.operations)

    def sentence(self) -> str:
        """Say it in words."""
        if not self.ways:
            return f"At an error of {self.level:g} nothing gets there."
        best = self.ways[0]
        tried = " of what was tried" if self.rivals else ""
        text = f"At an error of {self.level:g}, {best.family.integrator} is the cheapest{tried}, with {_steps(best)}"
        if best.ns is not None:
            text += f": {plain_number(best.ns / 1e3)} µs for a simulated second"
        text += f"{self._compared(best)}."
        others = [way.family.integrator for way in self.rivals]
        if not others:
            return text
        return f"{text} With longer --steps {', '.join(others)} may be cheaper."

    def _compared(self, best: Way) -> str:
        """Say how the winner stands to Newmark's method, if that is known."""
        if best.family.integrator == BASELINE:
            return ""
        if self.baseline is None:
            return "; Newmark's method " + (
                "does not get there within the grid" if self.tried else "was not tried"
            )
        by_time, by_count = self.factor(best), self.operations_factor(best)
        told = [_times(by_time, "less time", "more time")] if by_time is not None else []
        told += [_times(by_count, "fewer operations", "more operations")] if by_count is not None else []
        if told:
            return f", {' and '.join(told)} than Newmark's method"
        return "; longer --steps would tell how it compares with Newmark's method"


def _ratio(baseline: Way | None, way: Way, cost: Callable[[Way], float | None]) -> float | None:
    if baseline is None or not (baseline.known and way.known):
        return None
    whole, part = cost(baseline), cost(way)
    return whole / part if whole and part else None


def _steps(way: Way) -> str:
    if way.known:
        return f"steps of {way.step:.2g} s"
    if math.isfinite(way.longer):
        return f"steps of {way.step:.2g} s, the longest tried that do not diverge"
    return f"the longest steps tried, {way.step:.2g} s"


def _times(factor: float, saved: str, spent: str) -> str:
    times, what = (factor, saved) if factor >= 1.0 else (1.0 / factor, spent)
    digits = 1 if times >= 1.05 else 2  # "1.0 times more" would say nothing
    return f"{times:.{digits}f} times {what}"


def findings(study: Study, levels: Sequence[float] = LEVELS) -> tuple[Finding, ...]:
    """Return who wins at some errors, among families that are the scene's own but for the integrator.

    Each sweeps as often as the scene says, or as suits it.
    Judged by the time error alone: how the arm was cut into links is no concern of an integrator.
    """
    rivals = [
        (family, points)
        for family, points in by_family(study.points)
        if family == alike(study.scene, family.integrator)
    ]
    tried = any(family.integrator == BASELINE for family, _ in rivals)
    found = []
    for level in levels:
        ways = [way for family, points in rivals if (way := _way(study, family, points, level)) is not None]
        if any(way.ns is None for way in ways):  # times of some beside operations of others would be no order
            ways = [replace(way, ns=None) for way in ways]
        found.append(Finding(level, tuple(sorted(ways, key=lambda way: way.cost)), tried))
    return tuple(found)


def summary(study: Study) -> list[str]:
    """Say in sentences what was tried, under what, who wins, and what runs by a tolerance did."""
    scene, went = study.scene, study.excitation
    travelled = f"{study.travel:.3g} {unit(scene, went.output)}"
    others = ", ".join(f"{study.count(each)} {each.value}" for each in Outcome if study.count(each))
    stored = f" {study.stored} were in the store; times are measured anew." if study.stored else ""
    single = single_precision(study)
    return [
        f"{went.until:g} s of {'; '.join(went.told(scene))}. Errors are relative to the travel of {travelled}.",
        f"{len(study.points)} configurations: {others}.{stored}",
        *(each.sentence() for each in findings(study)),
        *([single.sentence()] if single is not None else []),
        *(chosen_sentence(study, each) for each in study.chosen),
    ]


def equal_steps(study: Study, chosen: ChosenSteps) -> int | None:
    """Return how many equal steps are as accurate as those of a tolerance; None where the grid does not tell."""
    if chosen.error is None:
        return None
    points = next((found for family, found in by_family(study.points) if family == chosen.family), [])
    way = _way(study, chosen.family, points, chosen.error) if points else None
    return None if way is None or not way.known else math.ceil(study.excitation.until / way.step)


def chosen_sentence(study: Study, chosen: ChosenSteps) -> str:
    """Say in words what a run by a tolerance did."""
    begun = f"By a tolerance of {chosen.tolerance:g} {chosen.family.integrator}"
    if chosen.reason:
        return f"{begun} has no run: {chosen.reason}"
    equal = equal_steps(study, chosen)
    beside = "" if equal is None else f"; so accurate, {equal} equal steps are"
    return (
        f"{begun} takes {chosen.steps} steps, from {chosen.smallest:.2g} to {chosen.largest:.2g} s, and is off by "
        f"{chosen.error:.2g}{beside}."
    )


def by_family(points: Sequence[Point]) -> Iterator[tuple[Family, list[Point]]]:
    """Yield each family with its finished points, longest step first."""
    for family in dict.fromkeys(point.configuration.family for point in points):
        members = [p for p in points if p.configuration.family == family and p.finished]
        yield family, sorted(members, key=lambda p: -p.configuration.step)


def _way(study: Study, family: Family, points: list[Point], level: float) -> Way | None:
    """Return the longest step that has, with all shorter ones, at most an error; interpolated in logarithms."""
    good = len(points)
    while good > 0 and _time_error(points[good - 1]) <= level:
        good -= 1
    if good == len(points):
        return None
    first = points[good]
    step = first.configuration.step
    known = good > 0
    longer = points[good - 1].configuration.step if known else _diverged(study, family, step)
    if known:
        step = _interpolated(points[good - 1], first, level)
    ns = first.cost.ns_per_step / step if first.cost else None
    count = first.result.operations
    return Way(family, step, ns, None if count is None else count / step, known, longer)


def _diverged(study: Study, family: Family, step: float) -> float:
    """Return the next longer step at which a family diverged; infinity if it did at none."""
    diverged = [p for p in study.points if p.result.outcome is Outcome.DIVERGED]
    steps = [p.configuration.step for p in diverged if p.configuration.family == family]
    return min((longer for longer in steps if longer > step), default=math.inf)


def _interpolated(before: Point, after: Point, level: float) -> float:
    """Return the step between two at which the error is just the level."""
    high, low = _time_error(before), max(_time_error(after), 1e-300)
    share = math.log(level / low) / math.log(high / low)
    steps = after.configuration.step, before.configuration.step
    return math.exp(math.log(steps[0]) + share * math.log(steps[1] / steps[0]))


def _time_error(point: Point) -> float:
    error = point.result.error
    return math.inf if error is None else error


def plain_number(value: float) -> str:
    """Return three digits, and thousands where they are."""
    rounded = float(f"{value:.3g}")
    return f"{rounded:g}" if rounded < 1000.0 else f"{rounded:,.0f}"


def time_text(ns: float) -> str:
    """Return a time with the unit that suits it."""
    for size, name in ((1e9, "s"), (1e6, "ms"), (1e3, "µs")):
        if ns >= size:
            return f"{ns / size:.3g} {name}"
    return f"{ns:.3g} ns"
