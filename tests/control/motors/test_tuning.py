"""Tuning of several motors: by the same search, what belongs to torques counted in those that each may have."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tmm_gen.closed_loop.knobs import number, places_of, turned
from tmm_gen.closed_loop.objective import AIMS, aims_of, objective, rustles
from tmm_gen.closed_loop.pricing import OneByOne
from tmm_gen.closed_loop.tunables import PREDICTIVE, TUNABLE, tunables_of
from tmm_gen.closed_loop.tuning import tune
from tmm_gen.control.bench import Bench
from tmm_gen.control.controllers import BY_NAME
from tmm_gen.scene import Scene, load_scene, parse_scene
from tmm_gen.scene.problem import SceneError
from tmm_gen.scene.rewrite import rewritten

pytestmark = pytest.mark.compiler


def test_the_numbers_of_the_committed_arm_are_within_the_ranges(elbow: Scene) -> None:
    """Those its search had were found in other ranges; no knob is at an end but one that is not told."""
    for tunable in tunables_of(Bench.of(elbow)):
        if tunable.name in ("pd-zv", "pd-zvd"):  # without gains of their own
            assert_allclose(places_of(elbow, tunable), 0.0)
            continue
        places = places_of(elbow, tunable)
        inside = [knob.key != "control.payload" for knob in tunable.knobs]
        assert np.all((places[inside] > 0.0) & (places[inside] < 1.0)), tunable.name


def test_what_is_turned_is_found_again_and_told_by_names_where_torques_count(elbow: Scene) -> None:
    felt = elbow.replace(**{"control.sensors.accelerometer": 0.02, "control.sensors.strain": {"elbow": 0.01}})
    bench, random = Bench.of(felt), np.random.default_rng(4)
    largest = np.max(np.abs(bench.problem.torque), axis=0)
    for tunable in tunables_of(bench):
        places = random.uniform(0.1, 0.9, len(tunable.knobs))
        scene = turned(felt, tunable, places)
        near = [0.4 if knob.grid else 2e-3 for knob in tunable.knobs]
        assert np.all(np.abs(places_of(scene, tunable) - places) < near)
        assert turned(scene, tunable, places) == scene
        assert Bench.of(scene).problem.count == 2
    mpc, lqr, *_ = tunables_of(bench)
    weights = number(turned(felt, lqr, np.full(4, 0.5)), "control.baselines.lqr.torque")
    assert isinstance(weights, dict)
    scaled = np.array([weights[name] for name in ("shoulder", "elbow")]) * largest**2
    assert_allclose(scaled, scaled[0], rtol=1e-2)
    # of a hub with 3 N m the range is that of arms on one
    (own,) = (knob for knob in TUNABLE[1].knobs if knob.key.endswith("torque"))
    (knob,) = (knob for knob in lqr.knobs if knob.key.endswith("torque"))
    assert knob.value(0.3, 3.0**-2) == pytest.approx(own.value(0.3), rel=1e-2)
    assert {"control.estimator.accelerometer", "control.estimator.strain"} <= set(mpc.keys)
    assert "control.estimator.accelerometer" not in tunables_of(Bench.of(elbow))[0].keys


def test_walls_leave_those_that_keep_them(elbow: Scene) -> None:
    floor = {"frame": "payload", "normal": [0.0, 1.0], "offset": -0.5, "margin": 0.01}
    walled = Bench.of(elbow.replace(**{"control.keep": [floor]}))
    keeping = tuple(name for name in PREDICTIVE if BY_NAME[name].keeps)
    assert tunables_of(walled)[0].controllers == keeping
    assert "rti" in keeping
    assert tunables_of(Bench.of(elbow))[0].controllers == PREDICTIVE


def test_an_arm_may_take_a_quintic_and_a_vibration(elbow: Scene) -> None:
    """And as much longer with other payloads as an arm on a hub; without noise every loop of a condition is one."""
    bench = Bench.of(elbow)
    aims = aims_of(bench)
    assert aims[1].settling == pytest.approx(0.5 + 0.288, abs=0.021)
    for aim, like in zip(aims, AIMS, strict=True):
        assert aim.condition == like.condition
        assert aim.settling / aims[1].settling == pytest.approx(like.settling / AIMS[1].settling)
        assert aim.after / aim.settling == pytest.approx(1.0 / like.settling)
    assert not rustles(bench)
    assert rustles(Bench.of(elbow.replace(**{"control.sensors.strain": 0.01})))
    weak = elbow.replace(**{"control.bounds.torque": {"shoulder": 0.1, "elbow": 0.04}})
    assert aims_of(Bench.of(weak))[1].settling > aims[1].settling


def test_better_numbers_cost_less_in_closed_loops(firm_bench: Bench) -> None:
    """Of PD with inverse dynamics, the committed gains and such as are stiff and hardly brake."""
    pd = next(each for each in tunables_of(firm_bench) if each.name == "pd-id")
    aims = aims_of(firm_bench)[1:2]
    stiff = firm_bench.retuned(turned(firm_bench.scene, pd, np.array([0.9, 0.1, 0.9, 0.1])))
    here, there = (objective(bench, pd.controllers, aims=aims) for bench in (firm_bench, stiff))
    assert 0.0 < here < 0.6 * there < np.inf


def test_the_search_finds_gains_motor_by_motor(two: Bench) -> None:
    """The least of a price that has it at 30 and 60 % of the ranges of shoulder and elbow."""
    pd = next(each for each in tunables_of(two) if each.name == "pd-id")
    wanted = np.array([0.3, 0.3, 0.6, 0.6])

    def cost(bench: Bench, _controllers: Sequence[str], _enough: float) -> float:
        return float(np.sum(np.square(places_of(bench.scene, pd) - wanted)))

    found = tune(two.scene, pd, 150, 1, pricing=OneByOne(two, cost))
    assert found.price < 0.02
    assert_allclose(found.places, wanted, atol=0.12)
    assert set(number(found.scene, "control.baselines.pd_id")) == {"shoulder", "elbow"}
    kept = tune(found.scene, replace(pd), 20, 1, pricing=OneByOne(two, cost), refine=True)
    assert kept.price <= found.price


def test_numbers_by_names_are_rewritten_and_nothing_else(repository: Path) -> None:
    """A table, a list in a table, and one number for all that becomes a table; the comment stays."""
    path = repository / "scenes" / "elbow.toml"
    text, scene = path.read_text(), load_scene(path)
    values = {
        "control.weights.torque": {"shoulder": 2.5, "elbow": 7.5},
        "control.baselines.pd_id": {"shoulder": (0.3, 0.05), "elbow": (0.4, 0.01)},
        "control.weights.hub": {"shoulder": 3.0, "elbow": 4.0},
    }
    other = scene.replace(**values)
    new = rewritten(
        text, "elbow.toml", other, {tuple(key.split(".")): value for key, value in values.items()}
    )
    assert parse_scene(new, "elbow.toml") == other
    changed = [row for row in new.split("\n") if row not in text.split("\n")]
    assert [row.partition("#")[0].rstrip() for row in changed] == [
        "hub = { shoulder = 3.0, elbow = 4.0 }",
        "torque = { shoulder = 2.5, elbow = 7.5 }",
        "pd_id = { shoulder = [0.3, 0.05], elbow = [0.4, 0.01] }",
    ]
    with pytest.raises(SceneError, match=r"control\.payload: cannot be rewritten"):
        rewritten(text, "elbow.toml", other, {("control", "payload"): 1.1})
