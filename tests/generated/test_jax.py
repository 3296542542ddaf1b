"""The JAX backend: a step is NumPy's, its derivatives are differences of NumPy's kernel, what C refuses is NaN."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable
from dataclasses import fields, replace
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from tmm_gen.emit.jax.statements import RoutineText
from tmm_gen.emit.python.names import Names
from tmm_gen.errors import UserError
from tmm_gen.native.python_module import jax_module, numpy_module
from tmm_gen.program.build import build_program
from tmm_gen.program.statements import Assign, Loop, Order, Program, Routine, Section
from tmm_gen.program.variables import Role, Variable
from tmm_gen.scene import Scene, load_scene

jax: Any = pytest.importorskip("jax") if not os.environ.get("CI") else __import__("jax")
jnp = jax.numpy

ROOT = Path(__file__).resolve().parents[2]
CASES: dict[str, tuple[str, dict[str, Any], bool]] = {
    "chain with start-up steps": ("scenes/thesis2", {"integrator.name": "mixed"}, True),
    "sweeps until it is solved": ("scenes/arm2", {"integrator.name": "newmark", "integrator.step": 0.02}, True),
    "chain with stages": ("scenes/drivetrain", {"integrator.name": "sdirk2"}, False),
    "geared shafts": ("scenes/geartrain", {}, False),
    "two branches": ("scenes/gripper", {}, False),
    "a free base": ("scenes/cube", {}, False),
    "space, several joints at a time": ("examples/space/yaw3", {}, False),
}
"""A scene, what is changed, and whether it is compiled: without it, what is written is done line by line, sooner."""


@pytest.fixture(scope="module", autouse=True)
def _double() -> Any:
    before = jax.config.jax_enable_x64
    jax.config.update("jax_enable_x64", True)
    yield
    jax.config.update("jax_enable_x64", before)


def scene_of(name: str, **changes: Any) -> Scene:
    return load_scene(ROOT / f"{name}.toml").replace(**changes)


def flat(found: Any) -> np.ndarray:
    names = [each.name for each in fields(found) if each.name != "steps_taken"]
    return np.concatenate([np.ravel(getattr(found, name)) for name in names])


def compare(found: Any, expected: Any, tolerance: float = 1e-12) -> None:
    a, b = flat(found), flat(expected)
    assert np.abs(a - b).max() <= tolerance * np.abs(b).max()


@pytest.mark.parametrize("case", CASES)
def test_steps_are_those_of_numpy(case: str) -> None:
    """From a random motion, each start-up step too."""
    name, changes, compiled = CASES[case]
    scene = scene_of(name, **changes)
    program = build_program(scene, auto=compiled)
    with contextlib.nullcontext() if compiled else jax.disable_jit():
        compare_steps(scene, program)


def compare_steps(scene: Scene, program: Program) -> None:
    ours, theirs = jax_module(scene, program), numpy_module(scene, program)
    draw = np.random.default_rng(3)
    model, begin = theirs.prepare(), theirs.initialise()
    compare(jax.jit(ours.prepare)(), model)
    step = jax.jit(lambda state, acting: step_and_output(ours, ours.prepare(), state, acting))
    size = 1.0 if scene.model.kind == "chain" else 0.2 / program.stations
    for taken in range(len(program.steps)):
        values = {v.name: getattr(begin, v.name) + size * draw.normal(size=v.length or ()) for v in program.state}
        counted = {"steps_taken": taken} if program.startup else {}
        acting = {v.name: draw.normal() for v in program.inputs}
        found, outputs = step(ours.State(**values, **counted), ours.Input(**acting))
        expected = theirs.step(model, theirs.State(**values, **counted), theirs.Input(**acting))
        compare(found, expected)
        compare(outputs, theirs.output(model, theirs.State(**values, **counted)))
        if program.startup:
            assert found.steps_taken == expected.steps_taken == taken + 1


def step_and_output(module: ModuleType, model: Any, state: Any, acting: Any) -> tuple[Any, Any]:
    return module.step(model, state, acting), module.output(model, state)


@pytest.fixture(scope="module")
def swing() -> tuple[ModuleType, ModuleType]:
    """JAX and NumPy kernels of an arm of two unlike links."""
    scene = scene_of("scenes/arm2", **{"integrator.name": "newmark"})
    program = build_program(scene)
    return jax_module(scene, program), numpy_module(scene, program)


def test_derivatives_through_time_are_differences_of_numpy(swing: tuple[ModuleType, ModuleType]) -> None:
    """By stiffness and by torques, in one run backward."""
    ours, theirs = swing
    steps = 30
    torque = 0.5 * np.sin(np.arange(steps))
    name = ours.INPUT_NAMES[0]

    def cost(stiffness: Any, torque: Any) -> Any:
        params = replace(ours.Params(), stiffness=stiffness)
        found, _ = ours.simulate(steps, ours.Input(**{name: torque}), params)
        return jnp.sum(getattr(found, ours.OUTPUT_NAMES[0]) ** 2)

    def same(stiffness: np.ndarray, torque: np.ndarray) -> float:
        params = replace(theirs.Params(), stiffness=stiffness)
        model, state = theirs.prepare(params), theirs.initialise(params, theirs.Input(**{name: torque[0]}))
        rows = [theirs.output(model, state)]
        for now in torque:
            state = theirs.step(model, state, theirs.Input(**{name: now}))
            rows.append(theirs.output(model, state))
        return float(sum(getattr(row, theirs.OUTPUT_NAMES[0]) ** 2 for row in rows))

    stiffness = np.array(theirs.Params().stiffness)
    value, (by_stiffness, by_torque) = jax.jit(jax.value_and_grad(cost, argnums=(0, 1)))(stiffness, torque)
    assert value == pytest.approx(same(stiffness, torque), rel=1e-12)

    def difference(change: Callable[[float], float], size: float) -> float:
        return (8 * (change(size) - change(-size)) - change(2 * size) + change(-2 * size)) / (12 * size)

    for k in range(stiffness.size):
        at = np.eye(stiffness.size)[k]
        central = difference(lambda d, at=at: same(stiffness + d * at, torque), 1e-3 * stiffness[k])  # type: ignore[misc]
        assert by_stiffness[k] == pytest.approx(central, rel=1e-7)
    for k in (0, 7, steps - 1):
        at = np.eye(steps)[k]
        central = difference(lambda d, at=at: same(stiffness, torque + d * at), 1e-2)  # type: ignore[misc]
        assert by_torque[k] == pytest.approx(central, rel=1e-7)


def test_of_many_arms_a_bad_one_alone_is_nan() -> None:
    """A number that is not finite, a step that is not positive, a pivot that vanishes; the others' bits stay."""
    ours = jax_module(scene_of("scenes/thesis2"))
    name = ours.INPUT_NAMES[0] if ours.INPUT_NAMES else None
    assert name is not None

    def run(inertia: Any, step: Any, torque: Any) -> Any:
        params = replace(ours.Params(), inertia=inertia)
        return ours.simulate(3, ours.Input(**{name: torque}), params, step)

    inertia, step, torque = (np.full(5, value) for value in (ours.Params().inertia, ours.STEP, 0.5))
    inertia[1], step[2], torque[3] = -1e9, -0.1, np.inf
    outputs, state = jax.jit(jax.vmap(run))(inertia, step, torque)
    found = np.array([np.isnan(leaf).reshape(5, -1).all(axis=1) for leaf in jax.tree.leaves(state)])
    assert (found == [False, True, True, True, False]).all()
    for leaf in jax.tree.leaves((outputs, state)):
        assert np.array_equal(leaf[0], leaf[4])


def test_the_state_keeps_its_number_type(swing: tuple[ModuleType, ModuleType]) -> None:
    ours, _ = swing
    with jax.enable_x64(False):
        _, state = jax.eval_shape(lambda: ours.simulate(2))
    assert {leaf.dtype for leaf in jax.tree.leaves(state)} == {np.dtype(np.float32)}
    _, state = jax.eval_shape(lambda: ours.simulate(2))
    assert {leaf.dtype for leaf in jax.tree.leaves(state)} == {np.dtype(np.float64)}


def test_what_is_compiled_does_not_grow_with_the_arm() -> None:
    sizes = set()
    for links in (4, 30):
        module = jax_module(scene_of("scenes/arm10", **{"beam.links": links}))
        traced = jax.make_jaxpr(lambda m=module: m.step(m.prepare(), m.initialise()))()
        sizes.add(len(traced.eqns))
    assert len(sizes) == 1
    assert sizes.pop() > 50


def test_what_cannot_be_written_is_refused_in_a_line() -> None:
    scene = scene_of("scenes/thesis2")
    program = build_program(scene)
    handed = Variable("handed", Role.WORK, 3)
    loop = Loop(Order.OUTWARD, 1, 3, (Assign(handed.at(0), handed.at(-1) * 2),))
    routine = Routine("step", "", (Section("all", (Assign(handed.entry(0), program.step.ref), loop)),))
    with pytest.raises(UserError, match=r'^emit.backends: jax cannot write step, .* Leave "jax" out\.$'):
        RoutineText(routine, Names(program, ()), 3).lines(())
