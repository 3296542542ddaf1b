"""Imported URDF against Pinocchio's own reader: torques at random states, of robots drawn at random and of files.

``python benchmarks/import_urdf.py [--arms 200] [--states 20] [ROBOT.urdf ...]``. A file that is refused for joints that
slide or follow others is tried again with these locked, in both. Pinocchio is no dependency: where it cannot be
imported, this says how to get it.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from dataclasses import replace
from pathlib import Path
from types import ModuleType

import numpy as np
from support.random_urdf import random_urdf

from tmm_gen.errors import UserError
from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.scene import load_scene
from tmm_gen.urdf.read import read_robot
from tmm_gen.urdf.scene_text import imported_scene

HOW_TO_GET = (
    "pip install --target out/pin pin, then PYTHONPATH=out/pin/cmeel.prefix/lib/python3.11/site-packages"
)


def difference(
    pin: ModuleType, urdf: Path, locked: list[str], states: int, folder: Path
) -> tuple[int, float]:
    """Return the number of joints, and the largest difference of torques over the largest torque."""
    (folder / "lock.toml").write_text("".join(f'[joint."{name}"]\nlock = 0.0\n' for name in locked))
    made = imported_scene(urdf, folder / "lock.toml")
    (folder / "scene.toml").write_text(made.text, encoding="utf-8")
    arm = load_scene(folder / "scene.toml").spatial
    assert arm is not None
    model = pin.buildModelFromUrdf(str(urdf))
    if locked:
        model = pin.buildReducedModel(model, [model.getJointId(n) for n in locked], pin.neutral(model))
    model.gravity.linear = np.array(arm.gravity)
    # what acts besides bodies is not in Pinocchio's torques
    world = WorldArm(replace(arm, joints=tuple(replace(joint, damping=0.0) for joint in arm.joints)))
    data, rng = model.createData(), np.random.default_rng(1)
    numbers = {joint.name: k for k, joint in enumerate(arm.joints)}
    order = [numbers[made.motors[name]] for name in list(model.names)[1:]]
    assert sorted(order) == list(range(len(arm.joints)))
    worst = 0.0
    for _ in range(states):
        q, v, a = rng.uniform(-3.0, 3.0, (3, len(order)))
        theirs = pin.neutral(model)
        for joint, number in zip(model.joints[1:], order, strict=True):
            turned = [q[number]] if joint.nq == 1 else [np.cos(q[number]), np.sin(q[number])]
            theirs[joint.idx_q : joint.idx_q + joint.nq] = turned
        wanted = pin.rnea(model, data, theirs, v[order], a[order])
        found = world.inverse_dynamics(q, v, a, {})[order]
        worst = max(worst, float(np.max(np.abs(found - wanted)) / np.max(np.abs(wanted))))
    return len(order), worst


def to_lock(urdf: Path) -> list[str]:
    """Return the joints of a robot that a scene cannot hold as they are, and can be locked."""
    robot = read_robot(urdf)
    return [j.name for j in robot.joints.values() if j.kind == "prismatic" or (j.mimic and j.kind != "fixed")]


def told(pin: ModuleType, robot: Path, states: int, folder: Path) -> list[str]:
    """Say how a file compares, as it is or with joints locked, or why it is refused."""
    said: list[str] = []
    locked: list[str] = []
    try:
        imported_scene(robot)
    except UserError as error:
        said.append(f"{robot.name}: refused: {error}")
        try:
            locked = to_lock(robot)
        except UserError:
            return said
        if not locked:
            return said
        said.append(f"{robot.name}: with {', '.join(locked)} locked:")
    try:
        count, apart = difference(pin, robot, locked, states, folder)
    except UserError as error:
        return [*said, f"{robot.name}: refused: {error}"]
    return [*said, f"{robot.name}: {count} joints, {states} states: {apart:.1e}"]


def main() -> None:
    """Print the largest differences."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--arms", type=int, default=200)
    parser.add_argument("--states", type=int, default=20)
    parser.add_argument("robots", nargs="*", type=Path)
    given = parser.parse_args()
    try:
        import pinocchio as pin
    except ImportError:
        sys.exit(f"Pinocchio is not here: {HOW_TO_GET}")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        worst, joints = 0.0, 0
        for seed in range(given.arms):
            (folder / "robot.urdf").write_text(random_urdf(seed), encoding="utf-8")
            count, apart = difference(pin, folder / "robot.urdf", [], given.states, folder)
            worst, joints = max(worst, apart), joints + count
        print(
            f"{given.arms} robots drawn at random, {joints} joints, {given.states} states each: {worst:.1e}"
        )
        for robot in given.robots:
            print("\n".join(told(pin, robot, given.states, folder)))


if __name__ == "__main__":
    main()
