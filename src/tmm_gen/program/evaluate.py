"""An interpreter of programs: the oracle that shares no printer with any backend.

It walks the statements one by one in whatever number type it is given (Python floats, mpmath, intervals, counting
numbers), so that generated code can be compared with the program it came from.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import sympy as sp

from tmm_gen.program.statements import Assign, Loop, Order, Repeat, Require, Routine, Until
from tmm_gen.program.variables import SCRATCH, Ref, Role, Variable

Values = dict[str, Any]
"""Scalars and lists by :func:`key`."""


def key(variable: Variable) -> str:
    """Return under which name values hold a variable: signals and scratch may be called like anything else."""
    if variable.role in (Role.INPUT, Role.OUTPUT):
        return f"{variable.role.value} {variable.name}"
    return f"scratch {variable.name}" if variable.role in SCRATCH else variable.name


class VanishingPivotError(ArithmeticError):
    """A pivot that must be positive is not."""


def allocate(variables: tuple[Variable, ...], number: Callable[[float], Any]) -> Values:
    """Return zeros (or defaults, where there are any) for variables."""
    values: Values = {}
    for variable in variables:
        default = variable.default if variable.default is not None else 0.0
        if variable.length is None:
            values[key(variable)] = number(default)  # type: ignore[arg-type]
        elif isinstance(default, tuple):
            values[key(variable)] = [number(x) for x in default]
        else:
            values[key(variable)] = [number(default)] * variable.length
    return values


def execute(
    routine: Routine, values: Values, number: Callable[[float], Any] = float, modules: Any = "math"
) -> None:
    """Run a routine in place.

    Parameters
    ----------
    routine : Routine
        What to run.
    values : dict
        Every variable by :func:`key`; arrays are lists. Written in place, scratch is added.
    number : callable
        Makes a number of the wanted type from a float, for scratch arrays.
    modules : str or tuple
        As for :func:`sympy.lambdify`: where ``sin`` and ``cos`` come from. A tuple must outlive the process's
        last run with it (compiled expressions are kept).

    Raises
    ------
    VanishingPivotError
        If a required pivot is not positive and finite.
    """
    for variable in routine.written():
        if key(variable) not in values or _misfits(values[key(variable)], variable):
            values[key(variable)] = (
                number(0.0) if variable.length is None else [number(0.0)] * variable.length
            )
    compiled = _compiled(routine, modules)

    def compute(statement: Assign | Require | Until, j: int | None) -> Any:
        refs, function = compiled[id(statement)]
        return function(*[_read(values, name, ref, j) for name, ref in refs])

    def run(statement: Assign | Require, j: int | None) -> None:
        result = compute(statement, j)
        if isinstance(statement, Require):
            if not result > 0:
                raise VanishingPivotError(f"{statement.value} = {result} at station {j}")
        else:
            _write(values, statement.target, j, result)

    statements = tuple(routine.statements())
    place = begin = left = 0
    while place < len(statements):
        statement = statements[place]
        place += 1
        if isinstance(statement, Repeat):
            begin, left = place, statement.most
        elif isinstance(statement, Until):
            left -= 1
            if left > 0 and compute(statement, None) > 0:
                place = begin
        elif isinstance(statement, Loop):
            for j in reversed(statement.visits) if statement.order is Order.INWARD else statement.visits:
                for inner in statement.body:
                    run(inner, j)
        else:
            run(statement, None)


_Function = tuple[list[tuple[str, Ref]], Callable[..., Any]]
_FUNCTIONS: dict[tuple[sp.Expr, int | str], _Function] = {}
_ROUTINES: dict[tuple[int, int | str], tuple[Routine, dict[int, _Function]]] = {}
_SHAPES: dict[tuple[sp.Expr, int, int | str], Callable[..., Any]] = {}


def _compiled(routine: Routine, modules: Any) -> dict[int, _Function]:
    """Compile a routine's statements once for all runs; by their identity, since equal ones take long to compare."""
    kept = (id(routine), modules if isinstance(modules, str) else id(modules))
    if kept not in _ROUTINES or _ROUTINES[kept][0] is not routine:
        inside = (i for s in routine.statements() for i in (s.body if isinstance(s, Loop) else (s,)))
        _ROUTINES[kept] = routine, {id(s): _function(s.value, modules) for s in inside}
    return _ROUTINES[kept][1]


def _function(value: sp.Expr, modules: Any) -> _Function:
    """Compile an expression once for all runs; returns its references with their keys, and a function of them."""
    expression = (value, modules if isinstance(modules, str) else id(modules))
    if expression not in _FUNCTIONS:
        refs = sorted(value.free_symbols, key=lambda s: s.name)
        # no Dummies: SymPy orders sums by names, and a Dummy's tells how many there were before in the process
        names = [sp.Symbol(f"x{k:03d}") for k in reversed(range(len(refs)))]
        plain = value.xreplace(dict(zip(refs, names, strict=True)))
        handed = modules if isinstance(modules, str) else list(modules)
        # statements of unlike stations often differ in names alone
        shape = (plain, len(names), expression[1])
        if shape not in _SHAPES:
            _SHAPES[shape] = sp.lambdify(names, plain, modules=handed, docstring_limit=0)
        _FUNCTIONS[expression] = [(key(ref.variable), ref) for ref in refs], _SHAPES[shape]
    return _FUNCTIONS[expression]


def _misfits(held: Any, variable: Variable) -> bool:
    """Whether what is held under a variable's name is scratch of another routine, and of another shape."""
    return variable.role is Role.WORK and not isinstance(held, list)


def _read(values: Mapping[str, Any], name: str, ref: Ref, j: int | None) -> Any:
    held = values[name]
    return held if ref.variable.length is None else held[_index(ref, j)]


def _write(values: Values, ref: Ref, j: int | None, result: Any) -> None:
    if ref.variable.length is None:
        values[key(ref.variable)] = result
    else:
        values[key(ref.variable)][_index(ref, j)] = result


def _index(ref: Ref, j: int | None) -> int:
    index = ref.entry if ref.offset is None else (j or 0) + ref.offset
    if index is None or index < 0:
        raise IndexError(f"{ref} outside its array")
    return index
