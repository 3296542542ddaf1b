"""Generated arms in space against the reference at single states: accelerations under all loads, and every output."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from support.spatial.random_arms import random_arm

from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.emit.numpy import emit_numpy
from tmm_gen.native.python_module import import_package
from tmm_gen.program.space.assemble import SpaceChoices, build_in_space
from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.reference.spatial_reference import outputs
from tmm_gen.scene import load_scene
from tmm_gen.scene.spatial.arm import ArmOutput

HEADED = load_scene(Path(__file__).resolve().parents[2] / "scenes" / "arm10.toml")
"""Any scene: headers are written of one."""


SEEDS = range(4)


@cache
def compared(seed: int) -> tuple[dict[str, float], dict[str, float], float]:
    """Return generated outputs and the reference's at a random state of a random arm, and the largest acceleration."""
    arm = random_arm(seed, 4)
    accelerations = tuple(ArmOutput(f"a_{k}", "acceleration", joint=k) for k in range(1, 5))
    arm = replace(arm, outputs=(*arm.outputs, *accelerations))
    program = build_in_space(arm, "arm", "arm", integrator("newmark"), SpaceChoices(1e-3))
    module = import_package(emit_numpy(program, HEADED), "arm")
    rng = np.random.default_rng(seed)
    q, v = rng.uniform(-2.0, 2.0, (2, len(arm.joints)))
    columns = [column for item in arm.inputs for column in item.columns]
    inputs = dict(zip(columns, rng.normal(size=len(columns)).tolist(), strict=True))
    state = module.initialise(module.Params(), module.Input(**inputs), initial_angle=q, initial_rate=v)
    read = module.output(module.prepare(), state)
    a = WorldArm(arm).forward_dynamics(q, v, inputs)
    given = {name: np.array([value]) for name, value in inputs.items()}
    exact = {name: float(x[0]) for name, x in outputs(arm, q[None], v[None], a[None], given).items()}
    return {name: float(getattr(read, name)) for name in exact}, exact, float(np.max(np.abs(a)))


@pytest.mark.parametrize("seed", SEEDS)
def test_start_and_outputs(seed: int) -> None:
    """With forces and moments in world and body axes, and torques behind gears, acting."""
    found, exact, largest = compared(seed)
    for name, value in exact.items():
        size = largest if name.startswith("a_") else max(1.0, abs(value))
        assert abs(found[name] - value) < 1e-12 * size, name
