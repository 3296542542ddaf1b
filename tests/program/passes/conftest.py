"""Random routines: loops in both orders, elements of neighbours, scalars carried along or not."""

from __future__ import annotations

import math
from typing import Any

import pytest
import sympy as sp
from hypothesis import strategies as st

from tmm_gen.program.statements import Assign, Loop, Order, Routine, Section
from tmm_gen.program.variables import Ref, Role, Variable

STATIONS = 4
ARRAYS = [Variable(f"work_{k}", Role.WORK, STATIONS + 2) for k in range(3)] + [
    Variable(f"kept_{k}", Role.STATE, STATIONS + 2) for k in range(2)
]
SCALARS = [Variable(f"local_{k}", Role.LOCAL) for k in range(3)] + [Variable("total", Role.STATE)]

elements = st.builds(lambda v, k: v.at(k), st.sampled_from(ARRAYS), st.sampled_from([-1, 0, 0, 0, 1]))
entries = st.builds(lambda v, k: v.entry(k), st.sampled_from(ARRAYS), st.integers(0, STATIONS + 1))
scalars = st.builds(lambda v: v.ref, st.sampled_from(SCALARS))


def assignments(places: st.SearchStrategy[Ref]) -> st.SearchStrategy[Assign]:
    """Assign to a place a copy of another, or a combination of two."""
    places = places | scalars
    combined = st.builds(lambda a, b, k: a + k * b, places, places, st.integers(-2, 2))
    return st.builds(Assign, places, places | combined)


loops = st.builds(
    lambda order, body: Loop(order, 1, STATIONS + 1, tuple(body)),
    st.sampled_from(Order),
    st.lists(assignments(elements), min_size=1, max_size=4),
)
routines = st.builds(
    lambda statements: Routine(
        "step",
        "",
        (
            Section("start", tuple(Assign(v.ref, SCALARS[-1].ref + k) for k, v in enumerate(SCALARS[:-1]))),
            *(Section(f"part {k}", (s,)) for k, s in enumerate(statements)),
        ),
    ),
    st.lists(loops | loops | assignments(entries), min_size=2, max_size=6),
)


def assign(statement: Any, values: dict[str, Any], j: int) -> None:
    """Do what the interpreter does, without compiling every expression first."""
    target, result = statement.target, number(statement.value, values, j)
    if target.variable.length is None:
        values[target.variable.name] = result
    else:
        values[target.variable.name][place(target, j)] = result


def number(e: sp.Expr, values: dict[str, Any], j: int) -> int:
    if isinstance(e, Ref):
        held = values[e.variable.name]
        return held if e.variable.length is None else held[place(e, j)]
    if e.is_Integer:
        return int(e)
    parts = [number(a, values, j) for a in e.args]
    assert e.is_Add or e.is_Mul
    return sum(parts) if e.is_Add else math.prod(parts)


def place(ref: Ref, j: int) -> int:
    return ref.entry if ref.offset is None else j + ref.offset


def results(routine: Routine) -> dict[str, Any]:
    """Run a routine on whole numbers, where sums have no rounding; return what outlives it."""
    values: dict[str, Any] = {
        v.name: [7 * i + 3 * k for i in range(STATIONS + 2)] for k, v in enumerate(ARRAYS)
    }
    values |= {v.name: 11 * k + 5 for k, v in enumerate(SCALARS)}
    for statement in routine.statements():
        if isinstance(statement, Loop):
            stations = range(statement.start, statement.stop)
            for j in reversed(stations) if statement.order is Order.INWARD else stations:
                for inner in statement.body:
                    assign(inner, values, j)
        else:
            assign(statement, values, 0)
    return {v.name: values[v.name] for v in (*ARRAYS, *SCALARS) if v.role is Role.STATE}


@pytest.fixture(scope="session")
def random_routines() -> st.SearchStrategy[Routine]:
    """Routines over work and kept arrays and scalars."""
    return routines


@pytest.fixture(scope="session")
def run() -> Any:
    """Run a routine; return what outlives it."""
    return results
