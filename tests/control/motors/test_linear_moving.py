"""Linear controllers that are told of other references and payloads while they run: C does what Python does."""

from __future__ import annotations

import ctypes

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tmm_gen.closed_loop.plant import Plant
from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Status
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.controllers import BY_NAME
from tmm_gen.control.estimators.kalman import KalmanFilter, present_sensors
from tmm_gen.control.goals.course import Course
from tmm_gen.control.goals.target import rest_with
from tmm_gen.control.laws.linear_mpc import LinearMpc
from tmm_gen.errors import UserError
from tmm_gen.onboard.emit import emit_controller
from tmm_gen.onboard.native import EmittedController

BOUNDED = {
    "control.delay": 0.03,
    "control.bounds.torque_rate": {"shoulder": 10.0, "elbow": 1.0},
    "control.bounds.hub_rate": 4.0,
    "control.bounds.hub": None,
}
FELT = {"control.sensors.accelerometer": {"elbow": 0.02}, "control.sensors.strain": 0.002}
DAQP = 1e-9
"""Both solve the same program to its tolerance, by ways of their own, N m."""
FAR = np.array([1.2, 2.2])
"""Further from the scene's reference than a linear model of it is good."""


def linear(bench: Bench, kind: str) -> LinearMpc:
    """Return the controller in Python."""
    found = BY_NAME[kind].make(bench)
    assert isinstance(found, LinearMpc)
    return found


def compiled(bench: Bench, kind: str, real: str = "float64") -> EmittedController:
    """Return it in C; warnings are errors."""
    name, files = emit_controller(bench, kind, real)
    flags = ("-O1", "-ffp-contract=off", "-pedantic", "-Wall", "-Wextra", "-Wshadow", "-Wundef", "-Werror")
    sensors = present_sensors(bench.problem)
    return EmittedController(name, files, sensors, real, flags=flags, motors=bench.problem.count)


def course_of(bench: Bench, end: np.ndarray, samples: int) -> Course:
    """Return a way from where the scene starts."""
    t = np.clip((np.arange(samples) - 3.0) / 14.0, 0.0, 1.0)[:, None]
    share = t**3 * (10.0 - 15.0 * t + 6.0 * t**2)
    return Course(bench.problem.start + share * (end - bench.problem.start))


@pytest.fixture(scope="module", params=["links", "modes"])
def pair(request: pytest.FixtureRequest, two: Bench) -> tuple[Bench, EmittedController, LinearMpc]:
    """With a delay and bounds of everything by links, with all sensors by modes."""
    bench = Bench.of(two.scene.replace(**(BOUNDED if request.param == "links" else FELT)))
    kind = f"mpc-{request.param}"
    return bench, compiled(bench, kind), linear(bench, kind)


@pytest.mark.compiler
def test_what_is_told_makes_the_torques_of_python(pair: tuple[Bench, EmittedController, LinearMpc]) -> None:
    """From where the model is not good: a way told sample by sample and left to itself, steps, payloads.

    Encoders are lost meanwhile.
    """
    bench, emitted, python = pair
    for each in (emitted, python):
        each.reset()
    problem = bench.problem
    plant, random = Plant(bench.scene, problem, CONDITIONS[1], seed=4), np.random.default_rng(7)
    start = rest_with(plant.scene, np.array([0.3, 0.9]), "here")
    plant.kernel.initialise(initial_angle=start.angles, inputs=plant.motors.torques(start.goal.torque))
    course, taken, far = course_of(bench, np.array([0.6, -0.9]), 60), 0, 0
    aims = {40: [0.9, -0.8], 44: [0.92, -0.82], 58: FAR, 96: problem.reference}
    payloads = {6: 0.35, 12: 0.0, 57: 0.28, 112: 0.3}
    for k in range(130):
        if k < 26 and k not in (8, 9, 10):
            ahead = course.ahead(k, problem.horizon)
            assert emitted.follow(ahead) is python.follow(ahead) is Status.OK
        if k in aims:
            assert emitted.aim(np.array(aims[k])) is python.aim(np.array(aims[k])) is Status.OK
        if k in payloads:
            assert emitted.carry(payloads[k]) is python.carry(payloads[k]) is Status.OK
        seen, valid = plant.measured(), random.random(6) < (0.9 if 14 < k < 36 else 1.0)
        valid[:2] &= not 48 <= k < 56
        if k % 3:
            emitted.prepare()
            python.prepare()
        expected, found = python.command(seen, valid), emitted.command(np.where(valid, seen, 7.0), valid)
        assert_allclose(found.torque, expected.torque, rtol=0.0, atol=DAQP)
        assert found.status is expected.status, k
        far += bool(np.any(np.abs(python.estimator.hubs()[0] - problem.reference) > python.range))
        taken += found.status is Status.OK
        plant.advance(expected.torque)
    assert taken > 60
    assert 3 < far < 70


@pytest.mark.compiler
def test_what_cannot_be_leaves_what_was_told(pair: tuple[Bench, EmittedController, LinearMpc]) -> None:
    bench, emitted, python = pair
    for each in (emitted, python):
        each.reset()
        assert each.aim(np.array([0.7, -1.0])) is Status.OK
    horizon = bench.problem.horizon
    level = np.zeros(2)  # too heavy for a quarter of the torques
    for each in (emitted, python):
        low, high = bench.problem.torque
        assert each.limit(0.25 * low, 0.25 * high) is Status.OK
        refused = {
            (np.nan, 0.0): Status.NOT_FINITE,
            (0.7 + 22.0 * np.pi, -1.0): Status.INFEASIBLE,
            (*level,): Status.INFEASIBLE,
        }
        for reference, status in refused.items():
            assert each.aim(np.array(reference)) is status
            assert each.follow(np.tile(reference, (horizon, 1))) is status
        for payload, status in (
            (-0.1, Status.NOT_FINITE),
            (np.inf, Status.NOT_FINITE),
            (9.0, Status.INFEASIBLE),
        ):
            assert each.carry(payload) is status
    library, nothing = emitted._library, ctypes.c_void_p()
    for name in ("aim", "follow"):
        asked = getattr(library, f"{emitted.name}_{name}")
        assert asked(emitted._aligned(), nothing) == asked(nothing, nothing) == 8
    assert getattr(library, f"{emitted.name}_carry")(nothing, emitted._number(0.3)) == 8
    assert_allclose(python.reference, [0.7, -1.0])
    plant = Plant(bench.scene, bench.problem, CONDITIONS[0])
    for _ in range(5):
        seen = plant.measured()
        expected, found = python.command(seen), emitted.command(seen)
        assert_allclose(found.torque, expected.torque, rtol=0.0, atol=DAQP)
        plant.advance(expected.torque)


@pytest.mark.parametrize("where", [[0.6, -0.9], [0.1, -0.4]])
def test_a_target_that_moved_is_rest_there(two: Bench, where: list[float]) -> None:
    """Torques against the statics of the arm that sags; the estimate of the arm stays what it was."""
    python, hub = linear(two, "mpc-links"), np.array(where)
    estimator = python.estimator
    before = estimator.hubs()[0]
    estimator.stand(python.places.at(hub))
    assert_allclose(estimator.hubs()[0], before, rtol=0.0, atol=1e-12)
    rest = rest_with(two.step.scene, hub, "here")
    largest = np.max(np.abs(two.problem.torque), axis=0)
    assert_allclose(estimator.place.goal.torque, rest.goal.torque, rtol=0.0, atol=0.06 * largest.min())
    assert_allclose(estimator.place.goal.tip, rest.goal.tip, atol=0.05)
    # with no torque beside those that hold it, it stays
    estimator.estimate[:] = 0.0
    estimator.advance((estimator.place.goal.torque, estimator.place.goal.torque), estimator.place.goal.torque)
    assert_allclose(estimator.estimate, 0.0, atol=1e-12)


def test_small_moves_are_exact_to_first_order(two: Bench) -> None:
    """How the arm rests 1 mrad further on, against the statics."""
    python, step = linear(two, "mpc-links"), 1e-3
    reference, places = two.problem.reference, two.step.places("angle")
    for each in np.eye(2):
        moved = python.places.at(reference + step * each).state
        rests = [rest_with(two.step.scene, reference + way * step * each, "here").angles for way in (1, 0)]
        assert_allclose(moved[places], rests[0] - rests[1], rtol=0.0, atol=2e-3 * step)


@pytest.mark.compiler
def test_an_arm_that_was_thrown_comes_back(firm_bench: Bench) -> None:
    """From folded, turns away, with any payload that it was told of; in single precision."""
    controller = compiled(firm_bench, "mpc-links", "float32")
    plant = Plant(firm_bench.scene, firm_bench.problem, CONDITIONS[0])
    start = rest_with(plant.scene, np.array([-4.0, 3.5]), "here")
    held = np.clip(start.goal.torque, *firm_bench.problem.torque)
    for payload in (0.0, 0.3, 0.45):
        plant.kernel.prepare({"tip_mass": payload}, plant.step)
        plant.kernel.initialise(initial_angle=start.angles, inputs=plant.motors.torques(held))
        controller.reset()
        assert controller.carry(payload) is Status.OK
        statuses = []
        for _ in range(240):
            command = controller.command(plant.measured())
            statuses.append(command.status)
            plant.advance(command.torque)
        assert set(statuses[6:]) == {Status.OK}
        assert_allclose(plant.angles()[2:], firm_bench.problem.reference, atol=5e-3)


def test_an_arm_on_a_hub_is_told_nothing(bench: Bench) -> None:
    python = linear(bench, "mpc-modes")
    for told in (
        lambda: python.aim(np.zeros(1)),
        lambda: python.follow(np.zeros((30, 1))),
        lambda: python.carry(1.0),
    ):
        with pytest.raises(UserError, match="by name"):
            told()


def test_a_payload_that_nothing_holds_up_is_none_to_be_told_of(two: Bench) -> None:
    """No weight, no `_carry`."""
    level = Bench.of(two.scene.replace(**{"model.gravity": 0.0}))
    python = linear(level, "mpc-links")
    with pytest.raises(UserError, match="held up"):
        python.carry(0.2)
    name, files = emit_controller(level, "mpc-links")
    assert f"{name}_aim(" in files[f"{name}.h"]
    assert f"{name}_carry(" not in files[f"{name}.h"]
    assert isinstance(python.estimator, KalmanFilter)
