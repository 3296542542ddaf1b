"""The smallest arms: every axis alone and in pairs, in which much of a sweep is zero or known beforehand."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.emit.numpy import emit_numpy
from tmm_gen.native.python_module import import_package
from tmm_gen.program.space.assemble import SpaceChoices, build_in_space
from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.scene import load_scene
from tmm_gen.scene.spatial.arm import ArmInput, ArmOutput, Frame, Revolute, RigidBody, SpatialArm, Vector

HEADED = load_scene(Path(__file__).resolve().parents[2] / "scenes" / "arm10.toml")
"""Any scene: headers are written of one."""

ROD = RigidBody(0.2, (0.05, 0.0, 0.0), (1e-3, 2e-3, 2e-3, 0.0, 0.0, 0.0))
ODD = RigidBody(0.3, (0.05, 0.02, -0.03), (1e-3, 2e-3, 3e-3, 1e-4, -2e-4, 1e-4))


def accelerations(arm: SpatialArm) -> tuple[np.ndarray, np.ndarray]:
    """Return the generated accelerations at the start, after a step that must be finite, and the reference's."""
    program = build_in_space(arm, "arm", "arm", integrator("newmark"), SpaceChoices(1e-3))
    module = import_package(emit_numpy(program, HEADED), "arm")
    state = module.initialise(module.Params(), module.Input(push=0.3))
    after = module.step(module.prepare(), state, module.Input(push=0.3))
    read = module.output(module.prepare(), after)
    assert np.shape(read.tip_x) == ()
    assert all(np.all(np.isfinite(value)) for value in vars(after).values())
    q, v = (np.array([getattr(joint, name) for joint in arm.joints]) for name in ("angle", "rate"))
    return np.asarray(state.acceleration), WorldArm(arm).forward_dynamics(q, v, {"push": 0.3})


def arm_of(axes: tuple[int, ...], body: RigidBody, place: Vector, gravity: Vector) -> SpatialArm:
    joints = tuple(
        Revolute(
            f"joint{k}",
            k,
            place,
            axis=axis,  # type: ignore[arg-type]
            body=body,
            stiffness=1.0,
            damping=0.1,
            angle=0.3 - 0.5 * k,
            rate=1.0 + k,
        )
        for k, axis in enumerate(axes)
    )
    tip = Frame("tip", len(joints), (0.1, 0.0, 0.0))
    outputs = (ArmOutput("tip", "position", frame=tip), ArmOutput("turn", "angle", joint=1))
    return SpatialArm(joints, (tip,), gravity, (ArmInput("push", "torque", 1),), outputs)


@pytest.mark.parametrize("axes", [(0,), (1,), (2,), *((i, j) for i in range(3) for j in range(3))])
def test_start(axes: tuple[int, ...]) -> None:
    for body, place, gravity in (
        (ROD, (0.8, 0.0, 0.0), (0.0, 0.0, -9.81)),
        (ODD, (0.1, -0.2, 0.3), (1.0, 2.0, 3.0)),
    ):
        found, exact = accelerations(arm_of(axes, body, place, gravity))
        assert np.max(np.abs(found - exact)) < 1e-11 * max(1.0, np.max(np.abs(exact)))
