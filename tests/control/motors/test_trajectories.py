"""Trajectories and walls: the course a scene tells, how controllers follow it, how the arm keeps away from a floor."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tmm_gen.closed_loop.compare import Trial, compare
from tmm_gen.control.arm.arms import arm_of
from tmm_gen.control.arm.plane_frame import PlaneFrame
from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Status
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.controllers import BY_NAME
from tmm_gen.control.goals.course import begins_elsewhere, course_of
from tmm_gen.control.goals.target import rest_with
from tmm_gen.control.goals.window import Window
from tmm_gen.control.laws.following import Following
from tmm_gen.control.laws.full_nmpc import FullNmpc
from tmm_gen.control.laws.pose import Pose, pose_in
from tmm_gen.control.laws.rti import RealTimeIteration
from tmm_gen.control.task.terms import Wanted
from tmm_gen.errors import UserError
from tmm_gen.onboard.emit import usual_controller
from tmm_gen.scene import Scene, load_scene, parse_scene

ELBOW = Path(__file__).resolve().parents[3] / "scenes" / "elbow.toml"
FLOOR = {"frame": "payload", "normal": [0.0, 2.0], "offset": -0.25, "margin": 0.01}
DOWN = {"angles": {"shoulder": 0.0, "elbow": -1.0}, "duration": 0.6, "dwell": 0.3}


@pytest.fixture(scope="module")
def small(elbow: Scene) -> Scene:
    """Two springs in each beam, half the horizon."""
    changes = {"beam.upper.links": 2, "beam.forearm.links": 2, "control.horizon": 15, "control.substeps": 2}
    return elbow.replace(**changes)


@pytest.fixture(scope="module")
def lowered(small: Scene) -> Bench:
    """The payload goes down."""
    return Bench.of(small.replace(**{"control.trajectory": {"pose": [DOWN]}}))


def test_a_course_goes_by_quintics_and_stops(small: Scene) -> None:
    """Halfway in time is halfway; a part's position is reached by the arm as it sags, bent like the reference."""
    poses = [DOWN, {"frame": "payload", "position": [0.6, 0.2], "duration": 0.5, "dwell": 0.2}]
    scene = small.replace(**{"control.trajectory": {"pose": poses}, "control.bounds.hub": None})
    problem = Bench.of(scene).problem
    course = course_of(scene, problem)
    assert course is not None
    assert_allclose(course.angles[15], [0.0, -0.5], atol=1e-12)
    assert_allclose(course.at(np.array([30, 45])), [[0.0, -1.0]] * 2, atol=1e-12)
    assert course.stops(90) == [(30, 45), (70, 89)]
    assert_allclose(np.diff(course.angles[:4], axis=0)[0], 0.0, atol=1e-3)
    rest = rest_with(scene, course.angles[-1], "here")
    assert_allclose(PlaneFrame.of(scene, "payload").place(rest.angles), [0.6, 0.2], atol=1e-9)
    assert course.angles[-1, 1] < 0.0


def test_a_file_tells_joints_or_positions(small: Scene, tmp_path: Path) -> None:
    """The same way, told by angles and by where the payload rests with them."""
    times = np.linspace(0.0, 0.4, 11)
    angles = np.outer(np.sin(2.0 * times), [0.5, -1.0])
    frame = PlaneFrame.of(small, "payload")
    places = [frame.place(rest_with(small, row, "here").angles) for row in angles]
    for name, heading, rows in (
        ("joints", "shoulder,elbow", angles),
        ("places", "payload_x,payload_y", places),
    ):
        lines = [
            f"{t!r},{x!r},{y!r}" for t, (x, y) in zip(times.tolist(), np.array(rows).tolist(), strict=True)
        ]
        (tmp_path / f"{name}.csv").write_text("\n".join([f"time,{heading}", *lines]) + "\n")
    text = ELBOW.read_text()
    found = []
    for told in ('file = "joints.csv"', 'file = "places.csv"\nframe = "payload"'):
        (tmp_path / "elbow.toml").write_text(f"{text}\n[control.trajectory]\n{told}\n")
        changes = {"beam.upper.links": 2, "beam.forearm.links": 2}
        scene = load_scene(tmp_path / "elbow.toml").replace(**changes)
        course = course_of(scene, Bench.of(scene).problem)
        assert course is not None
        found.append(course.angles)
    assert len(found[0]) == 21
    assert_allclose(found[0][::2], angles, atol=1e-12)
    assert_allclose(found[1][4:], found[0][4:], atol=3e-3)  # cubic in between, of other curves


def test_a_part_stands_as_told(small: Scene, tmp_path: Path) -> None:
    """With a third motor, at the end of the forearm: where the outer link rests by all joints, a turn on as well."""
    text = small.source.data
    wrist = {"name": "wrist", "on": "forearm", "rotor_inertia": 1e-6, "gear": 50}
    hand = {"name": "hand", "on": "wrist", "length": 0.1, "mass": 0.1, "inertia": 1e-4}
    scene = small.replace(
        **{
            "motor": [*text["motor"], wrist],
            "link": [hand],
            "body": [body for body in text["body"] if body["name"] != "payload"],
            "input": [*text["input"], {"name": "wrist_torque", "at": "wrist", "acts": "torque"}],
            "output": [{"name": "hand", "at": "hand", "of": "position"}],
            "control": {
                "reference": {"shoulder": 0.5, "elbow": -0.8, "wrist": 0.2},
                "bounds": {"torque": 0.2},
            },
        }
    )
    there = np.array([0.4, -0.9, 0.6])
    angles = rest_with(scene, there, "here").angles
    place = PlaneFrame.of(scene, "hand").place(angles)
    for orientation in (angles[-1], angles[-1] - 2.0 * np.pi):
        pose = {"frame": "hand", "position": place.tolist(), "orientation": orientation, "duration": 0.4}
        turned = scene.replace(**{"control.trajectory": {"pose": [pose]}})
        course = course_of(turned, Bench.of(turned).problem)
        assert course is not None
        assert_allclose(course.angles[-1], there, atol=1e-8)
    # the same by a file, whose angles are those of an arm that went all the way round
    angle = angles[-1] - np.pi
    way = [[0.0, *place, angle + np.pi], [0.2, *place, angle - np.pi], [0.4, *place, angle - 3.0 * np.pi]]
    lines = [
        "time,hand_x,hand_y,hand_angle",
        *(",".join(f"{each!r}" for each in map(float, row)) for row in way),
    ]
    (tmp_path / "way.csv").write_text("\n".join(lines) + "\n")
    told = {"file": str(tmp_path / "way.csv"), "frame": "hand", "orientation": True}
    turned = scene.replace(**{"control.trajectory": told})
    course = course_of(turned, Bench.of(turned).problem)
    assert course is not None
    assert_allclose(course.angles, np.tile(there, (len(course.angles), 1)), atol=1e-8)


def test_a_file_that_begins_elsewhere_is_told_of(tmp_path: Path) -> None:
    """By how much, and what to write; an arm that starts there is silent, and so is one a count of its encoder off."""
    text = ELBOW.read_text() + '\n[control.trajectory]\nfile = "way.csv"\n'
    (tmp_path / "way.csv").write_text("time,shoulder,elbow\n0,0.3,0\n0.5,0.4,-0.2\n1,0.5,-0.4\n")
    scene = parse_scene(text, str(tmp_path / "elbow.toml"))

    def told(each: Scene) -> str | None:
        bench = Bench.of(each)
        assert bench.course is not None
        return begins_elsewhere(each, bench.problem, bench.course)

    line = told(scene)
    assert line is not None
    place = f"{tmp_path / 'elbow.toml'}:{text.count(chr(10))}: control.trajectory.file: 'way.csv'"
    assert line.startswith(
        f"{place} begins elsewhere than the arm starts: 'shoulder' at 0.3 rad (0.3 rad away). The"
    )
    assert "`angles = { upper = 0.3, forearm = 0.3 }` under [initial]" in line
    for off, silent in ((0.0, True), (0.003, True), (0.01, False)):  # it moves by 0.004 rad in a sample
        moved = scene.replace(**{"initial.angles": {"upper": 0.3 + off, "forearm": 0.3 + off}})
        assert (told(moved) is None) == silent
    both = told(scene.replace(**{"initial.angles": {"upper": 0.1, "forearm": 0.7}}))
    assert both is not None
    assert "'shoulder' at 0.3 rad (0.2 rad away), 'elbow' at 0 rad (0.6 rad away). The" in both


@pytest.mark.parametrize(
    ("pose", "words"),
    [
        (
            {"frame": "payload", "position": [0.95, 0.0]},
            r"came no nearer than 0\.05.* between 0\.1 and 0\.9 m",
        ),
        ({"frame": "payload", "position": [0.05, 0.0]}, r"came no nearer than 0\.05"),
        ({"frame": "payload", "position": [0.1, 0.1]}, r"beyond control\.bounds\.hub"),
        ({"angles": {"shoulder": 0.0, "elbow": -9.0}}, r"beyond control\.bounds\.hub"),
        ({"angles": 0.0, "frame": "payload"}, r"Write one of them"),
        ({"angles": 0.0, "orientation": 0.5}, r"orientation.* is of a frame, and there is none"),
        ({"frame": "paylod", "position": [0.5, 0.0]}, r"Did you mean 'payload'\?"),
    ],
)
def test_what_cannot_be_reached_is_refused_in_a_line(
    small: Scene, pose: dict[str, object], words: str
) -> None:
    changes = {"control.trajectory": {"pose": [{**pose, "duration": 0.5}]}}
    with pytest.raises(UserError, match=words):
        _ = Bench.of(small.replace(**changes)).course


def test_differences_are_those_of_a_parabola() -> None:
    """At the ends too; behind the last it rests, before the first it goes on evenly accelerated."""
    t = 0.02 * np.arange(1, 9)[:, None]
    window = Window.of(np.hstack([1.0 + 2.0 * t + 3.0 * t**2, -t]), 0.02)
    assert_allclose(window.motion[1], np.hstack([2.0 + 6.0 * t, 0.0 * t - 1.0]), atol=1e-9)
    assert_allclose(window.motion[2], np.broadcast_to([6.0, 0.0], (8, 2)), atol=1e-7)
    assert_allclose(window.before(0.02), [[1.0, 0.0], [2.0, -1.0], [6.0, 0.0]], atol=1e-9)
    assert_allclose(window.at(8)[1:], 0.0)


def test_torques_of_a_motion_are_those_of_lagrange(small: Scene) -> None:
    """With beams a thousand times as stiff; at rest those of the statics, beams as soft as they are."""
    stiff = Bench.of(
        small.replace(**{"beam.upper.bending_stiffness": 11200.0, "beam.forearm.bending_stiffness": 3150.0})
    )
    motion = np.array([[0.3, -0.8], [1.2, -2.0], [3.0, 5.0]])
    model = stiff.step
    found = pose_in(model, motion, Pose(model.initial(), model.start.torque))
    assert found is not None
    # the step ends half a sample's hundredth on: its hubs have turned by then
    time = model.problem.step
    later = np.array([motion[0] + time * motion[1], motion[1] + time * motion[2], motion[2]])
    expected = arm_of(stiff.assumed).rigid_torques(*later[:, None])[0]
    assert_allclose(found.torque, expected, atol=0.02 * np.abs(expected).max())
    soft = Bench.of(small)
    rest = pose_in(
        soft.step, motion * [[1.0], [0.0], [0.0]], Pose(soft.step.initial(), soft.step.start.torque)
    )
    target = rest_with(soft.step.scene, motion[0], "here")
    assert rest is not None
    assert_allclose(rest.torque, target.goal.torque, atol=1e-8)
    assert_allclose(rest.state[: len(target.angles)], target.angles, atol=1e-8)


def test_the_end_of_an_arm_in_motion_is_wanted_where_it_would_be_at_rest(lowered: Bench) -> None:
    """Predicted by links along the kernel as by the linear model: no beam is wanted to swing."""
    motion = np.array([[0.3, -0.8], [1.2, -2.0], [3.0, 5.0]])
    model = lowered.step
    found = pose_in(model, motion, Pose(model.initial(), model.start.torque))
    target = rest_with(model.scene, motion[0], "here")
    assert found is not None
    assert_allclose(found.state[model.places("angle")], target.angles, atol=1e-8)
    assert_allclose(found.state[model.places("rate")], model.motors.turned @ motion[1], rtol=1e-12)

    linear, horizon = lowered.links, 5
    following = Following(linear, lowered.problem.sample_time)

    def wanted(growth: np.ndarray) -> Wanted:
        motions = [np.tile(each, (horizon, 1)) for each in (linear.goal.hub, motion[1], growth)]
        end = np.zeros((1, linear.size + linear.count))
        return following.wanted(Window(np.array(motions)), 0, 0, horizon, end, linear.goal)

    evenly, growing = wanted(np.zeros(2)), wanted(motion[2])
    for name in ("tip", "tip_rate", "hub", "hub_rate"):
        assert_allclose(getattr(growing, name), getattr(evenly, name), rtol=1e-12)
    assert np.all(np.abs(growing.torque - evenly.torque) > 1e-3)


def test_a_linear_model_stays_on_the_motion_it_is_told(lowered: Bench) -> None:
    """Its own torques take it along even acceleration exactly, with nothing fed back."""
    model, time = lowered.links, lowered.problem.sample_time
    following = Following(model, time)

    def at(t: float) -> np.ndarray:
        rate, growth = np.array([0.3, -0.2]), np.array([2.0, 1.0])
        return np.array([model.goal.hub + rate * t + 0.5 * growth * t**2, rate + growth * t, growth])

    state, _ = following.at(at(0.0))
    for k in range(10):
        expected, torque = following.at(at(k * time))
        assert_allclose(state, expected, atol=1e-8 * np.abs(expected).max())
        state = model.transition @ state + model.drive @ (torque - model.goal.torque)
    assert_allclose(model.goal.hub + model.hub @ state, at(10 * time)[0], atol=1e-9)


def trials(bench: Bench, *names: str) -> dict[str, Trial]:
    """Return the trials of controllers, as the scene says."""
    kinds = [BY_NAME[name] for name in names]
    return {trial.kind.name: trial for trial in compare(bench, kinds, CONDITIONS[:1], duration=1.2)}


@pytest.mark.compiler
def test_controllers_follow_and_without_a_wall_the_payload_goes_through_it(lowered: Bench) -> None:
    """All come down to where they are told, below the floor; predicting along the motion is nearest all the way."""
    found = trials(lowered, "pd-zv", "pd-id", "lqr", "mpc-links", "rti-zero", "rti")
    course = lowered.course
    assert course is not None
    rms = {}
    for name, trial in found.items():
        assert trial.tracking is not None
        assert trial.figures.fallbacks == 0
        rms[name] = trial.tracking.rms
        assert_allclose(trial.loop.hub[-1], course.angles[-1], atol=0.25 if name.startswith("pd") else 0.04)
    assert rms["rti"] < 0.02
    assert rms["rti"] < min(rms["pd-zv"], rms["pd-id"])
    assert {"off_rms_mm", "at_stops_mm"} <= found["rti"].row().keys()
    walled = Bench.of(lowered.scene.replace(**{"control.keep": [FLOOR]}))
    nearest = {name: trial.nearest for name, trial in trials(walled, "lqr", "rti-zero", "rti").items()}
    assert all(each is not None for each in nearest.values())
    assert nearest["lqr"] < -0.1
    assert nearest["rti"] > 0.0
    assert nearest["rti-zero"] > 0.0
    with pytest.raises(UserError, match=r":\d+: control\.keep: .* keeps no walls; take rti-zero, rti"):
        BY_NAME["mpc-links"].require_able(walled)
    assert usual_controller(walled) == "rti-zero"  # and not one that would be refused then


@pytest.mark.compiler
def test_real_time_iterations_on_a_way_come_to_the_nonlinear_optimum(lowered: Bench) -> None:
    """Repeated at one state, with a payload that was told; told of another way the optimum is another."""
    rti = RealTimeIteration(lowered.step, lowered.links, lowered.inertia)
    full = FullNmpc(lowered.step, lowered.links, lowered.inertia)
    course, last = lowered.course, lowered.links.start_torque
    assert course is not None
    state, none, found = lowered.step.initial(), np.zeros(2), []
    for sample in (0, 12):
        for each in (rti, full):
            assert each.follow(course.ahead(sample, lowered.problem.horizon)) is Status.OK
            assert each.carry(0.25) is Status.OK
        expected = full.decide(state, none, last)
        for _ in range(12):
            rti._plan = np.hstack([rti._plan[:, :1], rti._plan[:, :-1]])  # decide() moves on by a sample
            torque = rti.decide(state, none, last).torque
        assert expected.status.optimal
        assert_allclose(torque, expected.torque, atol=1e-4 * np.max(lowered.problem.torque))
        found.append(torque)
    assert np.max(np.abs(found[1] - found[0])) > 0.01


def test_what_turns_a_part_into_a_wall_is_how_its_place_changes(lowered: Bench) -> None:
    """Sensitivities of the distances by torques, against rolling out once more."""
    bench = Bench.of(lowered.scene.replace(**{"control.keep": [FLOOR], "control.trajectory": None}))
    rti = BY_NAME["rti"].make(bench)
    state, none = bench.step.initial(), np.zeros(2)
    small, count = 1e-5, bench.problem.horizon
    ends = []
    for sign in (-1.0, 1.0):
        rti._plan = np.repeat(bench.links.start_torque[:, None], count, axis=1)
        rti._plan[1, 3] += sign * small
        ends.append(rti._along(state, none, bench.links.start_torque)[0][-count:])
    rti._plan = np.repeat(bench.links.start_torque[:, None], count, axis=1)
    slopes = rti._along(state, none, bench.links.start_torque)[2].slopes.keep[0, :, count + 3]
    expected = (ends[1] - ends[0]) / (2.0 * small)
    assert_allclose(slopes, expected, atol=1e-5 * np.abs(expected).max())
