"""Arms in space exported: MuJoCo accelerates as the reference does, and URDF brings back the same rigid bodies."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest
from support.random_urdf import random_urdf
from support.spatial.random_arms import random_arm

from tmm_gen.cli import main
from tmm_gen.errors import UserError
from tmm_gen.export.mjcf import KEYFRAME, mujoco_model
from tmm_gen.export.urdf import urdf_model
from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.scene import Scene, load_scene, parse_scene
from tmm_gen.scene.spatial.arm import ArmOutput, Frame, SpatialArm
from tmm_gen.urdf.scene_text import imported_scene

ROOT = Path(__file__).resolve().parents[2]

EVERYTHING = """
name = "everything"
title = "What an arm in space may have -- all of it"
[model]
kind = "spatial"
gravity = [1.0, -2.0, -9.81]
[integrator]
name = "newmark"
step = 1e-3
[base]
kind = "clamp"
[[motor]]
name = "world"
axis = "z"
at = [0.1, 0, 0.2]
turn = [0.3, -0.2, 1.1]
rotor_inertia = 2e-5
gear = 100
damping = 0.3
stiffness = 800.0
damping_time = 1e-3
limits = [-2.0, 2.0]
[[beam]]
name = "upper"
on = "world"
length = 0.5
bending_stiffness = [15.0, 9.0]
torsional_stiffness = 10.0
mass_per_length = 0.6
polar_inertia_per_length = 1e-4
links = 3
damping_time = 2e-3
[[joint]]
name = "elbow"
on = "upper"
axis = [1, 2, 0.5]
turn = [0, 1.2, 0]
stiffness = 4.0
rest = 0.3
damping = 0.01
[[body]]
name = "tool"
on = "elbow"
at = [0.1, 0.02, 0]
turn = [0.5, 0, 0.2]
mass = 0.3
center = [0.05, 0, 0]
inertia = [1e-3, 1.2e-3, 5e-4, 1e-4, -5e-5, 2e-5]
[[beam]]
name = "antenna"
on = "world"
turn = [0, -1.5, 0]
length = 0.3
bending_stiffness = 2.0
mass_per_length = 0.2
links = 2
[initial]
angles = { world = 0.2, elbow = 0.4 }
rates = { elbow = -1.0 }
[[input]]
name = "drive"
at = "world"
acts = "torque"
[[input]]
name = "push"
at = "tool"
acts = "force"
[[input]]
name = "blow"
at = "tool"
acts = "force"
in = "body"
[[input]]
name = "twist"
at = "upper"
acts = "moment"
[[input]]
name = "bend"
at = "antenna"
acts = "moment"
in = "body"
""" + "".join(
    f'[[output]]\nname = "{at}_{of}"\nat = "{at}"\nof = "{of}"\n'
    for at, of in (
        ("elbow", "angle"),
        ("elbow", "rate"),
        ("elbow", "acceleration"),
        ("elbow", "torque"),
        ("world", "torque"),
        ("world", "angle"),
        ("world", "rate"),
        ("tool", "position"),
        ("antenna", "position"),
        ("tool", "velocity"),
        ("tool", "orientation"),
        ("arm", "kinetic_energy"),
        ("arm", "elastic_energy"),
    )
)


@pytest.fixture(scope="module")
def everything() -> Scene:
    return parse_scene(EVERYTHING)


def loaded(scene: Scene) -> tuple[Any, Any]:
    model = mujoco.MjModel.from_xml_string(mujoco_model(scene).text)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.keyframe(KEYFRAME).id)
    return model, data


def arm_of(scene: Scene) -> SpatialArm:
    assert scene.spatial is not None
    return scene.spatial


def assert_accelerates(scene: Scene, seed: int, turned: float, tolerance: float) -> None:
    """At random states up to some angle, rad, under random inputs; relative to the largest acceleration."""
    model, data = loaded(scene)
    arm, rng = arm_of(scene), np.random.default_rng(seed)
    columns = [column for item in arm.inputs for column in item.columns]
    assert [model.joint(k).name for k in range(model.njnt)] == [joint.name for joint in arm.joints]
    for _ in range(5):
        data.qpos, data.qvel = rng.uniform(-turned, turned, model.nq), rng.uniform(-3, 3, model.nv)
        inputs = dict(zip(columns, rng.normal(size=len(columns)), strict=True))
        for name, value in inputs.items():
            data.actuator(name).ctrl = value
        mujoco.mj_forward(model, data)
        wanted = WorldArm(arm).forward_dynamics(data.qpos.copy(), data.qvel.copy(), inputs)
        np.testing.assert_allclose(data.qacc, wanted, rtol=0, atol=tolerance * np.abs(wanted).max())


def test_mujoco_accelerates_as_the_reference(everything: Scene) -> None:
    # MuJoCo is given a little of the inertia that rods have not about their axes: the tolerance is for that; cells that
    # bend by a right angle would turn about it
    assert_accelerates(everything, 1, 0.8, 1e-10)


@pytest.mark.parametrize("seed", range(8))
def test_random_arms_accelerate_as_the_reference(seed: int, everything: Scene) -> None:
    assert_accelerates(replace(everything, spatial=random_arm(seed)), seed, 2.0, 1e-12)


def test_no_mass_is_made_up_between_joints(everything: Scene) -> None:
    model, _ = loaded(everything)
    assert model.nv == len(arm_of(everything).joints) == 2 + 3 * 3 + 1 + 2 * 2
    # one body each: the first motor's beyond its gear, three and two cells', the elbow's; and the world and the ground
    # without any
    assert model.nbody == 2 + 1 + 3 + 2 + 1
    assert min(model.body_mass[2:]) > 1e-3


def test_a_frame_without_mass_that_is_asked_for_keeps_its_body(everything: Scene) -> None:
    arm = random_arm(3)
    bare = [k for k, joint in enumerate(arm.joints, start=1) if not joint.body.mass]
    assert bare
    asked = ArmOutput("seen", "position", frame=Frame("seen", bare[0], (0.1, 0.2, 0.3)))
    scene = replace(everything, spatial=replace(arm, outputs=(asked,)))
    model, data = loaded(scene)
    data.qpos = np.linspace(-1, 1, model.nq)
    mujoco.mj_forward(model, data)
    _, point = WorldArm(arm).tree.places(data.qpos.copy()).frame(asked.frame)
    np.testing.assert_allclose(data.sensor("seen").data, point, atol=1e-13)


def test_every_output_is_read_as_told(everything: Scene) -> None:
    model, data = loaded(everything)
    arm, exported = arm_of(everything), mujoco_model(everything)
    q, v = data.qpos.copy(), data.qvel.copy()
    assert q.tolist() == [joint.angle for joint in arm.joints]
    assert v.tolist() == [joint.rate for joint in arm.joints]
    assert {0.2, 0.4} <= set(q)
    assert -1.0 in v
    data.qpos[1], data.qvel[1] = q[1], v[1] = 0.01, 0.5  # the twist of the first motor's gear
    data.actuator("drive").ctrl = 0.7
    mujoco.mj_forward(model, data)
    found = {r.name: r.value(lambda sensor: list(data.sensor(sensor).data)) for r in exported.readings}
    world, names = WorldArm(arm), [joint.name for joint in arm.joints]
    elbow = names.index("elbow")
    torque = world.torque(q, v, {"drive": 0.7})
    assert found["elbow_angle"] == pytest.approx(q[elbow])
    assert found["elbow_rate"] == pytest.approx(v[elbow])
    assert found["elbow_torque"] == pytest.approx(torque[elbow])
    assert found["world_torque"] == pytest.approx(torque[1])
    assert torque[1] != 0.0
    assert found["world_angle"] == pytest.approx(q[0] + q[1])
    assert found["world_rate"] == pytest.approx(v[0] + v[1])
    assert found["arm_kinetic_energy"] == pytest.approx(v @ world.mass_matrix(q) @ v / 2)
    places = world.tree.places(q)
    for output in arm.outputs:
        if output.of == "position":
            assert output.frame is not None
            _, point = places.frame(output.frame)
            np.testing.assert_allclose([found[column] for column in output.columns], point, atol=1e-12)
        elif output.of == "orientation":
            assert output.frame is not None
            axes, _ = places.frame(output.frame)
            turned = np.zeros(9)
            mujoco.mju_quat2Mat(turned, np.array([found[column] for column in output.columns]))
            np.testing.assert_allclose(turned.reshape(3, 3), axes, atol=1e-12)
    # a velocity by a small step of the position
    tool = next(o.frame for o in arm.outputs if o.of == "position" and o.frame and o.frame.name == "tool")
    ahead, behind = (world.tree.places(q + s * 1e-6 * v).frame(tool)[1] for s in (1, -1))
    wanted = (ahead - behind) / 2e-6
    np.testing.assert_allclose([found[f"tool_velocity_{k}"] for k in "xyz"], wanted, atol=1e-8)
    said = " ".join(exported.left_out)
    assert "elbow_acceleration: no sensor measures it" in said
    assert "arm_elastic_energy: MuJoCo knows the sum" in said


def test_rk4_is_stable_at_the_step_given(everything: Scene) -> None:
    model, data = loaded(everything)
    for _ in range(2000):
        mujoco.mj_step(model, data)
    assert np.all(np.isfinite(data.qpos))
    assert np.max(np.abs(data.qpos)) < 50.0


def test_an_inertia_that_mujoco_refuses_is_told(everything: Scene) -> None:
    wrong = everything.source.data["body"][0] | {"inertia": [1e-3, 1e-3, 5e-3]}  # type: ignore[index]
    scene = everything.replace(body=[wrong])
    with pytest.raises(UserError, match=r"what 'elbow' carries .* which MuJoCo refuses"):
        mujoco_model(scene)


def back(scene: Scene, folder: Path) -> tuple[SpatialArm, dict[str, str]]:
    """Export to URDF, import that, and return the arm, with the joints' names in it."""
    (folder / "robot.urdf").write_text(urdf_model(scene).text)
    # what URDF cannot hold comes back by the file that its comments have ready
    flex = "".join(
        f"[joint.{joint.name}]\nrotor_inertia = {joint.armature / joint.gear**2!r}\ngear = {joint.gear!r}\n"
        for joint in arm_of(scene).joints
        if joint.armature
    )
    (folder / "flex.toml").write_text(flex)
    made = imported_scene(folder / "robot.urdf", folder / "flex.toml")
    (folder / "robot.toml").write_text(made.text)
    return arm_of(load_scene(folder / "robot.toml")), made.motors


def assert_same_bodies(scene: Scene, folder: Path, seed: int) -> None:
    first = arm_of(scene)
    second, motors = back(scene, folder)
    assert len(first.joints) == len(second.joints)
    numbers = {joint.name: k for k, joint in enumerate(second.joints)}
    order = [numbers[motors[joint.name]] for joint in first.joints]
    second = replace(second, gravity=first.gravity)
    assert [second.joints[k].limits for k in order] == [joint.limits for joint in first.joints]
    slack = replace(first, joints=tuple(replace(joint, stiffness=0.0) for joint in first.joints))
    rng = np.random.default_rng(seed)
    for _ in range(3):
        q, v, a = rng.uniform(-2, 2, (3, len(order)))
        q2, v2, a2 = (np.empty(len(order)) for _ in range(3))
        q2[order], v2[order], a2[order] = q, v, a
        wanted = WorldArm(slack).inverse_dynamics(q, v, a, {})
        found = WorldArm(second).inverse_dynamics(q2, v2, a2, {})[order]
        np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-12 * np.abs(wanted).max())


def test_urdf_brings_back_the_same_rigid_bodies(everything: Scene, tmp_path: Path) -> None:
    assert_same_bodies(everything, tmp_path, 1)
    second, _ = back(everything, tmp_path)
    ends = [output.name for output in second.outputs if output.of == "position"]
    assert {"tool", "antenna"} <= set(ends)


@pytest.mark.parametrize("seed", range(6))
def test_urdf_of_urdf_is_the_same_robot(seed: int, tmp_path: Path) -> None:
    (tmp_path / "robot.urdf").write_text(random_urdf(seed), encoding="utf-8")
    (tmp_path / "robot.toml").write_text(imported_scene(tmp_path / "robot.urdf").text)
    assert_same_bodies(load_scene(tmp_path / "robot.toml"), tmp_path, seed)


def test_what_urdf_cannot_hold_is_told(everything: Scene) -> None:
    model = urdf_model(everything)
    for reason in (
        "gravity: 1.0 -2.0 -9.81 m/s^2 in the axes of base_link",
        "spring of joint 'elbow': 4.0 N m/rad, slack at 0.3 rad",
        "rotor of joint 'world', for --flex: [joint.world] rotor_inertia = 2e-05, gear = 100.0",
        "start of joint 'elbow': 0.4 rad, -1.0 rad/s",
        "inputs: drive, push, blow, twist, bend",
    ):
        assert reason in model.left_out
        assert reason.replace("--", "- -") in model.text


def test_only_arms_in_space_are_urdf(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = ["--out", str(tmp_path / "a.urdf")]
    assert main(["export", str(ROOT / "scenes" / "arm10.toml"), "--to", "urdf", *out]) == 2
    assert (
        "only arms in space can be URDF, and this is a planar scene. Use --to mjcf" in capsys.readouterr().err
    )


def test_the_command_writes_both_and_spares_what_is_no_export(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("everything.toml").write_text(EVERYTHING)
    for kind, name in (("urdf", "everything.urdf"), ("mjcf", "everything.xml")):
        assert main(["export", "everything.toml", "--to", kind]) == 0
        assert f"wrote {name}: a " in capsys.readouterr().out
        assert main(["export", "everything.toml", "--to", kind]) == 0  # a former result is replaced
        Path(name).write_text('<?xml version="1.0"?>\n<robot name="of somebody"/>\n')
        capsys.readouterr()
        assert main(["export", "everything.toml", "--to", kind]) == 2
        assert "is there and no" in capsys.readouterr().err
