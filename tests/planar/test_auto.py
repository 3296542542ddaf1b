"""Runs sweep as often as it takes, the same in every backend, and say how good what they find is."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from tmm_gen.inputs.signals import Constant
from tmm_gen.native import compile_kernel
from tmm_gen.native.python_module import numpy_module
from tmm_gen.program.build import build_program
from tmm_gen.program.evaluate import allocate, execute, key
from tmm_gen.program.statements import Until
from tmm_gen.reference.planar_reference import planar_response
from tmm_gen.scene import Scene, parse_scene
from tmm_gen.scene.model import MOST_SWEEPS
from tmm_gen.simulate.run import simulate
from tmm_gen.simulate.tolerance import InaccurateError

TORQUED = """
name = "torqued"
[model]
kind = "planar"
[integrator]
name = "sdirk4"
step = 0.01
[base]
kind = "motor"
inertia = 0.05
[beam]
length = 1.0
bending_stiffness = 3.1931
mass_per_length = 1.0
links = 10
damping_time = 0.002
[tip]
mass = 0.2
[[input]]
name = "torque"
at = "base"
acts = "torque"
[[output]]
name = "tip"
at = "tip"
of = "position"
"""

FOLDED = """
name = "folded"
[model]
kind = "planar"
gravity = 9.81
[integrator]
name = "newmark"
step = 5e-4
[base]
kind = "clamp"
[[joint]]
stiffness = 1e-3
repeat = {links}
[[link]]
mass = {mass}
length = {length}
inertia = {inertia}
repeat = {links}
[[output]]
name = "tip"
at = "tip"
of = "position"
[initial]
angles = {angles}
"""


def folded(links: int, turn: float = 3.0) -> Scene:
    mass, length = 0.5 / links, 1.0 / links
    angles = [turn * (k % 2) for k in range(links)]
    return parse_scene(
        FOLDED.format(links=links, mass=mass, length=length, inertia=mass * length**2 / 12.0, angles=angles)
    )


@pytest.mark.compiler
@pytest.mark.parametrize("base", ["clamp", "motor", "prescribed"])
def test_interpreter_numpy_and_c_sweep_alike(base: str, unlike: Callable[..., Scene]) -> None:
    scene = unlike(base, step=0.02)
    program = build_program(scene, auto=True)
    kernel, module = compile_kernel(program, scene), numpy_module(scene, program)
    kernel.prepare()
    kernel.initialise()
    model, state = module.prepare(), module.initialise()
    variables = (program.step, *program.parameters, *program.state, *program.inputs, *program.given)
    values = allocate(variables, float)
    for phase in (program.prepare, program.initialise):
        execute(phase, values)
    for _ in range(5):
        kernel.step()
        state = module.step(model, state, module.Input())
        execute(program.main, values)
    for variable in program.state:
        np.testing.assert_allclose(kernel.state[variable.name], values[key(variable)], rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(getattr(state, variable.name), values[key(variable)], rtol=1e-9, atol=1e-9)
    assert 5 < kernel.state["sweeps"] < 5 * MOST_SWEEPS


def test_kernels_that_are_emitted_sweep_once_unless_the_scene_says_how_often(
    falling: Callable[..., Scene],
) -> None:
    scene = falling(2)
    assert scene.model.iterations == "auto"
    open_, once, twice = (
        build_program(changed)
        for changed in (scene, *(scene.replace(**{"model.iterations": k}) for k in (1, 2)))
    )
    assert open_ == once != twice
    assert not any(isinstance(s, Until) for s in open_.main.statements())
    assert any(isinstance(s, Until) for s in build_program(scene, auto=True).main.statements())


@pytest.mark.compiler
def test_what_one_sweep_was_refused_for_though_right_passes_and_says_how_right() -> None:
    scene, signals = parse_scene(TORQUED), {"torque": Constant(2.0)}
    run = simulate(scene, signals, 0.5, "c")
    exact = planar_response(scene, signals, run.time)
    off = np.max(np.hypot(*(run.outputs[name] - exact[name] for name in exact)))
    moved = np.max(np.hypot(*(values - values[0] for values in exact.values())))
    assert run.accuracy is not None
    assert off / moved <= 5.0 * run.accuracy.error
    assert run.accuracy.error < 1e-3
    assert run.sweeps_per_step is not None
    assert run.sweeps_per_step >= 3.0  # of three stages


@pytest.mark.compiler
@pytest.mark.parametrize("real", ["float32", "compensated"])
def test_single_precision(real: str, falling: Callable[..., Scene]) -> None:
    changes: dict[str, Any] = {"emit.real": "float32"}
    if real == "compensated":
        changes |= {"emit.compensated": True, "emit.trigonometry": "own"}
    scene = falling(3, **changes)
    run = simulate(scene, {}, 0.5, "c")
    exact = planar_response(scene, {}, run.time)
    off = np.max(np.hypot(*(run.outputs[name] - exact[name] for name in exact)))
    moved = np.max(np.hypot(*(values - values[0] for values in exact.values())))
    assert run.accuracy is not None
    assert off / moved <= 5.0 * run.accuracy.error + 1e-6
    with pytest.raises(InaccurateError):
        simulate(falling(3, **changes, **{"integrator.step": 0.1}), {}, 2.0, "c")


@pytest.mark.long
@pytest.mark.compiler
def test_folded_chains_are_sensitive_and_say_so() -> None:
    with pytest.raises(InaccurateError) as refusal:
        simulate(folded(20), {}, 1.0, "c")
    said = str(refusal.value)
    assert "The motion is sensitive: a small disturbance of its start grows" in said
    until = float(said.partition("--until ")[2].partition(";")[0])
    shorter = simulate(folded(20), {}, until, "c")
    assert shorter.accuracy is not None
    exact = planar_response(folded(20), {}, shorter.time[[0, -1]])
    off = np.hypot(*(shorter.outputs[name][-1] - exact[name][-1] for name in exact))
    assert off <= 5.0 * shorter.accuracy.error


@pytest.mark.compiler
def test_one_that_hangs_straight_is_not(falling: Callable[..., Scene]) -> None:
    run = simulate(falling(5), {}, 1.0, "c")
    assert run.accuracy is not None
    assert run.accuracy.sensitivity is not None
    assert run.accuracy.sensitivity < 30.0


@pytest.mark.compiler
@pytest.mark.parametrize("integrator", ["newmark", "sdirk2", "houbolt"])
@pytest.mark.parametrize("times", [1.0, 100.0])
def test_small_vibrations_that_die_within_a_step_are_not_taken_for_rest(
    integrator: str, times: float, falling: Callable[..., Scene]
) -> None:
    """Linear, so that every step can be solved; damping integrators agree on a rest at steps of any such length."""
    scene = falling(2, **{"model.gravity": None, "beam.damping_time": 0.0})
    slow = scene.replace(integrator={"name": integrator, "step": times}, initial={"angles": [5e-7, 1e-6]})
    with pytest.raises(InaccurateError):
        simulate(slow, {}, 50.0 * times, "c")
