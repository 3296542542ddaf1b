"""Jacobians of the CasADi step of planar arms: against finite differences and against SymPy's own derivatives.

The second symbolic route walks the program statement by statement, lets SymPy differentiate each right-hand side and
applies the chain rule: it shares nothing with CasADi's differentiation.
"""

from __future__ import annotations

from typing import Any

import casadi
import numpy as np
import pytest
import sympy as sp

from tmm_gen.native.python_module import casadi_module, numpy_module
from tmm_gen.program.build import build_program
from tmm_gen.program.evaluate import allocate, execute, key
from tmm_gen.program.statements import Loop, Order, Program, Routine
from tmm_gen.program.variables import Ref, Variable
from tmm_gen.scene import Scene, parse_scene


def arm(base: str, integrator: str) -> Scene:
    angle = 'acts = "angle"' if base == "prescribed" else 'acts = "torque"'
    hub = "inertia = 0.05" if base == "motor" else ""
    drive = "" if base == "clamp" else f'[[input]]\nname = "drive"\nat = "base"\n{angle}'
    return parse_scene(f"""
name = "arm"
[model]
kind = "planar"
gravity = 9.81
[integrator]
name = "{integrator}"
step = 1e-2
[base]
kind = "{base}"
{hub}
[beam]
length = 1.0
bending_stiffness = 3.0
mass_per_length = 0.5
links = 3
damping_time = 0.002
[tip]
mass = 0.1
{drive}
[[input]]
name = "push"
at = "tip"
acts = "force_y"
[[output]]
name = "tip"
at = "tip"
of = "position"
""")


def entries(variables: tuple[Variable, ...]) -> list[tuple[Variable, int | None]]:
    """Return every scalar of some variables, in the order of the state vector."""
    return [(v, k) for v in variables for k in (range(v.length) if v.length is not None else [None])]


def tangents(program: Program, routine: Routine, values: dict[str, Any]) -> np.ndarray:
    """Return d(state after) / d(state before) by the chain rule over the statements of a routine.

    Statements run on a copy of ``values`` beside their derivatives.
    """
    columns = entries(program.state)
    slopes: dict[str, Any] = {}
    for place, (variable, index) in enumerate(columns):
        unit = np.eye(len(columns))[place]
        if index is None:
            slopes[key(variable)] = unit
        else:
            slopes.setdefault(key(variable), {})[index] = unit
    zero = np.zeros(len(columns))

    def element(ref: Ref, j: int | None) -> int | None:
        if ref.variable.length is None:
            return None
        return ref.entry if ref.offset is None else (j or 0) + ref.offset

    def value_of(ref: Ref, j: int | None) -> float:
        held, index = values[key(ref.variable)], element(ref, j)
        return float(held if index is None else held[index])

    def slope_of(ref: Ref, j: int | None) -> np.ndarray:
        held, index = slopes.get(key(ref.variable)), element(ref, j)
        if held is None:
            return zero
        return held if index is None else held.get(index, zero)  # type: ignore[no-any-return]

    def run(statement: Any, j: int | None) -> None:
        if not hasattr(statement, "target"):
            return
        expression = sp.sympify(statement.value)
        refs = sorted(expression.free_symbols, key=lambda r: r.name)
        at = {ref: value_of(ref, j) for ref in refs}
        slope = sum((float(sp.diff(expression, ref).subs(at)) * slope_of(ref, j) for ref in refs), zero)
        result = float(expression.subs(at))
        target, index = statement.target, element(statement.target, j)
        if index is None:
            values[key(target.variable)], slopes[key(target.variable)] = result, slope
        else:
            values.setdefault(key(target.variable), [0.0] * (target.variable.length or 1))[index] = result
            slopes.setdefault(key(target.variable), {})[index] = slope

    for statement in routine.statements():
        if isinstance(statement, Loop):
            stations = range(statement.start, statement.stop)
            for j in reversed(stations) if statement.order is Order.INWARD else stations:
                for inner in statement.body:
                    run(inner, j)
        else:
            run(statement, None)
    rows = [slopes[key(v)] if k is None else slopes[key(v)][k] for v, k in columns]
    return np.array(rows)


@pytest.mark.parametrize(
    ("base", "integrator"), [("clamp", "newmark"), ("motor", "newmark"), ("prescribed", "generalized_alpha")]
)
def test_jacobian_of_the_step(base: str, integrator: str) -> None:
    scene = arm(base, integrator)
    program, model = build_program(scene), casadi_module(scene)
    rng = np.random.default_rng(11)
    columns = entries(program.state)
    x = 0.2 * rng.normal(size=len(columns))
    u = 0.3 * rng.normal(size=len(program.inputs))
    p = np.array(model.default_parameters()).ravel()
    function = model.step_function()
    jacobian = function.factory("jacobian", ["x", "u", "p"], ["jac:x_next:x"])
    by_casadi = np.array(jacobian(x=x, u=u, p=p)["jac_x_next_x"])

    values = allocate((program.step, *program.parameters), float)
    execute(program.prepare, values)
    for (variable, index), number in zip(columns, x, strict=True):
        if index is None:
            values[key(variable)] = number
        else:
            values.setdefault(key(variable), [0.0] * (variable.length or 1))[index] = number
    for variable, number in zip(program.inputs, u, strict=True):
        values[key(variable)] = number if variable.length is None else [number] * variable.length  # held
    by_sympy = tangents(program, program.main, values)
    scale = np.abs(by_casadi).max()
    assert np.abs(by_casadi - by_sympy).max() <= 1e-11 * scale

    kernel = numpy_module(scene)
    prepared = kernel.prepare()

    def step(vector: np.ndarray) -> np.ndarray:
        fields: dict[str, Any] = {}
        for (variable, index), number in zip(columns, vector, strict=True):
            if index is None:
                fields[variable.name] = number
            else:
                fields.setdefault(variable.name, np.zeros(variable.length or 1))[index] = number
        inputs = kernel.Input(**{v.name: number for v, number in zip(program.inputs, u, strict=True)})
        new = kernel.step(prepared, kernel.State(**fields), inputs)
        return np.hstack([np.atleast_1d(getattr(new, v.name)) for v in program.state])

    eps = 1e-6
    by_difference = np.column_stack(
        [(step(x + eps * e) - step(x - eps * e)) / (2 * eps) for e in np.eye(len(x))]
    )
    assert np.abs(by_casadi - by_difference).max() <= 1e-7 * scale
    assert isinstance(function, casadi.Function)
