"""Sums of two floats in space: as good as the outputs' own rounding where single precision is not."""

from __future__ import annotations

import numpy as np
import pytest
from support.spatial.boom import BOOM

from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.scene import parse_scene

pytestmark = pytest.mark.compiler

ACTING = {"torque": 0.05, "push_x": 0.4, "push_y": 0.5, "push_z": -0.6}
STEPS = 1000


def test_compensated_kernels_keep_what_single_precision_loses() -> None:
    scene = parse_scene(BOOM)
    program = build_program(scene)
    single = {"emit.real": "float32"}
    compensated = {**single, "emit.compensated": True, "emit.trigonometry": "own"}
    exact, *others = (
        _after(compile_kernel(program, scene.replace(**changes) if changes else scene))
        for changes in ({}, single, compensated)
    )
    plain, sums = (np.max(np.abs(found - exact) / np.maximum(np.abs(exact), 1.0)) for found in others)
    assert exact[-1] > 4.0  # rad, of a joint that nothing pulls back
    assert sums < 2.0**-24 < 1e-6 < plain


def test_a_base_that_floats_starts_by_pairs_too() -> None:
    """Its quaternion, which may be given at any length, is brought to length one with all 48 bits."""
    hub = 'kind = "free"\n[[body]]\nname = "hub"\non = "base"\nmass = 1.0\ninertia = [0.1, 0.2, 0.3]'
    changes = {"emit.real": "float32", "emit.trigonometry": "own", "emit.compensated": True}
    scene = parse_scene(BOOM.replace('kind = "clamp"', hub)).replace(**changes)
    kernel = compile_kernel(build_program(scene), scene, flags=("-O0",))
    kernel.prepare()
    given = np.array([1.0, 2.0, 3.0, 4.0])
    kernel.initialise({}, initial_base_quaternion=given)
    begun = [float(kernel.state[f"base_quaternion_{part}"]) for part in "wxyz"]
    assert begun == pytest.approx(given / np.linalg.norm(given), rel=1e-13)


def _after(kernel: NativeKernel) -> np.ndarray:
    """Return the outputs after some steps; inputs are single numbers in all types."""
    acting = {name: float(np.float32(value)) for name, value in ACTING.items()}
    kernel.prepare()
    kernel.initialise(acting)
    for _ in range(STEPS):
        kernel.step(acting)
    return np.array(list(kernel.output().values()))
