"""Sentences compare like with like, whatever a study found: each side at the cheapest step that keeps the error."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tmm_gen.native.timing import Cost
from tmm_gen.scene import Scene, load_scene
from tmm_gen.study.configuration import Configuration, Family, own
from tmm_gen.study.excitation import Excitation
from tmm_gen.study.explain import explained
from tmm_gen.study.findings import findings, summary
from tmm_gen.study.grid import Axes, families
from tmm_gen.study.outcome import Outcome, Result
from tmm_gen.study.point import Point
from tmm_gen.study.report import _race
from tmm_gen.study.single_precision import single_precision
from tmm_gen.study.study import Study
from tmm_gen.study.tune import Tuning
from tmm_gen.study.verify import Verified

LEVELS = (1e-2, 1e-4, 1e-6)
NAMES = ("newmark", "sdirk4", "zhou", "zhai")
TIME = re.compile(r"([\d.]+) times (less|more) time")
COUNT = re.compile(r"([\d.]+) times (fewer|more) operations")


@st.composite
def drawn_points(draw: st.DrawFn, scene: Scene) -> tuple[Point, ...]:
    """Families with curves of some order, at few steps or many, some diverged, some timed."""
    points = []
    timed = draw(st.sampled_from(["all", "none", "some"]))
    for name in draw(st.lists(st.sampled_from(NAMES), min_size=1, unique=True)):
        family = Family(name, None, None, 1, "float64", "c")
        steps = draw(st.lists(st.sampled_from([0.5 / 2**k for k in range(12)]), min_size=1, unique=True))
        order, scale = draw(st.integers(1, 5)), 10.0 ** draw(st.floats(-2.0, 2.0))
        limit = draw(st.sampled_from([math.inf, 0.3, 0.05]))
        operations = draw(st.integers(10, 2000))
        ns = draw(st.floats(5.0, 5000.0))
        cost = Cost(ns, 0.01, 9) if timed == "all" or (timed == "some" and draw(st.booleans())) else None
        for step in steps:
            error = scale * step**order * draw(st.floats(0.7, 1.4))
            result = Result(Outcome.FINISHED, error=error, operations=operations)
            if step > limit:
                result = Result(Outcome.DIVERGED, "far off", operations=operations)
            points.append(Point(Configuration(family, step), result, cost))
    return tuple(points)


def cheapest(study: Study, name: str, level: float) -> tuple[float, Point] | None:
    """Return the longest step that keeps an error, by another way; None where it is not known.

    A curve has to cross the level; between the two steps it is straight in logarithms.
    """
    curve = (
        sorted(
            (p.configuration.step, p.result.error, p)
            for p in study.points
            if p.configuration.family.integrator == name and p.result.error is not None
        )
        if name in NAMES
        else []
    )
    below = None
    for k, (step, error, point) in enumerate(curve):
        if error > level:
            if below is None:
                return None
            steps, errors = np.log([below[0], step]), np.log([below[1], error])
            return float(np.exp(np.interp(np.log(level), errors, steps))), below[2]
        below = curve[k] if below is None or step > below[0] else below
        assert point is not None
    return None


def reaches(study: Study, name: str, level: float) -> bool:
    """Whether the shortest step of a family keeps an error."""
    curve = [
        (p.configuration.step, p.result.error)
        for p in study.points
        if p.configuration.family.integrator == name and p.result.error is not None
    ]
    return bool(curve) and min(curve)[1] <= level


def told(text: str, pattern: re.Pattern[str]) -> float | None:
    found = pattern.search(text)
    if found is None:
        return None
    value = float(found[1])
    return value if found[2] in ("less", "fewer") else 1.0 / value


def alike(found: float, wanted: float) -> bool:
    """Whether a ratio with one digit after the point is that of two costs."""
    larger = max(wanted, 1.0 / wanted)
    return abs(max(found, 1.0 / found) - larger) <= 0.051 and (found >= 0.99) == (
        wanted >= 0.99 or larger < 1.06
    )


@settings(max_examples=80, deadline=None, suppress_health_check=list(HealthCheck))
@given(data=st.data())
def test_every_ratio_is_that_of_the_cheapest(
    data: st.DataObject, chain: Scene, chain_excitation: Excitation
) -> None:
    study = Study(chain, chain_excitation, 1.0, data.draw(drawn_points(chain)))
    found = findings(study, LEVELS)
    race = {row["label"]: row["cells"] for row in _race(found)}
    for column, finding in enumerate(found):
        text, level = finding.sentence(), finding.level
        able = [name for name in NAMES if reaches(study, name, level)]
        if not able:
            assert "nothing gets there" in text
            continue
        best = finding.ways[0].family.integrator
        assert best in able
        assert f"{best} is the cheapest" in text
        ours, theirs = cheapest(study, best, level), cheapest(study, "newmark", level)
        by_time, by_count = told(text, TIME), told(text, COUNT)
        if ours is None or theirs is None or best == "newmark":
            assert by_time is None
            assert by_count is None
        else:
            costs = [
                (p.cost.ns_per_step if p.cost else None, p.result.operations, step)
                for step, p in (ours, theirs)
            ]
            (ns, count, step), (their_ns, their_count, their_step) = costs
            if by_time is not None:
                assert ns is not None
                assert their_ns is not None
                assert alike(by_time, (their_ns / their_step) / (ns / step))
            if by_count is not None:
                assert alike(by_count, (their_count / their_step) / (count / step))
        if "was not tried" in text:
            assert not any(p.configuration.family.integrator == "newmark" for p in study.points)
        if "does not get there" in text:
            assert "newmark" not in able
        # nobody else can be cheaper, unless the sentence says so
        for way in finding.ways[1:]:
            other = way.family.integrator
            if "of what was tried" not in text and cheapest(study, other, level) is not None:
                assert way.cost >= finding.ways[0].cost
            if f"{other} may be cheaper" not in text and other not in text.partition("--steps")[2]:
                assert way.known or way.cost * way.step / way.longer >= finding.ways[0].cost
        for name, cells in race.items():
            cell = cells[column]
            if cell["factor"]:
                assert cheapest(study, name, level) is not None
                assert theirs is not None
            if cell["best"]:
                assert "of what was tried" not in text


def test_one_step_is_no_curve(chain: Scene, chain_excitation: Excitation) -> None:
    """Newmark's method ran at the scene's step alone, hundred times shorter than it had to be."""
    mine = own(chain).family
    points = [
        Point(Configuration(mine, 1e-4), Result(Outcome.FINISHED, error=1e-7, operations=100), Cost(50, 0, 3))
    ]
    other = Family("sdirk4", None, None, 1, "float64", "c")
    points += [
        Point(Configuration(other, h), Result(Outcome.FINISHED, error=h**4, operations=400), Cost(200, 0, 3))
        for h in (0.5, 0.25, 0.125)
    ]
    (finding,) = findings(Study(chain, chain_excitation, 1.0, tuple(points)), (1e-2,))
    assert finding.sentence() == (
        "At an error of 0.01, sdirk4 is the cheapest of what was tried, with steps of 0.32 s: 0.632 µs for a simulated "
        "second; longer --steps would tell how it compares with Newmark's method. With longer --steps newmark may be "
        "cheaper."
    )
    assert finding.factor(finding.ways[0]) is None


@pytest.mark.parametrize("place", ["scenes/elbow.toml", "examples/space/yaw3.toml"])
@pytest.mark.parametrize("named", ["newmark", "gauss3"])
def test_integrators_that_sweep_otherwise_are_compared(
    place: str, named: str, repository: Path, chain_excitation: Excitation
) -> None:
    """Each sweeps as often as suits it: once or twice in a plane, in space with as many corrections as it takes."""
    scene = load_scene(repository / place).replace(**{"integrator.name": named, "model.iterations": "auto"})
    two = families(scene, Axes(integrators=("newmark", "gauss3")))
    assert two[0].iterations != two[1].iterations
    points = [
        Point(
            Configuration(family, h), Result(Outcome.FINISHED, error=h**order, operations=9), Cost(90, 0, 3)
        )
        for family, order in zip(two, (1, 3), strict=True)
        for h in (0.5, 0.25, 0.125)
    ]
    (finding,) = findings(Study(scene, chain_excitation, 1.0, tuple(points)), (0.02,))
    text = finding.sentence()
    assert "gauss3 is the cheapest, with steps of 0.27 s" in text
    assert "Newmark's method does not get there within the grid" in text
    (finding,) = findings(Study(scene, chain_excitation, 1.0, tuple(points)), (0.2,))
    assert finding.baseline is not None


@pytest.mark.parametrize("error", [1e-5, 0.9e-3, 1.1e-3, 0.5])
@pytest.mark.parametrize("links", [False, True])
def test_the_scene_as_it_was_is_compared_within_the_bound(
    error: float, links: bool, chain: Scene, chain_excitation: Excitation
) -> None:
    family = Family("sdirk4", None, None, 1, "float64", "c")
    modelling = 1e-4 if links else None
    good = Result(Outcome.FINISHED, error=8e-4, operations=400, modelling_error=modelling)
    chosen = Point(Configuration(family, 0.2), good, Cost(200.0, 0.0, 3))
    mine = Point(own(chain), Result(Outcome.FINISHED, error=error, operations=100), Cost(100.0, 0.0, 3))
    # the machine was three times slower when the winner ran afresh: that is no reason for other ratios
    fresh = Verified(8e-4, 600.0, 0.0, 3000.0)
    tuning = Tuning(chain, chain_excitation, 1.0, 1e-3, 1.0, (chosen,), (), {}, mine, chosen, fresh)
    last = explained(tuning)[-1]
    if error <= 1e-3 and not links:
        ratio = (100.0 / chain.integrator.step) / (200.0 / 0.2)
        assert f"within the bound too, and takes {ratio:.3g} times as long" in last
    else:
        assert "times" not in last
        assert "for a simulated second" in last


def test_float32_is_held_against_the_same_in_float64(chain: Scene, chain_excitation: Excitation) -> None:
    double = Family("newmark", None, None, 1, "float64", "c")
    rows = [
        (double, 0.1, 1e-3, 10.0),
        (double, 0.01, 1e-5, 10.0),
        (replace(double, real="float32"), 0.1, 1e-3, 7.0),
        (replace(double, real="float32"), 0.01, 4e-5, 9.0),
        (replace(double, real="float32", integrator="sdirk4"), 0.1, 1e-9, 1.0),  # alone: it is no pair
    ]
    points = tuple(
        Point(Configuration(family, step), Result(Outcome.FINISHED, error=error), Cost(ns, 0.0, 1))
        for family, step, error, ns in rows
    )
    study = Study(chain, chain_excitation, 1.0, points, stored=2)
    *_, single = summary(study)
    assert single == (
        "float32 beside float64 (2 pairs): a step takes 0.80 times as long, and the least time error is 4.0e-05 "
        "instead of 1.0e-05."
    )
    assert any("2 were in the store" in each for each in summary(study))
    assert single_precision(Study(chain, chain_excitation, 1.0, points[:2])) is None
