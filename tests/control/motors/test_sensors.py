"""Accelerometers and strain gauges of arms by parts: what they show, that estimates are the better for it, and in C."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tmm_gen.closed_loop.figures import Figures, loop_figures
from tmm_gen.closed_loop.loop import run_loop
from tmm_gen.closed_loop.plant import Plant
from tmm_gen.control.arm.plane_frame import PlaneFrame
from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Status
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.controllers import BY_NAME
from tmm_gen.control.estimators.extended_kalman import ExtendedKalmanFilter, NonlinearFilter
from tmm_gen.control.estimators.kalman import present_sensors
from tmm_gen.control.goals.target import find_target, rest_with
from tmm_gen.control.laws.rti import RealTimeIteration
from tmm_gen.control.prediction.links import target_state
from tmm_gen.control.sensors.sensing import Sensing, sites_of
from tmm_gen.errors import UserError
from tmm_gen.onboard.emit import emit_controller
from tmm_gen.onboard.native import EmittedController
from tmm_gen.scene import Scene
from tmm_gen.scene.problem import SceneError

pytestmark = pytest.mark.compiler

SENSORS = {
    "control.sensors.accelerometer": {"elbow": 0.02},
    "control.sensors.strain": 0.002,
    "control.estimator.accelerometer": 3.0,
    "control.estimator.strain": 0.3,
}


@pytest.fixture(scope="module")
def felt(two: Bench) -> Bench:
    """The small arm with an accelerometer at its end, a gauge on each beam, and torques that are late."""
    return Bench.of(two.scene.replace(**SENSORS, **{"control.delay": 0.03}))


def test_accelerometers_feel_second_differences_of_places(elbow: Scene) -> None:
    """Across the last link of either motor, of any motion, weight included."""
    bench = Bench.of(elbow.replace(**{"control.sensors.accelerometer": 0.1}))
    sensing, random = bench.step.sensing, np.random.default_rng(1)
    angles, rates, growth = random.uniform(-1.0, 1.0, (3, sensing.size)) * np.array([[1.0], [4.0], [50.0]])
    found = sensing.values(angles, rates, growth)
    time = 1e-4
    for motor, name in enumerate(("upper", "forearm")):
        frame = PlaneFrame.of(bench.step.scene, name)
        before, now, after = (
            frame.place(angles + t * rates + 0.5 * t**2 * growth) for t in (-time, 0.0, time)
        )
        pushed = (before - 2.0 * now + after) / time**2 + [0.0, 9.81]
        last = angles[bench.step.motors.each[motor].end - 1]
        assert found[motor] == pytest.approx(pushed @ [-np.sin(last), np.cos(last)], abs=1e-4)
    assert_allclose(found[2:], 0.0)


@pytest.mark.parametrize("cells", [0, 20])
def test_gauges_show_what_hangs_beyond_them(cells: int, elbow: Scene) -> None:
    """At rest, the moment of all weight beyond the middle of the first cell; also in more cells than it is told by."""
    scene = elbow.replace(**{"control.sensors.strain": 0.1})
    problem = Bench.of(scene).problem
    sites = sites_of(scene, problem.motors, problem)
    assert [(site.beam, site.place) for site in sites if site] == [
        ("upper", pytest.approx(0.05)),
        ("forearm", pytest.approx(0.04)),
    ]
    if cells:
        scene = scene.replace(**{"beam.upper.links": cells, "beam.forearm.links": cells})
    motors = Bench.of(scene).problem.motors
    rest = rest_with(scene, np.array([0.3, -0.7]), "control.reference")
    found = Sensing.of(scene, motors, problem, sites).values(rest.angles, 0 * rest.angles, 0 * rest.angles)
    lengths, masses = (np.array([getattr(link, name) for link in scene.links]) for name in ("length", "mass"))
    centers = np.array([link.center for link in scene.links])
    ends = np.cumsum(lengths * np.cos(rest.angles))
    places = ends - lengths * np.cos(rest.angles) * (1.0 - centers)
    for motor, at in enumerate((0.05, 0.04)):
        begin = motors.each[motor].place
        along = np.cumsum(lengths[begin:])
        root = ends[begin - 1] if begin else 0.0
        first = int(np.searchsorted(along, at + 1e-12))  # the link that the gauge is on
        here = root + np.sum(lengths[begin : begin + first] * np.cos(rest.angles[begin : begin + first]))
        share = at - (along[first - 1] if first else 0.0)
        here += share * np.cos(rest.angles[begin + first])
        beyond = np.arange(len(masses)) > begin + first - (share < 1e-9)
        moment = 9.81 * np.sum(masses[beyond] * (places[beyond] - here))
        assert scene.tip is not None
        moment += 9.81 * scene.tip.mass * (ends[-1] - here)
        assert found[2 + motor] == pytest.approx(-moment, rel=1e-2 if cells else 1e-9)


def test_the_arm_arrives_with_less_overshoot_and_nothing_left_over(firm_bench: Bench) -> None:
    """With half as much payload again, whose weight accelerometer and gauges show and nobody told of."""

    def figures(bench: Bench, kind: str) -> Figures:
        plant = Plant(bench.scene, bench.problem, CONDITIONS[1])
        return loop_figures(run_loop(BY_NAME[kind].make(bench), plant, 2.0, timed=False))

    more = Bench.of(firm_bench.scene.replace(**SENSORS))
    without, found = figures(firm_bench, "mpc-modes"), figures(more, "mpc-modes")
    assert found.overshoot < 0.5 * without.overshoot
    assert found.residual < without.residual
    for each in (found, figures(more, "rti")):  # a constant gain, and one along the motion
        assert abs(each.offset) < 1.5e-3
        assert not each.fallbacks


def test_the_extended_filter_corrects_at_the_target_as_that_of_constant_gain_does(felt: Bench) -> None:
    extended, constant = (kind(felt.step, felt.links) for kind in (ExtendedKalmanFilter, NonlinearFilter))
    state = target_state(felt.step, find_target(felt.step.scene, felt.problem))
    surprise, sensors = np.array([1e-3, -2e-3, 0.0, 0.4, 0.03, -0.02]), tuple(present_sensors(felt.problem))
    for each in (extended, constant):
        each.estimate[: len(state)] = state
        each.correct(surprise, sensors, np.ones(2))
    assert len(extended.estimate) == felt.step.size + 2 + 3
    assert_allclose(extended.estimate, constant.estimate, rtol=0.0, atol=1e-7 * np.ptp(constant.estimate))
    seen = np.where(np.isin(np.arange(6), sensors), 0.0, np.nan) + np.array(felt.step.sensors(state)).ravel()
    before = extended.surprise(seen)[3:]
    extended.estimate[-3:] += 1.0
    assert_allclose(extended.surprise(seen)[3:], before - 1.0)


def in_both(bench: Bench, kind: str) -> tuple[EmittedController, RealTimeIteration]:
    """Return a controller in C and its like in Python."""
    name, files = emit_controller(bench, kind)
    flags = ("-O0", "-ffp-contract=off", "-pedantic", "-Wall", "-Wextra", "-Wshadow", "-Wundef", "-Werror")
    emitted = EmittedController(
        name, files, present_sensors(bench.problem), flags=flags, motors=bench.problem.count
    )
    python = RealTimeIteration(bench.step, bench.links, bench.inertia, kind == "rti-zero")
    python.estimator = NonlinearFilter(bench.step, bench.links)
    python.reset()
    return emitted, python


@pytest.mark.parametrize("kind", ["rti-zero", "rti"])
def test_sensors_that_come_and_go_are_those_of_python(kind: str, felt: Bench) -> None:
    """Flags at random, and what cannot be: the same torques and statuses; soon after, all is well again."""
    emitted, python = in_both(felt, kind)
    plant, random = Plant(felt.scene, felt.problem, CONDITIONS[0], seed=3), np.random.default_rng(5)
    low, high = felt.problem.torque
    statuses = []
    for k in range(48):
        seen, valid = plant.measured(), random.random(6) < (0.8 if 5 <= k < 35 else 1.0)
        if k in (20, 21, 22):
            seen[3 + k % 3] = [1e300, -1e4, np.inf][k % 3]
        for each in (emitted, python):
            for _ in range(random.integers(2)):
                each.prepare()
        expected, found = python.command(seen, valid), emitted.command(np.where(valid, seen, 7.0), valid)
        assert_allclose(found.torque, expected.torque, rtol=0.0, atol=1e-10)
        assert found.status is expected.status, k
        assert np.all((found.torque >= low) & (found.torque <= high))
        statuses.append(found.status)
        plant.advance(expected.torque)
    assert {Status.OK, Status.REDUCED, Status.MEASUREMENT} <= set(statuses)
    assert set(statuses[41:]) == {Status.OK}


@pytest.mark.parametrize(
    ("sensor", "value"), [("accelerometer", {"wrist": 0.1}), ("strain", {"shoulder": 0.1, "ellbow": 0.1})]
)
def test_sensors_of_motors_there_are_not_are_refused(
    sensor: str, value: dict[str, float], elbow: Scene
) -> None:
    with pytest.raises(
        SceneError, match=rf"control\.sensors\.{sensor}\.\w+: is not the name of a driven motor"
    ):
        elbow.replace(**{f"control.sensors.{sensor}": value})


def test_more_sensors_than_a_controller_has_gains_for_are_refused(
    two: Bench, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As if there were four motors with both; the remedy is tried."""
    monkeypatch.setattr("tmm_gen.onboard.emit.MOST_BEHIND", 3)
    scene = two.scene.replace(**{"control.sensors.accelerometer": 0.1, "control.sensors.strain": 0.1})
    with pytest.raises(UserError, match=r"4 accelerometers and gauges: .* at most 3, .* \{ elbow = 0\.1 \}"):
        emit_controller(Bench.of(scene), "rti-zero")
    fewer = Bench.of(scene.replace(**{"control.sensors.accelerometer": {"elbow": 0.1}}))
    assert present_sensors(fewer.problem) == [0, 1, 3, 4, 5]
    assert emit_controller(fewer, "rti-zero")
