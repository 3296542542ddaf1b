"""Kernels compiled for the machine's widest vectors start and step as plainly compiled ones do."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.native import compile_kernel
from tmm_gen.program.space.assemble import SpaceChoices, build_in_space
from tmm_gen.scene import parse_scene
from tmm_gen.scene.spatial.arm import ArmOutput

pytestmark = pytest.mark.compiler

YAW3 = Path(__file__).resolve().parents[2] / "examples" / "space" / "yaw3.toml"
# Beams of three cells are the shortest by which GCC 12 shows it: 2e-3 rad off with -U__AVX512F__, which takes the
# guard out of the kernel.
SCENE = parse_scene(YAW3.read_text("utf-8").replace("links = 5", "links = 3"))


def test_start_and_steps() -> None:
    """GCC 12 once lost the start's accelerations where it vectorised loops with AVX-512."""
    assert SCENE.spatial is not None
    angles = tuple(ArmOutput(f"angle_{k}", "angle", joint=k + 1) for k in range(SCENE.stations))
    torques = tuple(item for item in SCENE.spatial.inputs if item.acts == "torque")
    arm = replace(SCENE.spatial, inputs=torques, outputs=angles)
    program = build_in_space(arm, "yaw3", "yaw3", integrator("newmark"), SpaceChoices(1e-3))
    loads = {"yaw_torque": 0.05, "shoulder_torque": -0.1, "elbow_torque": -0.05}
    found = []
    for flags in (("-O1",), ("-O2", "-march=native"), ("-O3", "-march=native")):
        _, outputs = compile_kernel(program, SCENE, flags=flags).simulate(0.02, loads)
        found.append(np.array([outputs[output.name] for output in angles]))
    for other in found[1:]:
        assert np.max(np.abs(other - found[0])) < 1e-10
