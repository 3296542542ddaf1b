"""Robots drawn at random, imported: the scene's arm has the places, the mass matrix and the weights of the URDF."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.random_urdf import random_urdf
from support.urdf_truth import UrdfTruth

from tmm_gen.scene import load_scene
from tmm_gen.scene.spatial.arm import SpatialArm
from tmm_gen.urdf.scene_text import imported_scene

SEEDS = range(20)


def imported(text: str, folder: Path) -> tuple[SpatialArm, dict[str, str]]:
    (folder / "robot.urdf").write_text(text, encoding="utf-8")
    scene = imported_scene(folder / "robot.urdf")
    (folder / "robot.toml").write_text(scene.text, encoding="utf-8")
    arm = load_scene(folder / "robot.toml").spatial
    assert arm is not None
    return arm, scene.motors


def frames(arm: SpatialArm, angles: np.ndarray) -> list[tuple[np.ndarray, np.ndarray]]:
    """Place and turn of the base and of every joint's body in world axes."""
    found = [(np.zeros(3), np.eye(3))]
    for joint, angle in zip(arm.joints, angles, strict=True):
        at, turn = found[joint.host]
        turned = Rotation.from_rotvec(np.eye(3)[joint.axis] * angle).as_matrix()
        found.append((at + turn @ joint.at, turn @ np.array(joint.turn) @ turned))
    return found


def mass_and_weight(
    arm: SpatialArm, angles: np.ndarray, gravity: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    count, placed = len(arm.joints), frames(arm, angles)
    mass, weight = np.zeros((count, count)), np.zeros(count)
    for number, joint in enumerate(arm.joints, start=1):
        at, turn = placed[number]
        center = at + turn @ joint.body.center
        xx, yy, zz, xy, xz, yz = joint.body.inertia
        inertia = turn @ np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) @ turn.T
        moves, spins = np.zeros((3, count)), np.zeros((3, count))
        inner = number
        while inner:
            point, axes = placed[inner]
            spins[:, inner - 1] = axes[:, arm.joints[inner - 1].axis]
            moves[:, inner - 1] = np.cross(spins[:, inner - 1], center - point)
            inner = arm.joints[inner - 1].host
        mass += joint.body.mass * moves.T @ moves + spins.T @ inertia @ spins
        weight += joint.body.mass * moves.T @ gravity
    return mass, weight


@pytest.mark.parametrize("seed", SEEDS)
def test_the_scene_is_the_robot(seed: int, tmp_path: Path) -> None:
    text = random_urdf(seed)
    truth, (arm, motors) = UrdfTruth(text), imported(text, tmp_path)
    assert 3 <= len(truth.turning) == len(arm.joints) <= 20
    order = in_arm(truth, arm, motors)
    rng = np.random.default_rng(seed)
    for _ in range(3):
        angles = rng.uniform(-3, 3, len(arm.joints))
        by_name = {truth.turning[k]: angles[number] for k, number in enumerate(order)}
        gravity = rng.normal(size=3)
        mass, weight = mass_and_weight(arm, angles, gravity)
        wanted = truth.mass_matrix(by_name)
        np.testing.assert_allclose(
            mass[np.ix_(order, order)], wanted, rtol=0, atol=1e-13 * np.abs(wanted).max()
        )
        wanted = truth.weight(by_name, gravity)
        np.testing.assert_allclose(weight[order], wanted, rtol=0, atol=1e-13 * np.abs(wanted).max())
        assert_ends(truth, arm, angles, by_name)


def in_arm(truth: UrdfTruth, arm: SpatialArm, motors: dict[str, str]) -> list[int]:
    """Return where each turning joint of the URDF is in the arm."""
    numbers = {joint.name: k for k, joint in enumerate(arm.joints)}
    found = [numbers[motors[name]] for name in truth.turning]
    assert sorted(found) == list(range(len(arm.joints)))
    for number, name in zip(found, truth.turning, strict=True):
        dynamics = truth.joints[name].find("dynamics")
        assert arm.joints[number].damping == (0.0 if dynamics is None else float(dynamics.get("damping")))
    return found


def assert_ends(truth: UrdfTruth, arm: SpatialArm, angles: np.ndarray, by_name: dict[str, float]) -> None:
    """Every leaf link's frame is an output, and is where the URDF has it."""
    parents = {joint.find("parent").get("link") for joint in truth.joints.values()}
    leaves = {link: at for link, (at, _) in truth.places(by_name).items() if link not in parents}
    placed, outputs = frames(arm, angles), {o.name: o for o in arm.outputs if o.of == "position"}
    moving = {link: at for link, at in leaves.items() if truth.behind(link) & set(truth.turning)}
    assert len(outputs) == len(moving)
    for link, at in moving.items():
        output = outputs[link.replace(" ", "_")]
        assert output.frame is not None
        point, turn = placed[output.frame.joint]
        np.testing.assert_allclose(point + turn @ output.frame.at, at, rtol=0, atol=1e-13)


@pytest.mark.parametrize("seed", range(100, 105))
def test_the_truth_is_what_mujoco_reads(seed: int) -> None:
    text = random_urdf(seed, massless=False)
    truth = UrdfTruth(text)
    options = (
        '<mujoco><compiler fusestatic="true" discardvisual="true" balanceinertia="false"/></mujoco></robot>'
    )
    model = mujoco.MjModel.from_xml_string(text.replace("</robot>", options))
    data = mujoco.MjData(model)
    data.qpos = np.random.default_rng(seed).uniform(-3, 3, model.nq)
    mujoco.mj_forward(model, data)
    full = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, full)
    names = [model.joint(k).name for k in range(model.njnt)]
    order = [truth.turning.index(name) for name in names]
    wanted = truth.mass_matrix(dict(zip(names, data.qpos, strict=True)))[np.ix_(order, order)]
    np.testing.assert_allclose(full, wanted, rtol=0, atol=1e-12 * np.abs(wanted).max())
