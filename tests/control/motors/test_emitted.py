"""Emitted C for several motors: the torques of Python, silence of compilers, and recovery whatever encoders show."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tmm_gen.closed_loop.plant import Plant
from tmm_gen.control.arm.plane_frame import PlaneFrame
from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Status
from tmm_gen.control.condition import CONDITIONS, Condition
from tmm_gen.control.estimators.extended_kalman import NonlinearFilter
from tmm_gen.control.estimators.kalman import present_sensors
from tmm_gen.control.goals.course import Course
from tmm_gen.control.goals.target import rest_with
from tmm_gen.control.laws.rti import RealTimeIteration
from tmm_gen.control.quadratic.walls import Wall
from tmm_gen.onboard.emit import emit_controller
from tmm_gen.onboard.native import EmittedController

pytestmark = pytest.mark.compiler

FLOOR = {"frame": "payload", "normal": [0.0, 2.0], "offset": 0.3, "margin": 0.01}
WARNINGS = (
    *(
        "-std=c99",
        "-pedantic",
        "-Wall",
        "-Wextra",
        "-Wconversion",
        "-Wdouble-promotion",
        "-Wshadow",
        "-Wundef",
    ),
    *("-Wstrict-prototypes", "-Wmissing-prototypes", "-Werror", "-O1", "-c", "-I."),
)


@pytest.fixture(scope="module")
def late(two: Bench) -> Bench:
    """With a delay of two samples and a half, bounds of how fast torques change, and a shoulder that is rather weak."""
    changes = {
        "control.delay": 0.05,
        "control.bounds.torque_rate": {"shoulder": 10.0, "elbow": 1.0},
        "control.bounds.torque.shoulder": [-0.15, 0.044],
        "initial.angles": {"upper": 0.5, "forearm": 0.5},
    }
    return Bench.of(two.scene.replace(**changes))


@pytest.fixture(scope="module")
def walled(late: Bench) -> Bench:
    """With a floor under the payload, and a wall behind the elbow that it never comes near."""
    behind = {"frame": "upper", "normal": [1.0, 0.5], "offset": 0.1, "margin": 0.02, "weight": 300.0}
    return Bench.of(late.scene.replace(**{"control.keep": [FLOOR, behind]}))


def compiled(bench: Bench, name: str, files: dict[str, str]) -> EmittedController:
    """Return an emitted controller."""
    flags, motors = ("-O1", "-ffp-contract=off"), bench.problem.count
    return EmittedController(name, files, present_sensors(bench.problem), flags=flags, motors=motors)


@pytest.mark.parametrize(("kind", "which"), [("rti-zero", "two"), ("rti-zero", "walled"), ("rti", "walled")])
def test_torques_are_those_of_python(
    kind: str, which: str, request: pytest.FixtureRequest, tmp_path: Path
) -> None:
    """Closed loops with half as much payload again, twenty samples; warnings are errors."""
    bench: Bench = request.getfixturevalue(which)
    name, files = emit_controller(bench, kind)
    for path, text in files.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
    sources = [path for path in files if path.endswith(".c") and not path.startswith("daqp/")]
    done = subprocess.run(
        ["gcc", *WARNINGS, *sources], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.stderr == ""
    emitted = compiled(bench, name, files)
    python = RealTimeIteration(bench.step, bench.links, bench.inertia, kind == "rti-zero")
    python.estimator = NonlinearFilter(bench.step, bench.links)
    python.reset()
    plant = Plant(bench.scene, bench.problem, CONDITIONS[1])
    before = bench.links.start_torque
    for _ in range(20):
        seen = plant.measured()
        expected, found = python.command(seen), emitted.command(seen)
        np.testing.assert_allclose(found.torque, expected.torque, rtol=0.0, atol=1e-10)
        assert found.status is expected.status is Status.OK
        assert np.all(np.abs(found.torque - before) <= bench.problem.torque_rate * 0.02 + 1e-12)
        before = found.torque
        plant.advance(expected.torque)


def test_walls_and_sensors_behind_the_encoders_together(walled: Bench) -> None:
    """Of zero order, each sensor there or not at random, all encoders lost for long; into the floor, far from the goal.

    Sensitivities are found where the arm is on its way, which its torques do not hold there.
    """
    sensors = {"control.sensors.accelerometer": {"elbow": 0.02}, "control.sensors.strain": 0.002}
    felt = Bench.of(walled.scene.replace(**sensors))
    emitted = compiled(felt, *emit_controller(felt, "rti-zero"))
    python = RealTimeIteration(felt.step, felt.links, felt.inertia, zero_order=True)
    python.estimator = NonlinearFilter(felt.step, felt.links)
    python.reset()
    plant, random = Plant(felt.scene, felt.problem, CONDITIONS[1], seed=2), np.random.default_rng(5)
    statuses, found_about = [], {id(python.prepared)}
    for k in range(40):
        seen, valid = plant.measured(), random.random(6) < 0.85
        valid[:2] &= not 20 <= k < 27
        expected, found = python.command(seen, valid), emitted.command(np.where(valid, seen, 7.0), valid)
        np.testing.assert_allclose(found.torque, expected.torque, rtol=0.0, atol=1e-10)
        assert found.status is expected.status
        statuses.append(found.status)
        found_about.add(id(python.prepared))
        plant.advance(expected.torque)
    assert {Status.OK, Status.REDUCED, Status.MEASUREMENT} <= set(statuses)
    assert len(found_about) > 1
    angles = np.array([state["angle"] for state in plant.states])
    floor = felt.problem.keeps[0]
    assert np.min(Wall.of(plant.scene, floor).along(angles)) < floor.offset + floor.margin


@pytest.fixture(scope="module")
def pairs(walled: Bench) -> Callable[[str], tuple[EmittedController, RealTimeIteration]]:
    """Return a controller in C and its like in Python, as after a reset, each made once; they keep from walls."""

    @cache
    def make(kind: str) -> tuple[EmittedController, RealTimeIteration]:
        python = RealTimeIteration(walled.step, walled.links, walled.inertia, kind == "rti-zero")
        python.estimator = NonlinearFilter(walled.step, walled.links)
        return compiled(walled, *emit_controller(walled, kind)), python

    def anew(kind: str) -> tuple[EmittedController, RealTimeIteration]:
        for each in make(kind):
            each.reset()
        return make(kind)

    return anew


def follow_both(emitted: EmittedController, python: RealTimeIteration, seen: np.ndarray) -> np.ndarray:
    """Return the torques of both, which must be the same, as their statuses must."""
    expected, found = python.command(seen), emitted.command(seen)
    np.testing.assert_allclose(found.torque, expected.torque, rtol=0.0, atol=1e-10)
    assert found.status is expected.status
    return found.torque


def test_a_reference_that_moves_is_that_of_python(
    late: Bench, pairs: Callable[[str], tuple[EmittedController, RealTimeIteration]]
) -> None:
    """A step, then a little at a time; what cannot be reached, or held, leaves it as it was."""
    emitted, python = pairs("rti")
    plant, wanted = Plant(late.scene, late.problem, CONDITIONS[0]), late.problem.reference
    for k in range(16):
        plant.advance(follow_both(emitted, python, plant.measured()))
        if k >= 2:
            wanted = np.array([0.5, -0.3]) if k == 2 else wanted + np.array([0.01, -0.02])
            assert emitted.aim(wanted) is python.aim(wanted) is Status.OK
        far = [0.5 + 204.0 * np.pi, -0.3]  # the same place a hundred and two turns on
        for reference, status in (
            ([np.nan, 0.0], Status.NOT_FINITE),
            ([0.0, 0.0], Status.INFEASIBLE),
            (far, Status.INFEASIBLE),
        ):
            assert emitted.aim(np.array(reference)) is python.aim(np.array(reference)) is status
    assert python.goal.hub == pytest.approx(wanted)


def course_of(late: Bench, samples: int) -> Course:
    """Return a way that begins where the arm rests, and ends at [0.6, -0.5]."""
    t = np.clip((np.arange(samples) - 3.0) / 14.0, 0.0, 1.0)[:, None]
    share = t**3 * (10.0 - 15.0 * t + 6.0 * t**2)
    return Course(late.problem.start + share * (np.array([0.6, -0.5]) - late.problem.start))


@pytest.mark.parametrize("kind", ["rti", "rti-zero"])
def test_a_reference_that_is_followed_is_that_of_python(
    kind: str, late: Bench, pairs: Callable[[str], tuple[EmittedController, RealTimeIteration]]
) -> None:
    """Told sample by sample, or left to itself for some; what cannot be reached leaves it as it was."""
    emitted, python = pairs(kind)
    plant, horizon = Plant(late.scene, late.problem, CONDITIONS[0]), late.problem.horizon
    course, wrong = course_of(late, 40), np.full((horizon, 2), np.nan)
    for k in range(28):
        ahead = course.ahead(k, horizon)
        if k not in (8, 9, 10):
            assert emitted.follow(ahead) is python.follow(ahead) is Status.OK
        for reference, status in ((wrong, Status.NOT_FINITE), (np.zeros_like(wrong), Status.INFEASIBLE)):
            assert emitted.follow(reference) is python.follow(reference) is status
        plant.advance(follow_both(emitted, python, plant.measured()))
    # the elbow was at 0 and is to come to -0.5, which is through the floor; the shoulder is too weak to keep up
    frame, angles = (
        PlaneFrame.of(plant.scene, "payload"),
        np.array([state["angle"] for state in plant.states]),
    )
    assert np.min(frame.place(angles)[:, 1]) > FLOOR["offset"]
    resting = python.rest[late.step.places("angle")]
    assert PlaneFrame.of(late.scene, "payload").place(resting)[1] < FLOOR["offset"] - 0.05


LIMITS = {
    2: ([-9.0, -0.05], [0.03, 9.0], Status.OK),  # the last torque is beyond, and may not change so fast
    5: ([np.nan, 0.0], [0.1, 0.1], Status.NOT_FINITE),
    6: ([0.0, 0.01], [0.1, 0.0], Status.INFEASIBLE),  # crossed
    7: ([0.1, -0.1], [0.2, 0.1], Status.INFEASIBLE),  # all beyond the widest
    8: ([0.01, -0.02], [0.01, -0.01], Status.OK),  # nothing to choose; no zero
    13: ([-9.0, 0.04], [9.0, 9.0], Status.OK),  # the elbow's last torque is beyond from below
    14: ([-9.0, -9.0], [9.0, 9.0], Status.OK),
}
PAYLOADS = {
    1: (0.2, Status.OK),
    3: (np.nan, Status.NOT_FINITE),
    4: (-0.1, Status.NOT_FINITE),
    11: (1e300, Status.NOT_FINITE),
    12: (0.25, Status.INFEASIBLE),  # not within the bounds of that time
    15: (0.0, Status.OK),
    18: (0.3, Status.OK),
}


@pytest.mark.parametrize("kind", ["rti", "rti-zero"])
def test_bounds_and_payload_told_at_run_time_are_those_of_python(
    kind: str, late: Bench, pairs: Callable[[str], tuple[EmittedController, RealTimeIteration]]
) -> None:
    """Along a trajectory, with encoders lost for a while: bounds are kept, and what cannot be changes nothing."""
    emitted, python = pairs(kind)
    plant, course = Plant(late.scene, late.problem, CONDITIONS[0]), course_of(late, 40)
    widest = low, high = late.problem.torque
    for k in range(24):
        told = course.ahead(k, late.problem.horizon)
        assert emitted.follow(told) is python.follow(told)
        if k in PAYLOADS:
            payload, status = PAYLOADS[k]
            assert emitted.carry(payload) is python.carry(payload) is status, k
        for each in (emitted, python):
            if k % 2:
                each.prepare()
        if k in LIMITS:
            lower, upper, status = LIMITS[k]
            assert emitted.limit(np.array(lower), np.array(upper)) is status, k
            assert python.limit(np.array(lower), np.array(upper)) is status, k
            if status is Status.OK:
                low, high = np.maximum(lower, widest[0]), np.minimum(upper, widest[1])
        seen = plant.measured() * ([np.nan, np.nan, 1, 1, 1, 1] if k in (9, 10) else 1.0)
        torque = follow_both(emitted, python, seen)
        assert np.all((torque >= low - 1e-12) & (torque <= high + 1e-12)), k
        plant.advance(torque)


def test_told_before_its_first_sample_an_arm_rests_with_what_it_carries(two: Bench) -> None:
    """Sent to where it stands, it is held there by the torques that this takes, in Python and in C."""
    start = two.links.start_hub
    held = rest_with(two.step.carrying(0.05).scene, start, "here").goal.torque
    assert np.all(np.abs(two.links.start_torque) > 1.5 * np.abs(held))
    name, files = emit_controller(two, "rti-zero")
    seen = np.append(start, 4 * [np.nan])
    for controller in (
        compiled(two, name, files),
        RealTimeIteration(two.step, two.links, two.inertia, zero_order=True),
    ):
        controller.reset()
        assert controller.aim(start) is Status.OK
        assert controller.carry(0.05) is Status.OK
        for _ in range(5):
            # the cost to go is of another payload, and trades a little torque
            assert_allclose(controller.command(seen).torque, held, rtol=0.01)


def test_encoders_that_come_and_go_are_those_of_python(two: Bench) -> None:
    """Flags at random, prepared or not at random: torques, statuses and bounds."""
    name, files = emit_controller(two, "rti-zero")
    emitted = compiled(two, name, files)
    python = RealTimeIteration(two.step, two.links, two.inertia, zero_order=True)
    plant, random = Plant(two.scene, two.problem, CONDITIONS[1]), np.random.default_rng(5)
    low, high = two.problem.torque
    statuses = []
    for _ in range(60):
        seen, valid = plant.measured(), random.random(6) < 0.75
        for each in (emitted, python):
            for _ in range(random.integers(3)):
                each.prepare()
        expected, found = python.command(seen, valid), emitted.command(np.where(valid, seen, 7.0), valid)
        np.testing.assert_allclose(found.torque, expected.torque, rtol=0.0, atol=1e-10)
        assert found.status is expected.status
        assert np.all((found.torque >= low) & (found.torque <= high))
        statuses.append(found.status)
        plant.advance(expected.torque)
    assert {Status.OK, Status.REDUCED, Status.MEASUREMENT} <= set(statuses)


SPELLS = {
    "all lost": (np.nan, np.nan),
    "elbow lost": (0.0, np.nan),
    "shoulder a turn off": (2.0 * np.pi, 0.0),
    "absurd": (1e300, -1e300),
    "elbow off": (0.0, 0.7),
}


@pytest.fixture(scope="module")
def firm(firm_bench: Bench) -> tuple[Bench, EmittedController]:
    """The arm that does not tremble, and its controller."""
    return firm_bench, compiled(firm_bench, *emit_controller(firm_bench, "rti-zero"))


@pytest.mark.parametrize(("case", "most"), [(CONDITIONS[0], 0.005), (CONDITIONS[1], 0.03)])
def test_the_arm_does_not_sink_while_encoders_are_lost(
    case: Condition, most: float, firm: tuple[Bench, EmittedController]
) -> None:
    """In a vertical plane, for a second, by more than this angle (rad); a law that only brakes lets it fall by 2."""
    bench, controller = firm
    for lost in ([1], [0], [0, 1]):
        controller.reset()
        plant, flags, statuses = Plant(bench.scene, bench.problem, case), np.ones(6, bool), []
        for k in range(80 + 50 + 25):
            if k == 80:
                rested = plant.angles()
            flags[lost] = not 80 <= k < 130
            command = controller.command(plant.measured(), flags)
            statuses.append(command.status)
            plant.advance(command.torque)
            assert k < 80 or np.abs(plant.angles() - rested).max() < most, (lost, k)
        assert set(statuses[86:130]) == {Status.MEASUREMENT}
        assert statuses[-1] is Status.OK


def test_all_is_well_a_second_after_the_last_wrong_sample(firm: tuple[Bench, EmittedController]) -> None:
    """Whatever the encoders showed for 15 samples: OK again within a second, the bounds kept throughout."""
    bench, controller = firm
    low, high = bench.problem.torque
    for spell, added in SPELLS.items():
        controller.reset()
        plant, statuses = Plant(bench.scene, bench.problem, CONDITIONS[0]), []
        for k in range(10 + 15 + 150):
            seen = plant.measured()
            if 10 <= k < 25:
                seen[:2] += added
            command = controller.command(seen)
            statuses.append(command.status)
            assert np.all((command.torque >= low) & (command.torque <= high)), spell
            plant.advance(command.torque)
        assert set(statuses[10:25]) != {Status.OK}, spell
        assert Status.OK in statuses[25:75], spell
        assert set(statuses[75:]) == {Status.OK}, spell
        np.testing.assert_allclose(plant.angles()[2:], bench.problem.reference, atol=5e-3, err_msg=spell)
