"""Compiled kernels against the interpreter of the program they came from, from random states."""

from __future__ import annotations

from typing import Any

import mpmath
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tmm_gen.derive.integrators.registry import names
from tmm_gen.emit.c.lower import lower
from tmm_gen.native import compile_kernel
from tmm_gen.program.evaluate import allocate, execute, key
from tmm_gen.program.statements import Program
from tmm_gen.program.variables import Role

pytestmark = pytest.mark.compiler

KINDS = [
    *({"integrator": name, "base": "motor", "inner": True} for name in names()),
    # an explicit method, such as zhai, cannot follow a prescribed base
    *({"integrator": name, "base": "prescribed", "real": "float32"} for name in names() if name != "zhai"),
    {"alike": True, "stations": 7},
    {"alike": True, "stations": 7, "integrator": "sdirk4"},
]
OTHER_KINDS = [
    *({"unknown": unknown, "inner": True} for unknown in ("increment", "displacement")),
    *(
        {"unknown": "displacement", "integrator": name, "base": "motor"}
        for name in ("houbolt", "sdirk4", "bathe")
    ),
    *({"sweep": "product", "base": base, "inner": True} for base in ("clamp", "motor", "prescribed")),
    {"sweep": "product", "integrator": "sdirk2", "real": "float32", "stations": 2, "step": 0.3},
    {"integrator": "newmark", "parameters": "beta = 0.0", "damped": False},
    {"stations": 1, "base": "free motor"},
]
numbers = st.floats(-8.0, 8.0, width=32)
relaxed = settings(max_examples=6, suppress_health_check=[HealthCheck.function_scoped_fixture])


def name_of(kind: dict[str, Any]) -> str:
    return "-".join(map(str, kind.values()))


def draw(data: st.DataObject, program: Program) -> tuple[dict[str, Any], dict[str, Any]]:
    """Draw a state and inputs."""

    def values(variables: Any) -> dict[str, Any]:
        seed = np.random.default_rng(data.draw(st.integers(0, 2**32 - 1)))
        edge = data.draw(numbers)  # hypothesis shrinks towards plain ones
        drawn = {}
        for v in variables:
            array = np.float32(seed.uniform(-8.0, 8.0, v.length or 1)).astype(float)
            array[0] = edge
            drawn[v.name] = array if v.length else float(array[0])
        return drawn

    return values(program.state), values(program.inputs)


@pytest.mark.parametrize("kind", [k for k in KINDS if k.get("real") != "float32"], ids=name_of)
@relaxed
@given(data=st.data())
def test_one_step_equals_the_interpreter(data: st.DataObject, kind: dict[str, Any], chain: Any) -> None:
    """To 1e-13 of the largest angle, rate or acceleration, after one step in 30 digits."""
    of = chain(**kind)
    program = of.program
    state, inputs = draw(data, program)
    kernel = of.kernel
    kernel.initialise()
    taken = data.draw(st.integers(0, len(program.startup)))
    kernel.state = {**state, **({"start_steps_taken": taken} if program.startup else {})}
    kernel.step(inputs)
    found = kernel.state

    with mpmath.workdps(30):
        values = allocate((program.step, *program.parameters), mpmath.mpf)
        keys = {v.name: key(v) for v in program.inputs}
        for name, value in {**state, **inputs}.items():
            values[keys.get(name, name)] = (
                [mpmath.mpf(x) for x in value] if np.ndim(value) else mpmath.mpf(value)
            )
        for routine in (program.prepare, program.steps[taken]):
            execute(routine, values, mpmath.mpf, "mpmath")
        for unit in {v.unit for v in program.state}:
            alike = [v for v in program.state if v.unit == unit]
            exact = np.hstack([np.array(values[v.name], dtype=object) for v in alike]).astype(float)
            error = np.abs(np.hstack([found[v.name] for v in alike]) - exact)
            assert error.max() <= 1e-13 * max(np.abs(exact).max(), 1e-300), unit


@pytest.mark.parametrize("kind", [*KINDS, *OTHER_KINDS], ids=name_of)
@relaxed
@given(data=st.data())
def test_steps_are_the_same_bits(
    data: st.DataObject, kind: dict[str, Any], chain: Any, written_order: Any
) -> None:
    """Every number of state and output, in the order of operations that all backends share."""
    of = chain(**kind)
    program = of.program
    state, inputs = draw(data, program)
    kernel = of.kernel
    kernel.initialise(inputs)
    kernel.state = state
    expected = written_order(program, of.real)
    for name, value in {**state, **inputs}.items():
        expected.set(name, value)
    expected.run(program.prepare)
    for taken in range(len(program.startup) + 2):
        kernel.step(inputs)
        expected.step(taken)
        expected.run(program.output)
        found = kernel.state | kernel.output()
        for variable in (*program.state, *program.outputs):
            right = np.array(expected.values[variable.name], dtype=float)
            assert np.array_equal(np.asarray(found[variable.name]), right), (variable.name, taken)


@pytest.mark.parametrize(
    "kind", [KINDS[0], {"base": "motor", "integrator": "houbolt", "real": "float32"}], ids=name_of
)
@pytest.mark.parametrize(
    "flags", [("-O0",), ("-O3", "-ffp-contract=off"), ("-Os", "-ffp-contract=off")], ids=str
)
@pytest.mark.parametrize("compiler", ["gcc", "clang"])
def test_bits_do_not_depend_on_optimisation(
    compiler: str, flags: tuple[str, ...], kind: dict[str, Any], chain: Any, need_tool: Any
) -> None:
    need_tool(compiler)
    of = chain(**kind)
    kernels = [compile_kernel(of.program, of.scene), compile_kernel(of.program, of.scene, compiler, flags)]
    inputs = {v.name: (lambda t, k=k: np.cos(9.0 * t + k)) for k, v in enumerate(of.program.inputs)}
    (_, first), (_, second) = (kernel.simulate(2.0, inputs) for kernel in kernels)
    for name in first:
        assert np.array_equal(first[name], second[name])
        assert np.ptp(first[name]) > 0


@pytest.mark.parametrize("kind", [*KINDS, *OTHER_KINDS], ids=name_of)
def test_lowering_keeps_every_bit(kind: dict[str, Any], chain: Any, written_order: Any) -> None:
    """All routines, run in the written order before and after the passes."""
    of = chain(**kind)
    lowered = lower(of.program)
    before, after = (written_order(p, of.real) for p in (of.program, lowered))
    for k, variable in enumerate((*of.program.given, *of.program.inputs)):
        for executor in (before, after):
            executor.set(
                variable.name, np.sin(np.arange(variable.length or 1) + k)[: variable.length or 1].squeeze()
            )
    for one, other in zip(
        (of.program.prepare, of.program.initialise, *of.program.steps, of.program.output),
        (lowered.prepare, lowered.initialise, *lowered.steps, lowered.output),
        strict=True,
    ):
        before.run(one)
        after.run(other)
        for variable in one.written():
            if variable.role not in (Role.WORK, Role.LOCAL):
                assert before.values[variable.name] == after.values[variable.name], (one.name, variable.name)
