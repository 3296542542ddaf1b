"""The reference of arms in space against Pinocchio, at random states of random arms: inverse and forward dynamics.

Pinocchio is no dependency: where it cannot be imported, this says how to get it. Run it as
``python benchmarks/spatial_pinocchio.py [--arms 200]``.
"""

from __future__ import annotations

import argparse
import sys
from types import ModuleType
from typing import Any

import numpy as np
from support.spatial.random_arms import random_arm

from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.scene.spatial.arm import SpatialArm

HOW_TO_GET = (
    "pip install --target out/pin pin, then PYTHONPATH=out/pin/cmeel.prefix/lib/python3.11/site-packages"
)
STATES = 20


def pinocchio_model(pin: ModuleType, arm: SpatialArm) -> Any:
    """Return an arm as Pinocchio has it: joints, bodies and rotors; springs and dampers are torques there."""
    model = pin.Model()
    model.gravity.linear = np.array(arm.gravity)
    kinds = (pin.JointModelRX, pin.JointModelRY, pin.JointModelRZ)
    for number, joint in enumerate(arm.joints, start=1):
        place = pin.SE3(np.array(joint.turn), np.array(joint.at))
        found = model.addJoint(joint.host, kinds[joint.axis](), place, joint.name)
        assert found == number
        xx, yy, zz, xy, xz, yz = joint.body.inertia
        inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        body = pin.Inertia(joint.body.mass, np.array(joint.body.center), inertia)
        model.appendBodyToJoint(number, body, pin.SE3.Identity())
    model.armature = np.array([joint.armature for joint in arm.joints])
    return model


def differences(pin: ModuleType, seed: int) -> tuple[float, float, float]:
    """Return the largest relative differences of torques, accelerations and mass matrices of an arm."""
    arm = random_arm(seed)
    world, model = WorldArm(arm), pinocchio_model(pin, arm)
    data, rng = model.createData(), np.random.default_rng(seed)
    worst = np.zeros(3)
    for _ in range(STATES):
        q, v, a = rng.uniform(-3.0, 3.0, (3, len(arm.joints)))
        names = [item.name for item in arm.inputs if item.acts == "torque"]
        inputs = dict(zip(names, rng.normal(size=len(names)).tolist(), strict=True))
        torque = world.torque(q, v, inputs)
        pairs = (
            (world.inverse_dynamics(q, v, a, inputs) + torque, pin.rnea(model, data, q, v, a)),
            (world.forward_dynamics(q, v, inputs), pin.aba(model, data, q, v, torque)),
            (world.mass_matrix(q), _whole(pin.crba(model, data, q), model.armature)),
        )
        apart = [float(np.max(np.abs(one - other)) / np.max(np.abs(other))) for one, other in pairs]
        worst = np.maximum(worst, apart)
    return float(worst[0]), float(worst[1]), float(worst[2])


def _whole(upper: np.ndarray, armature: np.ndarray) -> np.ndarray:
    """Return a mass matrix of which Pinocchio may have filled the upper half alone."""
    top = np.triu(upper)
    return np.asarray(top + np.triu(top, 1).T)


def main() -> None:
    """Print the largest differences over all arms."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--arms", type=int, default=200)
    arms = parser.parse_args().arms
    try:
        import pinocchio as pin
    except ImportError:
        sys.exit(f"Pinocchio is not here: {HOW_TO_GET}")
    worst = np.max([differences(pin, seed) for seed in range(arms)], axis=0)
    print(f"Pinocchio {pin.__version__}, {arms} arms, {STATES} states each; largest relative differences:")
    for name, value in zip(("rnea, torques", "aba, accelerations", "crba, mass matrix"), worst, strict=True):
        print(f"  {name:20s} {value:.1e}")


if __name__ == "__main__":
    main()
