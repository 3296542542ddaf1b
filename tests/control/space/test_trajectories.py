"""Trajectories in space: poses by joint angles and by places, files of places, and how controllers follow them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tmm_gen.closed_loop.compare import compare
from tmm_gen.control.arm.part_frame import end_of
from tmm_gen.control.bench import Bench
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.controllers import BY_NAME
from tmm_gen.control.goals.course import begins_elsewhere, course_of
from tmm_gen.control.goals.target import rest_with
from tmm_gen.errors import UserError
from tmm_gen.native import compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene, parse_scene

THERE = {"yaw": 0.5, "lift": -0.2}


def with_poses(scene: Scene, *poses: dict[str, object]) -> Scene:
    return scene.replace(**{"control.trajectory": {"pose": list(poses)}})


def resting_place(scene: Scene, angles: np.ndarray) -> np.ndarray:
    """Return where the payload rests, as the generated kernel shows it."""
    kernel = compile_kernel(build_program(scene), scene, flags=("-O1",))
    kernel.prepare()
    kernel.initialise(initial_angle=rest_with(scene, angles, "here").angles)
    shown = kernel.output()
    return np.array([shown[f"payload_{axis}"] for axis in "xyz"])


@pytest.fixture(scope="module")
def place(reach: Scene) -> list[float]:
    """Where the payload rests with the motors there."""
    return resting_place(reach, np.array([*THERE.values()])).tolist()


def test_a_place_is_reached_by_the_joints_that_rest_there(reach: Scene, place: list[float]) -> None:
    """The arm sags, so that straight links would put the payload elsewhere."""
    pose = {"frame": "payload", "position": place, "duration": 0.4, "dwell": 0.2}
    scene = with_poses(reach, pose)
    course = course_of(scene, Bench.of(scene).problem)
    assert course is not None
    assert_allclose(course.angles[0], [0.0, -0.5], atol=1e-12)
    assert_allclose(course.angles[-1], [*THERE.values()], atol=1e-8)
    assert course.stops(40) == [(20, 39)]
    assert end_of(scene) == "payload"


def test_a_file_of_places_has_three_columns(
    tmp_path: Path, words: str, reach: Scene, place: list[float]
) -> None:
    start = resting_place(reach, np.array([0.0, -0.5]))
    told_at = [(0.0, start.tolist()), (0.4, place)]
    rows = [",".join(f"{number!r}" for number in [time, *where]) for time, where in told_at]
    (tmp_path / "way.csv").write_text("\n".join(["time,payload_x,payload_y,payload_z", *rows]) + "\n")
    told = '\n[control.trajectory]\nfile = "way.csv"\nframe = "payload"\n'
    scene = parse_scene(words + told, str(tmp_path / "reach.toml"))
    with pytest.raises(UserError, match=r"way\.csv, t = 0\.02 s: 'payload' cannot rest at"):
        _ = Bench.of(scene).course  # two motors keep the payload on a sphere, and the way is straight


def test_a_file_that_begins_elsewhere_is_told_of(tmp_path: Path, words: str) -> None:
    """And not where the arm starts there, as it says."""
    (tmp_path / "way.csv").write_text("time,yaw,lift\n0,0,-0.2\n0.4,0.1,-0.1\n")
    text, file = words + '\n[control.trajectory]\nfile = "way.csv"\n', str(tmp_path / "reach.toml")
    told = []
    for each in (text, text.replace("angles = { lift = -0.5 }", "angles = { yaw = 0, lift = -0.2 }")):
        bench = Bench.of(parse_scene(each, file))
        assert bench.course is not None
        told.append(begins_elsewhere(bench.scene, bench.problem, bench.course))
    line, silent = told
    assert silent is None
    assert line is not None
    assert "'lift' at -0.2 rad (0.3 rad away). The" in line
    assert "`angles = { yaw = 0, lift = -0.2 }` under [initial]" in line


@pytest.mark.parametrize(
    ("pose", "said"),
    [
        ({"frame": "payload", "position": [0.5, 0.1]}, r"three numbers: x, y, z .* Write for example"),
        ({"frame": "payload", "position": [0.9, 0.0, 0.0]}, r"The way along the arm to it is 0\.6 m"),
        ({"frame": "paylod", "position": [0.5, 0.0, 0.0]}, r"Did you mean 'payload'\?"),
        ({"angles": {"yaw": 0.0}}, r"lift"),
        ({"angles": {"yaw": 2.0, "lift": 0.0}}, r"'yaw' would be at 2 rad, beyond its limits or .*\[-1, 1\]"),
    ],
)
def test_what_cannot_be_reached_is_refused_in_a_line(
    reach: Scene, pose: dict[str, object], said: str
) -> None:
    limited = reach.replace(**{"motor.yaw.limits": [-1.0, 1.0]})
    with pytest.raises(UserError, match=said):
        _ = Bench.of(with_poses(limited, {**pose, "duration": 0.5})).course


def test_controllers_follow_and_stop_at_the_place(reach: Scene, place: list[float]) -> None:
    """Of an arm with more cells; the end is where it is to be when it stops."""
    scene = with_poses(reach, {"frame": "payload", "position": place, "duration": 0.6, "dwell": 0.6})
    kinds = [BY_NAME[name] for name in ("pd-id", "mpc-links", "rti-zero")]
    for trial in compare(Bench.of(scene), kinds, [CONDITIONS[0]], 1.2):
        assert trial.tracking is not None
        assert trial.tracking.largest < 0.05, trial.kind.name
        assert trial.figures.fallbacks == 0
        assert trial.tracking.vibration is not None
        assert trial.tracking.vibration < 0.01, trial.kind.name


WRIST = """
name = "six"
[model]
kind = "spatial"
gravity = [0, 0, -9.81]
[integrator]
name = "newmark"
step = 2e-3
[base]
kind = "clamp"
{motors}
[[output]]
name = "tool"
at = "tool"
of = "position"
[[output]]
name = "facing"
at = "tool"
of = "orientation"
[initial]
angles = {{ shoulder = -0.6, elbow = 1.0, pitch = 0.4 }}
[control]
reference = {{ yaw = 0.3, shoulder = -0.6, elbow = 1.0, roll = 0.2, pitch = 0.4, spin = 0.1 }}
[control.bounds]
torque = 60.0
"""
JOINTS = {"yaw": "z", "shoulder": "y", "elbow": "y", "roll": "x", "pitch": "y", "spin": "x"}


def six_motors(more: str = "", file: str = "six.toml") -> Scene:
    """Return an arm with six motors and one beam that bends, whose end can stand in any way."""
    lines, on = [], "base"
    for name, axis in JOINTS.items():
        lines += ["[[motor]]", f'name = "{name}"', f'axis = "{axis}"', f'on = "{on}"', "rotor_inertia = 0.05"]
        lines += ["[[input]]", f'name = "{name}_torque"', f'at = "{name}"', 'acts = "torque"']
        on = name
        if name in ("shoulder", "elbow", "spin"):
            on = {"shoulder": "upper", "elbow": "fore", "spin": "tool"}[name]
            if name == "shoulder":
                lines += ["[[beam]]", "length = 0.4", "bending_stiffness = [60.0, 50.0]", "links = 1"]
                lines += ["mass_per_length = 0.8"]
            else:
                lines += ["[[link]]", "length = 0.3", "mass = 0.3", "inertia = [1e-3, 1e-3, 1e-3]"]
            lines += [f'name = "{on}"', f'on = "{name}"']
    return parse_scene(WRIST.format(motors="\n".join(lines)) + more, file)


def test_a_part_is_brought_to_a_place_and_stands_there_as_told() -> None:
    """Sagging as it does; the quaternion is the one that the generated kernel shows, of any length and sign."""
    scene = six_motors()
    there = np.array([0.5, -0.3, 0.8, -0.4, 0.7, 0.3])
    kernel = compile_kernel(build_program(scene), scene, flags=("-O1",))
    kernel.prepare()
    kernel.initialise(initial_angle=rest_with(scene, there, "here").angles)
    shown = kernel.output()
    position = [shown[f"tool_{axis}"] for axis in "xyz"]
    quaternion = [-2.0 * shown[f"facing_{axis}"] for axis in "wxyz"]
    pose = {"frame": "tool", "position": position, "orientation": quaternion, "duration": 0.4}
    course = course_of(with_poses(scene, pose), Bench.of(scene).problem)
    assert course is not None
    assert_allclose(course.angles[-1], there, atol=1e-8)


def standing(tmp_path: Path, rows: list[list[float]]) -> Scene:
    """Return the arm with six motors and a file that says where its tool is to be and how it is to stand."""
    heading = ["time", *(f"tool_{each}" for each in ("x", "y", "z", "qw", "qx", "qy", "qz"))]
    lines = [",".join(heading), *(",".join(f"{number!r}" for number in row) for row in rows)]
    (tmp_path / "way.csv").write_text("\n".join(lines) + "\n")
    told = '[control.trajectory]\nfile = "way.csv"\nframe = "tool"\norientation = true\n'
    return six_motors(told, str(tmp_path / "six.toml"))


def test_a_file_says_how_a_part_stands(tmp_path: Path) -> None:
    """At each row where the arm rests by these joints; the signs of quaternions mean nothing, nor their lengths."""
    scene, rows = six_motors(), []
    begin, end = np.array([0.0, -0.6, 1.0, 0.0, 0.4, 0.0]), np.array([0.3, -0.4, 0.8, -0.3, 0.6, 0.3])
    kernel = compile_kernel(build_program(scene), scene, flags=("-O1",))
    kernel.prepare()
    for number, share in enumerate(np.linspace(0.0, 1.0, 6)):
        kernel.initialise(initial_angle=rest_with(scene, begin + share * (end - begin), "here").angles)
        shown, sign = kernel.output(), (1.0, -3.0)[number % 2]
        quaternion = [sign * shown[f"facing_{axis}"] for axis in "wxyz"]
        rows.append([0.1 * number, *(shown[f"tool_{axis}"] for axis in "xyz"), *quaternion])
    scene = standing(tmp_path, rows)
    problem = Bench.of(scene).problem
    course = course_of(scene, problem)
    assert course is not None
    each = round(0.1 / problem.sample_time)
    for number, share in enumerate(np.linspace(0.0, 1.0, 6)):
        assert_allclose(course.angles[each * number], begin + share * (end - begin), atol=1e-8)
    # in between it is cubic, and nearly the same way
    straight = begin + np.linspace(0.0, 1.0, len(course.angles))[:, None] * (end - begin)
    assert_allclose(course.angles, straight, atol=3e-3)


def test_a_quaternion_of_zeros_is_told_with_its_line(tmp_path: Path) -> None:
    rows = [[0.0, 0.5, 0.0, 0.5, 1.0, 0.0, 0.0, 0.0], [0.1, 0.5, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0]]
    with pytest.raises(UserError, match=r"way\.csv:3: the quaternion of zeros is no orientation\. Write"):
        _ = Bench.of(standing(tmp_path, rows)).course


@pytest.mark.parametrize(
    ("told", "said"),
    [
        ('file = "way.csv"\norientation = true', r"orientation: is of a frame.*write `frame`"),
        ("orientation = true\n[[control.trajectory.pose]]\nangles = 0.1\nduration = 1.0", r"is of a file"),
    ],
)
def test_orientations_of_no_part_are_refused(words: str, told: str, said: str) -> None:
    with pytest.raises(UserError, match=said):
        parse_scene(f"{words}\n[control.trajectory]\n{told}\n", "reach.toml")


@pytest.mark.parametrize(
    ("facing", "said"),
    [
        (0.5, r"orientation.*must be a quaternion: w, x, y, z.*Write for example"),
        ([0.0, 0.0, 0.0, 0.0], r"is no quaternion"),
        ([1.0, 0.0], r"must be an angle in rad, or in space a quaternion"),
        ([1.0, 0.0, 0.5, 0.0], r"are 6 numbers, for 2 motors: leave out `orientation`"),
    ],
)
def test_orientations_that_cannot_be_are_refused(
    reach: Scene, place: list[float], facing: object, said: str
) -> None:
    pose = {"frame": "payload", "position": place, "orientation": facing, "duration": 0.5}
    with pytest.raises(UserError, match=said):
        _ = Bench.of(with_poses(reach, pose)).course
