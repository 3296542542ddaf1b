"""Which loops become whole-array statements, and that doing so changes no result."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import sympy as sp

from tmm_gen.emit.numpy.statements import RoutineText
from tmm_gen.emit.python.storage import rebound, vectorised
from tmm_gen.program.evaluate import execute
from tmm_gen.program.statements import Assign, Loop, Order, Routine, Section, Statement
from tmm_gen.program.variables import Role, Variable, local

N = 4
A, B, C = (Variable(name, Role.STATE, N) for name in "abc")
W = Variable("w", Role.WORK, N + 1)
X, Y = local("x"), local("y")


def routine(*statements: Statement) -> Routine:
    return Routine("r", "", (Section("all", statements),))


def loop(*body: Assign, order: Order = Order.OUTWARD, start: int = 0, stop: int = N) -> Loop:
    return Loop(order, start, stop, body)


ROUTINES = {
    "parallel": routine(loop(Assign(A.at(), B.at() + C.at()))),
    "scratch of a station": routine(loop(Assign(X, B.at() * 2), Assign(A.at(), X + C.at()))),
    "scratch read behind the loop": routine(
        loop(Assign(X, B.at() * 2)), Assign(Y, X), loop(Assign(A.at(), Y * C.at()))
    ),
    "scratch set anew behind the loop": routine(
        loop(Assign(X, B.at()), Assign(A.at(), X * 2)),
        Assign(X, C.entry(1)),
        loop(Assign(B.at(), X + A.at())),
    ),
    "recursive": routine(Assign(X, sp.Integer(0)), loop(Assign(X, X + B.at()), Assign(A.at(), X))),
    "inward": routine(
        Assign(X, sp.Integer(1)),
        loop(Assign(X, X * B.at()), Assign(A.at(), X), order=Order.INWARD),
        Assign(Y, X),
    ),
    "neighbours": routine(
        Assign(W.entry(0), sp.Integer(3)),
        loop(Assign(W.at(1), A.at())),
        loop(Assign(B.at(), W.at(1) - W.at())),
    ),
    "copies kept while the source changes": routine(
        loop(Assign(W.at(1), A.at())),
        loop(Assign(B.at(), W.at(1))),
        loop(Assign(W.at(1), C.at())),
        loop(Assign(C.at(), W.at(1) + B.at())),
    ),
    "scratch copied while the source changes": routine(
        loop(Assign(W.at(), A.at())),
        loop(Assign(X, W.at()), Assign(W.at(), B.at()), Assign(C.at(), X + W.at())),
    ),
    "scalar copied while the source changes": routine(
        loop(Assign(W.at(), A.at())),
        Assign(X, W.entry(2)),
        loop(Assign(W.at(), B.at())),
        loop(Assign(C.at(), X * W.at())),
    ),
    "scratch copied in a recursion": routine(
        Assign(Y, sp.Integer(0)),
        loop(Assign(X, A.at()), Assign(A.at(), Y), Assign(Y, X)),
    ),
    "part of the stations": routine(loop(Assign(A.at(), B.at()), start=1, stop=3)),
    "constant": routine(loop(Assign(A.at(), sp.Integer(2))), Assign(A.entry(1), B.entry(0))),
    "swap": routine(loop(Assign(X, A.at()), Assign(A.at(), B.at()), Assign(B.at(), X))),
}


class Same:
    def __getitem__(self, variable: Variable) -> str:
        return variable.name


def run_printed(which: Routine, values: dict[str, Any]) -> dict[str, Any]:
    body = RoutineText(which, Same(), N)  # type: ignore[arg-type]
    lines = ["def f(a, b, c):", f"    w = np.zeros({(N + 1, *values['a'].shape[1:])})", *body.lines()]
    lines.append("    return {'a': a, 'b': b, 'c': c}")
    names: dict[str, Any] = {"np": np, "Any": Any, "STATIONS": N}
    exec("\n".join(lines), names)
    result: dict[str, Any] = names["f"](**{name: value.copy() for name, value in values.items()})
    return result


@pytest.mark.parametrize("which", ROUTINES.values(), ids=ROUTINES)
@pytest.mark.parametrize("batch", [(), (3,)], ids=["one arm", "batch"])
def test_whole_arrays_give_what_the_interpreter_gives(which: Routine, batch: tuple[int, ...]) -> None:
    rng = np.random.default_rng(1)
    values = {name: rng.normal(size=(N, *batch)) for name in "abc"}
    found = run_printed(which, values)
    for arm in np.ndindex(*batch):
        held = {name: [float(x) for x in value[(slice(None), *arm)]] for name, value in values.items()}
        execute(which, held)
        for name in "abc":
            whole = np.broadcast_to(found[name], (N, *batch))
            assert whole[(slice(None), *arm)].tolist() == held[name], name


@pytest.mark.parametrize(
    ("name", "whole"),
    [
        ("parallel", {0}),
        ("scratch of a station", {0}),
        ("scratch read behind the loop", {2}),
        ("scratch set anew behind the loop", {0, 2}),
        ("recursive", set()),
        ("neighbours", {1, 2}),
        ("swap", {0}),
    ],
)
def test_loops_are_done_at_once_where_stations_are_independent(name: str, whole: set[int]) -> None:
    assert vectorised(ROUTINES[name]) == whole


@pytest.mark.parametrize(
    ("name", "arrays"),
    [
        ("parallel", {A}),
        ("recursive", set()),
        ("neighbours", {B}),
        ("copies kept while the source changes", {B, C}),
        ("part of the stations", set()),
        ("constant", set()),
    ],
)
def test_arrays_assigned_as_a_whole_need_no_room_before(name: str, arrays: set[Variable]) -> None:
    assert rebound(ROUTINES[name], vectorised(ROUTINES[name])) == arrays


def test_titles_become_comments() -> None:
    lines = RoutineText(ROUTINES["parallel"], Same(), N).lines()  # type: ignore[arg-type]
    assert lines == ["    # all", "    a = b + c"]
