"""Arms drawn at random: all backends take the same step, and it is that of Lagrange's equations."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from tmm_gen.inputs.signals import Sine
from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.native.python_module import casadi_module, numpy_module
from tmm_gen.program.build import build_program
from tmm_gen.reference.planar_reference import planar_response
from tmm_gen.scene import Scene
from tmm_gen.simulate.prescribed import kernel_signals
from tmm_gen.verify.agreement import (
    casadi_step,
    largest_difference,
    native_step,
    numpy_step,
    reached_vectors,
)

pytestmark = [pytest.mark.compiler, pytest.mark.long]

AGREE = 1e-12
UNTIL = 0.05
FEW = settings(max_examples=3, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))


@FEW
@example(seed=3, count=7, branching=True, floating=True)
@given(seed=st.integers(0, 10_000), count=st.integers(2, 12), branching=st.booleans(), floating=st.booleans())
def test_backends_agree(
    seed: int, count: int, branching: bool, floating: bool, drawn: Callable[..., Scene]
) -> None:
    scene = drawn(seed, count, branching=branching, floating=floating)
    program = build_program(scene)
    module = numpy_module(scene, program)
    ours = numpy_step(module, program)
    vectors = list(reached_vectors(module, program, 4))
    native = native_step(compile_kernel(program, scene, flags=("-O0",)), program)
    assert largest_difference(ours, native, vectors) < AGREE
    assert largest_difference(ours, casadi_step(casadi_module(scene, program), program), vectors) < AGREE


@FEW
@example(seed=15, count=6, order=4, branching=True, floating=False)  # an elastic gear begins a branch
@given(
    seed=st.integers(0, 10_000),
    count=st.integers(2, 12),
    order=st.sampled_from([2, 4]),
    branching=st.booleans(),
    floating=st.booleans(),
)
def test_steps_are_those_of_lagranges_equations(
    seed: int, count: int, order: int, branching: bool, floating: bool, drawn: Callable[..., Scene]
) -> None:
    """Within ten times the step's own error, which halving the step shows."""
    name, step, sweeps = {2: ("newmark", 2.5e-4, 2), 4: ("sdirk4", 1e-3, 1)}[order]
    arm = {"branching": branching, "floating": floating}
    scene = drawn(seed, count, integrator=name, step=step, iterations=sweeps, **arm)
    signals = {
        item.name: Sine(0.02, 3.0 + k, np.pi / 2.0 if item.acts == "angle" else 0.3)
        for k, item in enumerate(scene.inputs)
    }
    right = planar_response(scene, signals, np.array([UNTIL]))
    kernel = compile_kernel(build_program(scene), scene, flags=("-O0",))
    whole, half = (ended(kernel, scene, signals, step / share) for share in (1, 2))
    for column, values in right.items():
        own = abs(whole[column] - half[column]) + 1e-9 * max(1.0, abs(values[0]))
        assert abs(half[column] - values[0]) < 10.0 * own, column


@pytest.mark.parametrize(
    ("seed", "count", "floating"),
    [(3, 3, True), (15, 4, False)],  # the second has an elastic gear where a branch begins
)
def test_corrections_end_where_sweeps_end(
    seed: int, count: int, floating: bool, drawn: Callable[..., Scene]
) -> None:
    arm = {"step": 5e-4, "branching": True, "floating": floating}
    steps = []
    for rounds in ({"iterations": 4}, {"corrections": 4}):
        scene = drawn(seed, count, **arm, **rounds)
        program = build_program(scene)
        module = numpy_module(scene, program)
        steps.append(numpy_step(module, program))
    assert largest_difference(*steps, list(reached_vectors(module, program, 3))) < 1e-10


def ended(kernel: NativeKernel, scene: Scene, signals: dict[str, Sine], step: float) -> dict[str, float]:
    """Return the outputs of the compiled kernel at the end."""
    moving = kernel_signals(scene, signals)
    kernel.prepare(step=step)
    kernel.initialise({name: float(signal.at(0.0)) for name, signal in moving.items()})
    (instants,) = kernel.program.stage_instants
    for index in range(round(UNTIL / step)):
        times = step * (index + np.array(instants))
        values = {name: signal.at(times) for name, signal in moving.items()}
        kernel.step(values if len(instants) > 1 else {name: float(v[0]) for name, v in values.items()})
    return {name: float(value) for name, value in kernel.output().items()}
