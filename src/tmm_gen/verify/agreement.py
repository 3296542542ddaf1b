"""One step of every backend from the same random states, and how far apart the results are."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Values = dict[str, Array]
"""Numbers and arrays over stations, by the names of a program's variables."""

_BEND = 1e-3
"""rad; joints of a random start are bent by about this share of the number of joints."""
_STEPS = 3
"""Steps from a random start to a state with a history of its own."""

VECTORS = 20
"""Random states for each routine of a step."""


@dataclass(frozen=True)
class Vector:
    """A state to step from.

    Parameters
    ----------
    taken : int
        Steps that led there: less than the number of start-up steps, or that number.
    state : dict from str to array
        By variable.
    inputs : dict from str to float
        Held over the step.
    """

    taken: int
    state: Values
    inputs: dict[str, float]


@dataclass(frozen=True)
class Stepped:
    """The state one step later, and the outputs where the step began."""

    state: Values
    outputs: Values


Step = Callable[[Vector], Stepped]


def random_vectors(program: Any, count: int = VECTORS, seed: int = 0) -> Iterator[Vector]:
    """Yield random states and inputs for each start-up step and for the main one.

    Parameters
    ----------
    program : Program
        Whose state is meant.
    count : int
        Vectors for each routine.
    seed : int
        Of the random numbers, so that a check says the same twice.
    """
    random = np.random.default_rng(seed)
    for taken in range(len(program.steps)):
        for _ in range(count):
            state = {v.name: random.normal(size=v.length or ()) for v in program.state}
            inputs = {v.name: float(random.normal()) for v in program.inputs}
            yield Vector(taken, {name: np.asarray(value) for name, value in state.items()}, inputs)


def reached_vectors(
    module: ModuleType,
    program: Any,
    count: int = VECTORS,
    seed: int = 0,
    *,
    relative: bool = False,
    about: Array | None = None,
) -> Iterator[Vector]:
    """Yield states that an arm reaches within some steps from random, gently bent and moving starts.

    A state at random is none of an arm: stiff joints bent at will ask for forces under which no step can be solved.

    Parameters
    ----------
    module : module
        Generated NumPy package.
    program : Program
        What it was generated from.
    count : int
        Vectors for each routine.
    seed : int
        Of the random numbers.
    relative : bool
        Whether angles are those of joints, which start about where the scene has them, and not of links.
    about : array, (n,), optional
        Angles about which links start, rad; 0 if left out.
    """
    random = np.random.default_rng(seed)
    rest = about if about is not None else 0.0
    if relative:
        rest = np.array(next(v.default for v in program.given if v.name == "initial_angle"))
    model, n = module.prepare(), program.stations
    takes_step = "step" in inspect.signature(module.initialise).parameters
    for taken in range(len(program.steps)):
        for _ in range(count):
            # a prescribed base stands where the arm points to, and turns as gently
            points = float(random.uniform(-np.pi, np.pi)) if any(map(_of_base, program.inputs)) else 0.0
            inputs = {
                v.name: points
                if v.unit in ("rad", "m")
                else float(random.normal()) * (_BEND if _of_base(v) else 1.0)
                for v in program.inputs
            }
            bend, turn = random.normal(size=(2, n)) * _BEND / n
            start = (
                {"initial_angle": rest + bend, "initial_rate": turn}
                if relative
                else {"initial_angle": points + rest + np.cumsum(bend), "initial_rate": np.cumsum(turn)}
            )
            if takes_step:
                start["step"] = program.step.default
            given = module.Input(**inputs)
            state = module.initialise(module.Params(), given, **start)
            for _ in range(taken if taken < len(program.startup) else taken + _STEPS):
                state = module.step(model, state, given)
            values = {v.name: np.asarray(getattr(state, v.name)) for v in program.state}
            yield Vector(taken, values, inputs)


def _of_base(variable: Any) -> bool:
    """Whether an input is of a prescribed base: its angle or place, rate or acceleration."""
    return str(variable.unit).split("/")[0] in ("rad", "m")


def largest_difference(one: Step, other: Step, vectors: Iterable[Vector]) -> float:
    """Return the largest difference in any variable, relative to that variable's largest value."""
    worst = 0.0
    for vector in vectors:
        a, b = one(vector), other(vector)
        for left, right in ((a.state, b.state), (a.outputs, b.outputs)):
            for name, value in left.items():
                size = max(float(np.max(np.abs(value))), float(np.max(np.abs(right[name]))))
                if size > 0.0:
                    worst = max(worst, float(np.max(np.abs(value - right[name]))) / size)
    return worst


def numpy_step(module: ModuleType, program: Any) -> Step:
    """Return the step of a generated NumPy package."""
    model = module.prepare()

    def step(vector: Vector) -> Stepped:
        counted = {"steps_taken": vector.taken} if program.startup else {}
        state = module.State(**vector.state, **counted)
        after = module.step(model, state, module.Input(**vector.inputs))
        found = module.output(model, state)
        return Stepped(
            {v.name: np.asarray(getattr(after, v.name)) for v in program.state},
            {v.name: np.asarray(getattr(found, v.name)) for v in program.outputs},
        )

    return step


def jax_step(module: ModuleType, program: Any) -> Step:
    """Return the step of a generated JAX module, in double precision whatever JAX is set to."""
    import jax

    with jax.enable_x64(True):
        model = jax.jit(module.prepare)()
    compiled = jax.jit(lambda state, given: (module.step(model, state, given), module.output(model, state)))

    def step(vector: Vector) -> Stepped:
        counted = {"steps_taken": vector.taken} if program.startup else {}
        with jax.enable_x64(True):
            after, found = compiled(module.State(**vector.state, **counted), module.Input(**vector.inputs))
        return Stepped(
            {v.name: np.asarray(getattr(after, v.name)) for v in program.state},
            {v.name: np.asarray(getattr(found, v.name)) for v in program.outputs},
        )

    return step


def casadi_step(module: ModuleType, program: Any) -> Step:
    """Return the step of a generated CasADi model."""
    functions = (*module.start_functions(), module.step_function())
    parameters = module.default_parameters()

    def step(vector: Vector) -> Stepped:
        x = np.concatenate([np.atleast_1d(vector.state[v.name]) for v in program.state])
        u = np.array([vector.inputs[v.name] for v in program.inputs])
        found = functions[vector.taken](x=x, u=u, p=parameters)
        return Stepped(
            _parts(np.array(found["x_next"]).ravel(), program.state),
            _parts(np.array(found["y"]).ravel(), program.outputs),
        )

    return step


def _parts(column: Array, variables: Any) -> Values:
    """Take a column apart into variables."""
    found: Values = {}
    start = 0
    for variable in variables:
        stop = start + (variable.length or 1)
        found[variable.name] = column[start:stop] if variable.length else column[start]
        start = stop
    return found


def native_step(kernel: Any, program: Any) -> Step:
    """Return the step of a compiled kernel."""
    from tmm_gen.emit.c.structs import COUNTER

    kernel.prepare()

    def step(vector: Vector) -> Stepped:
        counted = {COUNTER: vector.taken} if program.startup else {}
        kernel.state = {**vector.state, **counted}
        outputs = {name: np.asarray(value) for name, value in kernel.output().items()}
        kernel.step(vector.inputs)
        after = kernel.state
        return Stepped({v.name: np.asarray(after[v.name]) for v in program.state}, outputs)

    return step
