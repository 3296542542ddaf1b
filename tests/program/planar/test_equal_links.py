"""Links that are all alike share scalars; what prepare computes from them comes after they are there."""

from __future__ import annotations

import pytest

from tmm_gen.program.build import build_program
from tmm_gen.program.passes.lifetimes import read_before_written
from tmm_gen.scene import parse_scene

SCENE = """
name = "alike"
[model]
kind = "planar"
unknown = "{unknown}"
[integrator]
name = "newmark"
step = 1e-3
[base]
kind = "{base}"
{inertia}
[beam]
length = 1.0
bending_stiffness = 2.0
mass_per_length = 0.5
links = 3
springs = "half-clamp"
damping_time = 0.001
{signals}
[[output]]
name = "tip"
at = "tip"
of = "position"
"""
PRESCRIBED = '[[input]]\nname = "turn"\nat = "base"\nacts = "angle"'


@pytest.mark.parametrize("unknown", ["acceleration", "increment", "displacement"])
@pytest.mark.parametrize("base", ["clamp", "motor", "prescribed"])
def test_every_routine_reads_only_what_is_there(base: str, unknown: str) -> None:
    scene = parse_scene(
        SCENE.format(
            base=base,
            unknown=unknown,
            inertia="inertia = 0.1" if base == "motor" else "",
            signals=PRESCRIBED if base == "prescribed" else "",
        )
    )
    program = build_program(scene)
    for routine in (program.prepare, program.initialise, *program.steps, program.output):
        assert read_before_written(routine) is None, routine.name
