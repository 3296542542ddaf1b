"""The whole text of a small scene's Python backends, as it was last read and found good."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from tmm_gen.emit.casadi import emit_casadi
from tmm_gen.emit.numpy import emit_numpy
from tmm_gen.program.build import build_program
from tmm_gen.scene import parse_scene

# Everything that shapes the text: start-up steps, a hub, stations that differ, a load between, a long name.
SMALL = """
name = "small"
title = "Two discs on a hub"

[model]
kind = "chain"

[integrator]
name = "zhou"
step = 0.01

[base]
kind = "motor"
inertia = 0.5
damping = 0.1

[[joint]]
stiffness = 20.0
damping = 0.5

[[link]]
inertia = 1.0

[[joint]]
stiffness = 35.0

[[link]]
inertia = 2.0

[[input]]
name = "torque_of_the_motor_in_the_hub_of_the_small_arm"
at = "base"
acts = "torque"

[[input]]
name = "load"
at = 1
acts = "torque"

[[output]]
name = "tip"
at = "tip"
of = "angle"

[[output]]
name = "twist"
at = 2
of = "torque"
"""


def test_the_text_of_a_small_scene(compare_or_update: Callable[[str, Mapping[str, str]], None]) -> None:
    scene = parse_scene(SMALL)
    program = build_program(scene)
    compare_or_update("small", {**emit_numpy(program, scene), **emit_casadi(program, scene)})
