"""A base that floats, an arm behind an elastic gear, and stages that are solved all at once: every language and run.

The reference has other equations for both: Lagrange's about the centre of mass, a shaft with its own angle.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from tmm_gen.inputs.signals import Signal
from tmm_gen.inputs.waveforms import Step
from tmm_gen.native import compile_kernel
from tmm_gen.native.python_module import casadi_module, jax_module, numpy_module
from tmm_gen.program.build import build_program
from tmm_gen.reference.planar_reference import planar_response
from tmm_gen.scene import Scene, parse_scene
from tmm_gen.simulate.run import simulate
from tmm_gen.verify.agreement import (
    casadi_step,
    jax_step,
    largest_difference,
    native_step,
    numpy_step,
    reached_vectors,
)

ROUNDING, SINGLE = 1e-12, 2e-3
SCENE = """
name = "panel"
model = {{ kind = "planar" }}
integrator = {{ name = "{integrator}", step = 0.01 }}
base = {{ kind = "free" }}
body = [{{ name = "hub", on = "base", mass = 2.0, inertia = 0.05 }}]
{output}
[[motor]]
name = "drive"
on = "base"
rotor_inertia = 2e-5
gear = 50
stiffness = 40.0
damping_time = 1e-3
[[link]]
name = "yoke"
on = "drive"
length = 0.3
mass = 0.2
inertia = 2e-3
[[joint]]
name = "hinge"
on = "yoke"
stiffness = 6.0
damping = 5e-3
[[link]]
name = "panel"
on = "hinge"
length = 0.5
mass = 0.4
inertia = 8e-3
[[input]]
name = "torque"
at = "drive"
acts = "torque"
[[input]]
name = "thrust"
at = "base"
acts = "force_y"
"""
PLACES = 'output = [{ name = "hub", at = "hub", of = "position" }, { name = "end", at = "panel", of = "position" }]'
TURNS = (
    'output = [{ name = "turn", at = "hub", of = "angle" }, { name = "gear", at = "drive", of = "torque" }]'
)
ACTING: dict[str, Signal] = {"torque": Step(0.02, 0.0, 0.0633), "thrust": Step(1.0, 0.3, 0.1171)}
"""Both jump within a step."""
UNTIL = 0.3


def panel(integrator: str, output: str = PLACES) -> Scene:
    return parse_scene(SCENE.format(integrator=integrator, output=output))


@cache
def exact(output: str) -> dict[str, np.ndarray]:
    """Return outputs every 3 ms."""
    return planar_response(panel("radau3", output), ACTING, 0.003 * np.arange(101))


@pytest.mark.compiler
@pytest.mark.parametrize("integrator", ["radau3", "gauss2"])
def test_backends_agree(integrator: str) -> None:
    """NumPy and C to the bit, and C in single precision to what that has."""
    scene = panel(integrator).replace(**{"integrator.step": 2e-3, "model.iterations": 2})
    program = build_program(scene)
    module = numpy_module(scene, program)
    ours, vectors = numpy_step(module, program), list(reached_vectors(module, program, 3))
    native = native_step(compile_kernel(program, scene, flags=("-O0", "-ffp-contract=off")), program)
    assert largest_difference(ours, native, vectors) == 0.0
    assert largest_difference(ours, casadi_step(casadi_module(scene, program), program), vectors) < ROUNDING
    single = scene.replace(**{"emit.real": "float32"})
    native = native_step(compile_kernel(program, single, flags=("-O0",)), program)
    assert ROUNDING < largest_difference(ours, native, vectors) < SINGLE


def test_jax_agrees() -> None:
    jax = pytest.importorskip("jax")
    scene = panel("radau2").replace(**{"integrator.step": 2e-3, "model.iterations": 1})
    program = build_program(scene)
    module = numpy_module(scene, program)
    vectors = list(reached_vectors(module, program, 2))
    with jax.disable_jit():  # line by line, for the time that compiling takes
        found = jax_step(jax_module(scene, program), program)
        assert largest_difference(numpy_step(module, program), found, vectors) < ROUNDING


@pytest.mark.compiler
@pytest.mark.parametrize("output", [PLACES, TURNS], ids=["places", "turns"])
@pytest.mark.parametrize("integrator", ["radau3", "gauss2"])
def test_steps_by_a_tolerance_end_at_jumps(integrator: str, output: str) -> None:
    """Rows every 3 ms, whatever the steps; with outputs that do not ask where the base is, too."""
    scene = panel(integrator, output).replace(**{"integrator.tolerance": 1e-5})
    run = simulate(scene, ACTING, UNTIL, "c", every=0.003)
    assert run.accuracy is not None
    assert run.accuracy.error <= 1e-5
    for name, values in exact(output).items():
        # a torque jumps where its motor's does
        assert np.max(np.abs(run.outputs[name] - values)) < 5e-5 * np.ptp(values), name


@pytest.mark.parametrize("output", [PLACES, TURNS], ids=["places", "turns"])
def test_rows_between_equal_steps(output: str) -> None:
    """Of Gauss's method, by its own polynomial: next to them rows of short steps."""
    long, short = (panel("gauss3", output).replace(**{"integrator.step": h}) for h in (6e-3, 3e-3))
    acting = {"torque": Step(0.02, 0.0, 0.06)}
    run = simulate(long, acting, UNTIL, judge=False, every=0.003)
    fine = simulate(short, acting, UNTIL, judge=False)
    for name, values in fine.outputs.items():
        assert np.max(np.abs(run.outputs[name] - values)) < 1e-4 * np.ptp(values), name
