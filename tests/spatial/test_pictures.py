"""Pictures of arms in space: points against products of homogeneous matrices, lines, stills and GIFs."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable
from io import BytesIO
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from support.spatial.random_arms import random_arm

from tmm_gen.inputs.signals import Constant
from tmm_gen.report.space_motion import SpaceMotion, space_motion
from tmm_gen.report.space_page import space_page
from tmm_gen.report.space_picture import draw_arm, space_gif
from tmm_gen.scene import load_scene, parse_scene
from tmm_gen.scene.spatial.arm import Frame, Revolute, SpatialArm
from tmm_gen.simulate.run import simulate
from tmm_gen.simulate.skeleton import Skeleton
from tmm_gen.style import figure, picture, style

SCENES = Path(__file__).resolve().parents[2] / "examples" / "space"

DOOR = """
name = "door"
title = "Door with a <knob> & $latch$"
[model]
kind = "spatial"
gravity = [0, 0, -9.81]
[integrator]
name = "newmark"
step = 0.01
[base]
kind = "clamp"
[[motor]]
name = "hinge"
at = [0, 0, 0.4]
axis = "z"
rotor_inertia = 0.01
[[link]]
name = "leaf"
on = "hinge"
end = [0.8, 0, 0]
mass = 3.0
inertia = [0.1, 0.1, 0.1]
[[joint]]
name = "spring"
on = "leaf"
axis = "y"
stiffness = 1.0
damping = 0.1
[[link]]
name = "knob"
on = "spring"
end = [0.1, 0, 0]
mass = 0.2
center = [0.05, 0.01, 0.02]
inertia = [1e-3, 2e-3, 1e-3]
[[input]]
name = "push"
at = "hinge"
acts = "torque"
[[output]]
name = "knob"
at = "knob"
of = "position"
[[output]]
name = "angle"
at = "hinge"
of = "angle"
"""


def homogeneous(joint: Revolute, angle: float) -> np.ndarray:
    """Return a joint's frame in that of its host's body, turned about its axis by Rodrigues' formula."""
    axis = np.eye(3)[joint.axis]
    across = np.cross(axis, np.eye(3)).T
    turned = np.eye(3) + math.sin(angle) * across + (1.0 - math.cos(angle)) * across @ across
    matrix = np.eye(4)
    matrix[:3, :3] = np.array(joint.turn) @ turned
    matrix[:3, 3] = joint.at
    return matrix


def frames_of(arm: SpatialArm, angles: np.ndarray) -> list[np.ndarray]:
    """Return the frames of the base and of all joints in the world, 4 by 4 each."""
    found = [np.eye(4)]
    for joint, angle in zip(arm.joints, angles, strict=True):
        found.append(found[joint.host] @ homogeneous(joint, float(angle)))
    return found


def straight(name: str) -> Skeleton:
    arm = load_scene(SCENES / f"{name}.toml").spatial
    assert arm is not None
    return Skeleton(arm)


@pytest.mark.parametrize("seed", range(8))
def test_points_are_those_of_matrices(seed: int) -> None:
    arm = random_arm(seed)
    angles = np.random.default_rng(seed).uniform(-3.0, 3.0, (4, len(arm.joints)))
    skeleton = Skeleton(arm)
    points, ends = skeleton.places(angles)
    assert points.shape == (4, len(skeleton.spots), 3)
    for at_once, instant in zip(points, angles, strict=True):
        frames = frames_of(arm, instant)
        expected = np.array([frame[:3, 3] for frame in frames])
        assert np.allclose(at_once[list(skeleton.of_joints)], expected, rtol=0.0, atol=1e-12)
        expected = np.array([(frames[each.joint] @ [*each.at, 1.0])[:3] for each in arm.frames])
        assert np.allclose(at_once[list(skeleton.of_frames)], expected, rtol=0.0, atol=1e-12)
    assert ends.shape == (4, len(skeleton.pins), 3)


@pytest.mark.parametrize("name", ["yaw3", "arm6"])
def test_pins_stand_along_the_axes_of_joints(name: str) -> None:
    skeleton = straight(name)
    angles = np.random.default_rng(1).uniform(-2.0, 2.0, (3, len(skeleton.arm.joints)))
    points, ends = skeleton.places(angles)
    for instant, at_once, far in zip(angles, points, ends, strict=True):
        frames = frames_of(skeleton.arm, instant)
        for joint, end in zip(skeleton.pins, far, strict=True):
            along = frames[joint][:3, skeleton.arm.joints[joint - 1].axis]
            middle = at_once[skeleton.of_joints[joint]]
            assert np.allclose(end, middle + skeleton.pin * along, rtol=0.0, atol=1e-12)


def test_pins_are_of_parts_and_of_a_motor_with_its_gear_once() -> None:
    for name, expected in (
        ("yaw3", ["yaw", "shoulder", "elbow"]),
        ("arm6", [f"motor{k}" for k in range(1, 7)]),
        ("helix", []),
    ):
        skeleton = straight(name)
        assert [skeleton.arm.joints[joint - 1].name for joint in skeleton.pins] == expected


@pytest.mark.parametrize("seed", range(8))
def test_lines_join_every_spot_once_and_along_its_body(seed: int) -> None:
    arm = random_arm(seed, tree=True)
    skeleton = Skeleton(arm)
    pieces = Counter(pair for line in skeleton.lines for pair in pairwise(line))
    assert pieces == Counter((parent, spot) for spot, parent in enumerate(skeleton.parents) if spot)
    points = skeleton.points(np.random.default_rng(seed).uniform(-3.0, 3.0, (5, len(arm.joints))))
    for a, b in pieces:
        way = np.linalg.norm(points[:, a] - points[:, b], axis=1)
        assert np.ptp(way) < 1e-12, "both are on one body"


@pytest.mark.parametrize(
    ("name", "spots", "tip"), [("yaw3", 15, "payload"), ("arm6", 8, "load"), ("helix", 10, "rod")]
)
def test_scenes_are_one_line_from_base_to_tip(name: str, spots: int, tip: str) -> None:
    skeleton = straight(name)
    assert skeleton.lines == (tuple(range(spots)),)
    assert [each.name for each in skeleton.tips] == [tip]
    assert skeleton.tips[0].spot == spots - 1


def bracket() -> SpatialArm:
    """Return an angle of two rigid legs, with an arm on its corner and one on its end, frames not in their order."""
    joints = (
        Revolute("turn", 0, at=(0.0, 0.0, 0.2)),
        Revolute("corner", 1, at=(0.3, 0.0, 0.0), axis=0),
        Revolute("end", 1, at=(0.3, 0.0, 0.2), axis=1),
    )
    frames = (
        Frame("leg", 1, (0.3, 0.0, 0.2)),
        Frame("corner", 2),
        Frame("side", 2, (0.0, 0.25, 0.0)),
        Frame("end", 3),
        Frame("out", 3, (0.1 + 0.2, 0.0, 0.0)),
        Frame("load", 3, (0.3, 0.0, 0.0)),
        Frame("turn", 1),
    )
    return SpatialArm(joints, frames)


def test_a_bracket_is_drawn_along_its_legs_and_forks_where_arms_stand() -> None:
    skeleton = Skeleton(bracket())
    turn, corner, end = skeleton.of_joints[1:]
    _, _, side, _, out, load, _ = skeleton.of_frames
    assert out == load, "0.1 + 0.2 is 0.3 but for rounding"
    assert set(skeleton.lines) == {(0, turn, corner), (corner, side), (corner, end, load)}
    assert [(tip.spot, tip.name) for tip in skeleton.tips] == [(side, "side"), (load, "load")]


def test_upward_is_against_gravity() -> None:
    motion = SpaceMotion(bracket(), np.zeros(1), np.zeros((1, 3)))
    assert motion.upward == (2, 1)
    for axis in range(3):
        for sign in (1, -1):
            gravity = [0.3, -0.2, 0.1]
            gravity[axis] = -sign * 9.81
            arm = SpatialArm(motion.arm.joints, motion.arm.frames, (gravity[0], gravity[1], gravity[2]))
            assert SpaceMotion(arm, motion.time, motion.angles).upward == (axis, sign)


def test_thinned_keeps_both_ends() -> None:
    motion = SpaceMotion(bracket(), np.linspace(0.0, 2.0, 1001), np.zeros((1001, 3)))
    thin = motion.thinned(7)
    assert len(thin.time) == len(thin.angles) == 7
    assert (thin.time[0], thin.time[-1]) == (0.0, 2.0)
    assert len(motion.thinned(5000).time) == 1001


@pytest.mark.parametrize(
    "gravity", [(0.0, 0.0, -9.81), (0.0, -9.81, 0.0), (-9.81, 0.0, 0.0), (0.0, 0.0, 9.81)]
)
def test_a_still_shows_all_in_true_proportion(gravity: tuple[float, float, float]) -> None:
    arm = SpatialArm(bracket().joints, bracket().frames, gravity)
    time = np.linspace(0.0, 1.0, 50)
    motion = SpaceMotion(arm, time, time[:, None] * np.array([2.0, -1.0, 3.0]))
    with style():
        made, axes = figure(4.0, 4.0, subplot_kw={"projection": "3d"})
        draw_arm(axes, motion)
        picture(made, "png")
    axes.set_proj_type("ortho")
    across, upward = axes.get_proj()[:2, :3]
    # what goes across the paper and up it is as long as in space
    assert np.linalg.norm(across) == pytest.approx(np.linalg.norm(upward), rel=1e-9)
    assert across @ upward == pytest.approx(0.0, abs=1e-9 * (across @ across))
    assert upward[motion.upward[0]] * motion.upward[1] > 0.5 * np.linalg.norm(upward)
    limits = np.array([axes.get_xlim3d(), axes.get_ylim3d(), axes.get_zlim3d()])
    points = motion.skeleton.points(motion.angles).reshape(-1, 3)
    for axis in range(3):
        assert limits[axis].min() <= points[:, axis].min()
        assert points[:, axis].max() <= limits[axis].max()


def test_the_command_draws_and_animates(tmm_gen: Callable[..., Any], tmp_path: Path) -> None:
    (tmp_path / "door.toml").write_text(DOOR)
    words = ("run", "door.toml", "--until", "0.3", "--input", "push=1", "--plot", "a.png")
    done = tmm_gen(*words, "--animate", "a.html")
    assert done.returncode == 0, done.stderr
    with Image.open(tmp_path / "a.png") as still:
        assert still.size[0] > 1500, "the arm is beside its outputs"
    page = (tmp_path / "a.html").read_text()
    assert "<h1>Door with a &lt;knob&gt; &amp; $latch$</h1>" in page
    assert '"name":"knob"' in page


def test_a_traced_run_is_where_its_outputs_say() -> None:
    scene = parse_scene(DOOR)
    run = simulate(scene, {"push": Constant(2.0)}, 0.4, trace=True, judge=False)
    motion = space_motion(run)
    points = motion.skeleton.points(motion.angles)
    tip = points[:, motion.skeleton.tips[0].spot]
    for axis, name in enumerate("xyz"):
        assert tip[:, axis] == pytest.approx(run.outputs[f"knob_{name}"], abs=1e-12)
    assert np.ptp(tip[:, 1]) > 0.01
    page = space_page(run).decode()
    assert f'"time":[0.0,{run.time[1]:g},' in page, "so few instants are all shown"
    with Image.open(BytesIO(space_gif(run))) as moving:
        assert moving.n_frames == 10
        frames = []
        for k in (0, 9):
            moving.seek(k)
            frames.append(np.array(moving.convert("RGB")))
        assert np.any(frames[0] != frames[1])
    bare = simulate(scene, {}, 0.02, judge=False)
    with pytest.raises(ValueError, match="not traced"):
        space_motion(bare)
