"""Emitted C for an arm in space: the torques of Python, silence of compilers, and goals that it reaches."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tmm_gen.closed_loop.loop import run_loop
from tmm_gen.closed_loop.space_plant import plant_of
from tmm_gen.control.arm.arms import arm_of
from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Status
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.controllers import BY_NAME
from tmm_gen.control.estimators.credible import PATIENCE
from tmm_gen.control.estimators.extended_kalman import NonlinearFilter
from tmm_gen.control.estimators.kalman import present_sensors
from tmm_gen.control.goals.course import Course
from tmm_gen.control.goals.target import rest_with
from tmm_gen.control.laws.linear_mpc import LinearMpc
from tmm_gen.control.laws.rti import FAR, RealTimeIteration
from tmm_gen.control.quadratic.walls import Wall
from tmm_gen.onboard.emit import emit_controller, usual_controller
from tmm_gen.onboard.native import EmittedController
from tmm_gen.onboard.weight import Weight, weight_of
from tmm_gen.scene import Scene, parse_scene

pytestmark = pytest.mark.compiler

HEAVIER = replace(CONDITIONS[1], payload=1.2, friction=0.02)
WARNINGS = ("-pedantic", "-Wall", "-Wextra", "-Wshadow", "-Wundef", "-Werror")
DAQP = 1e-10
"""Both solve the same program to its tolerance, N m."""


def compiled(bench: Bench, name: str, files: dict[str, str]) -> EmittedController:
    """Return an emitted controller."""
    flags, motors = ("-O0", "-ffp-contract=off", *WARNINGS), bench.problem.count
    return EmittedController(name, files, present_sensors(bench.problem), flags=flags, motors=motors)


def in_python(bench: Bench, kind: str) -> RealTimeIteration:
    """Return the controller with the filter that is emitted."""
    found = RealTimeIteration(bench.step, bench.links, bench.inertia, kind == "rti-zero")
    found.estimator = NonlinearFilter(bench.step, bench.links)
    found.reset()
    return found


@pytest.fixture(scope="module")
def zero(bench: Bench) -> EmittedController:
    """The usual one, of zero order."""
    assert usual_controller(bench) == "rti-zero"
    return compiled(bench, *emit_controller(bench, "rti-zero"))


def test_encoders_that_come_and_go_are_those_of_python(bench: Bench, zero: EmittedController) -> None:
    """Flags at random, then none for long, so that the safe law holds the arm up and the estimate starts anew.

    What it carries is told, wrongly at first and of a mass that it cannot have: predictions, sensitivities and safe law
    are of that.
    """
    zero.reset()
    python, plant = in_python(bench, "rti-zero"), plant_of(bench.scene, bench.problem, CONDITIONS[1])
    random, statuses = np.random.default_rng(5), []
    told = {3: 0.1, 9: -1.0, 12: np.inf, 14: 9.0, 24: 0.6}
    for k in range(60):
        if k in told:
            taken = {0.1: Status.OK, 0.6: Status.OK, 9.0: Status.INFEASIBLE}.get(told[k], Status.NOT_FINITE)
            assert zero.carry(told[k]) is python.carry(told[k]) is taken
        seen, valid = plant.measured(), random.random(6) < (0.8 if k < 30 else float(k >= 40))
        expected, found = python.command(seen, valid), zero.command(np.where(valid, seen, 7.0), valid)
        assert_allclose(found.torque, expected.torque, rtol=0.0, atol=DAQP)
        assert found.status is expected.status
        statuses.append(found.status)
        plant.advance(expected.torque)
    assert {Status.OK, Status.REDUCED, Status.MEASUREMENT} == set(statuses)
    assert set(statuses[30:40]) == {Status.MEASUREMENT}
    assert set(statuses[40 + PATIENCE + 1 :]) == {Status.OK}


def test_an_arm_far_from_its_goal_is_that_of_python(bench: Bench, zero: EmittedController) -> None:
    """Overhead and beyond: sensitivities are found where it is on its way, and at last those of its goal once more."""
    zero.reset()
    python, plant = in_python(bench, "rti-zero"), plant_of(bench.scene, bench.problem, CONDITIONS[0])
    start = rest_with(plant.scene, np.array([0.0, bench.problem.reference[1] - 2.6 * FAR]), "initial.angles")
    plant.kernel.initialise(
        initial_angle=start.angles,
        inputs=plant.motors.torques(np.clip(start.goal.torque, *bench.problem.torque)),
    )
    own, found_at = python.prepared, [python.prepared]
    for _ in range(50):
        seen = plant.measured()
        expected, found = python.command(seen), zero.command(seen)
        assert_allclose(found.torque, expected.torque, rtol=0.0, atol=DAQP)
        assert found.status is expected.status is Status.OK
        if python.prepared is not found_at[-1]:
            found_at.append(python.prepared)
        plant.advance(expected.torque)
    assert len(found_at) > 4
    assert_allclose(found_at[-1].slopes.hub, own.slopes.hub, atol=1e-9)


def test_the_goal_is_reached(bench: Bench, zero: EmittedController) -> None:
    """Against emitted C of an arm of more cells, with more payload than it was told, and friction."""
    zero.reset()
    loop = run_loop(zero, plant_of(bench.scene, bench.problem, HEAVIER), 1.6, timed=False)
    assert np.max(np.abs(loop.tip[-1] - loop.goal)) < 2e-3
    assert not loop.fallbacks


def test_an_arm_that_carries_nothing_keeps_walls_as_in_python(words: str) -> None:
    """Nothing but the wall is a row of its program, and nothing but that lets sensitivities be found while it runs."""
    bare = words[: words.index("[[body]]")] + words[words.index("[[input]]") :]
    scene = parse_scene(
        bare.replace('name = "payload"\nat = "payload"', 'name = "end"\nat = "upper"'), "bare.toml"
    )
    floor = {"frame": "upper", "normal": [0.4, 0.2, 2.0], "offset": 0.1, "margin": 0.01}
    bench = Bench.of(scene.replace(**{"control.keep": [floor], "control.horizon": 8}))
    assert not bench.step.carries
    emitted, python = compiled(bench, *emit_controller(bench, "rti-zero")), in_python(bench, "rti-zero")
    plant = plant_of(bench.scene, bench.problem, CONDITIONS[0])
    for k in range(24):
        if k == 16:
            assert emitted.aim(np.array([0.5, 0.1])) is python.aim(np.array([0.5, 0.1])) is Status.OK
        seen = plant.measured()
        expected, found = python.command(seen), emitted.command(seen)
        assert_allclose(found.torque, expected.torque, rtol=0.0, atol=DAQP)
        assert found.status is expected.status is Status.OK
        plant.advance(expected.torque)
    angles = np.array([state["angle"] for state in plant.states])
    wall = Wall.of(plant.scene, bench.problem.keeps[0])
    assert -0.01 < np.min(wall.along(angles)) - floor["offset"] < 0.01  # it was met


@pytest.mark.parametrize("kind", ["rti", "rti-zero"])
def test_a_reference_that_is_followed_is_that_of_python(kind: str, walled: Bench) -> None:
    """Into walls; what cannot be reached leaves the reference as it was, and a step ends it."""
    late = Bench.of(walled.scene.replace(**{"control.delay": 0.03, "control.bounds.torque_rate": 40.0}))
    emitted, python = compiled(late, *emit_controller(late, kind)), in_python(late, kind)
    plant, horizon = plant_of(late.scene, late.problem, CONDITIONS[0]), late.problem.horizon
    share = np.clip((np.arange(40) - 3.0) / 16.0, 0.0, 1.0)[:, None]
    way = share**3 * (10.0 - 15.0 * share + 6.0 * share**2)
    course = Course(late.problem.start + way * (np.array([0.6, 0.1]) - late.problem.start))
    for k in range(24):
        if k < 16:
            ahead = course.ahead(k, horizon)
            assert emitted.follow(ahead) is python.follow(ahead) is Status.OK
        elif k == 20:  # so far away that zero order takes its sensitivities where the arm is
            turned = np.array([1.5, 0.2])
            assert emitted.aim(turned) is python.aim(turned) is Status.OK
        if k in (7, 9):
            payload = 0.5 if k == 7 else 0.4  # which it has
            assert emitted.carry(payload) is python.carry(payload) is Status.OK
        lost = np.full((horizon, 2), np.nan)
        assert emitted.follow(lost) is python.follow(lost) is Status.NOT_FINITE
        seen = plant.measured()
        expected, found = python.command(seen), emitted.command(seen)
        assert_allclose(found.torque, expected.torque, rtol=0.0, atol=DAQP)
        assert found.status is expected.status is Status.OK
        plant.advance(expected.torque)
    assert plant.angles()[2] > 0.3
    angles = np.array([state["angle"] for state in plant.states])
    near = [Wall.of(plant.scene, keep).along(angles) - keep.offset for keep in late.problem.keeps]
    assert np.min(near[0]) < 0.015  # the floor was met


def test_what_holds_up_a_rigid_arm_is_a_sum_of_products(bench: Bench) -> None:
    arm, hubs = arm_of(bench.scene), np.random.default_rng(2).uniform(-3.0, 3.0, (5, 2))
    weight = weight_of(arm, arm_of(bench.scene.replace(**{"body.payload.mass": 1.4})), 2)
    right = arm.rigid_torques(hubs, np.zeros_like(hubs), np.zeros_like(hubs))
    assert_allclose([weight.torques(hub) for hub in hubs], right, rtol=0.0, atol=1e-12)
    laden = arm_of(bench.scene.replace(**{"body.payload.mass": 0.9}))
    asked = laden.rigid_torques(hubs, np.zeros_like(hubs), np.zeros_like(hubs)) - right
    heavier = Weight(tuple(replace(term, amount=term.more) for term in weight.terms))
    assert_allclose([0.5 * heavier.torques(hub) for hub in hubs], asked, rtol=0.0, atol=1e-12)
    assert len(weight.terms) < 4  # the yaw carries nothing, and turns nothing that weighs


def test_accelerometers_and_gauges_are_those_of_python(reach: Scene) -> None:
    """Full sensitivities: two accelerometers at the payload, a gauge on the beam, each there or not at random.

    The last of 30 directions are carried by slopes that are gathered first, the first few by sweeps of their own.
    """
    sensors = {"control.sensors.accelerometer": 0.02, "control.sensors.strain": {"lift": 0.01}}
    felt = Bench.of(reach.replace(**sensors))
    name, files = emit_controller(felt, "rti")
    (many,) = re.findall(r"if \(newest >= (\d+)\) \{ /\* so many directions", files[f"{name}.c"])
    assert 8 <= int(many) < 30
    emitted, python = compiled(felt, name, files), in_python(felt, "rti")
    plant, random = plant_of(felt.scene, felt.problem, CONDITIONS[1], seed=2), np.random.default_rng(5)
    statuses = []
    for _ in range(30):
        seen, valid = plant.measured(), random.random(6) < 0.85
        expected, found = python.command(seen, valid), emitted.command(np.where(valid, seen, 7.0), valid)
        assert_allclose(found.torque, expected.torque, rtol=0.0, atol=1e-10)
        assert found.status is expected.status
        statuses.append(found.status)
        plant.advance(expected.torque)
    assert {Status.OK, Status.REDUCED} <= set(statuses)


def test_linear_control_is_that_of_python(reach: Scene) -> None:
    """By modes, late, with all sensors; encoders lost for long, so that the safe law holds the arm up.

    It is told to rest elsewhere, to follow a way, of payloads that its model is good for and one that it is not.
    """
    sensors = {"control.sensors.accelerometer": 0.02, "control.sensors.strain": {"lift": 0.01}}
    felt = Bench.of(reach.replace(**sensors, **{"control.delay": 0.03}))
    emitted, python = compiled(felt, *emit_controller(felt, "mpc-modes")), BY_NAME["mpc-modes"].make(felt)
    assert isinstance(python, LinearMpc)
    plant, random = plant_of(felt.scene, felt.problem, CONDITIONS[1], seed=2), np.random.default_rng(5)
    statuses, horizon, start = [], felt.problem.horizon, felt.problem.start
    course = Course(start + np.linspace(0.0, 1.0, 40)[:, None] * (np.array([0.4, 0.2]) - start))
    payloads = {4: 0.45, 18: 0.0, 40: 9.0, 44: 0.35}
    for k in range(70):
        if k in payloads:
            taken = Status.INFEASIBLE if payloads[k] > 5.0 else Status.OK
            assert emitted.carry(payloads[k]) is python.carry(payloads[k]) is taken
        if 8 <= k < 16:
            ahead = course.ahead(k, horizon)
            assert emitted.follow(ahead) is python.follow(ahead) is Status.OK
        if k == 48:
            elsewhere = felt.problem.reference + np.array([-3.0, 0.2])
            assert emitted.aim(elsewhere) is python.aim(elsewhere) is Status.OK
        seen, valid = plant.measured(), random.random(6) < 0.9
        valid[:2] &= not 25 <= k < 35
        expected, found = python.command(seen, valid), emitted.command(np.where(valid, seen, 7.0), valid)
        assert_allclose(found.torque, expected.torque, rtol=0.0, atol=1e-10)
        assert found.status is expected.status
        statuses.append(found.status)
        plant.advance(expected.torque)
    assert {Status.OK, Status.REDUCED, Status.MEASUREMENT} <= set(statuses)
