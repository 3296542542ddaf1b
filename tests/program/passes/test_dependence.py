"""What may change places, and what reads memory nobody wrote."""

from __future__ import annotations

from tmm_gen.program.passes.dependence import Together, Touched, reversible
from tmm_gen.program.passes.lifetimes import read_before_written
from tmm_gen.program.statements import Assign, Loop, Order, Routine, Section
from tmm_gen.program.variables import Role, Variable

N = 3
A = Variable("A", Role.WORK, N + 2)
KEPT = Variable("kept", Role.STATE, N + 2)
X = Variable("x", Role.LOCAL).ref
C = Variable("c", Role.COEFFICIENT)


def loop(*body: Assign) -> Loop:
    return Loop(Order.OUTWARD, 1, N + 1, body)


def independent(one: Assign | Loop, other: Assign | Loop) -> bool:
    return Together(Touched.of(one)).independent(Touched.of(other))


def routine(*statements: Assign | Loop) -> Routine:
    return Routine("prepare", "", (Section("all", statements),))


def test_elements_beside_a_loop_do_not_depend_on_it() -> None:
    inside = loop(Assign(A.at(), KEPT.at()))
    assert independent(inside, Assign(A.entry(0), KEPT.entry(1)))
    assert not independent(inside, Assign(A.entry(1), KEPT.entry(1)))
    assert not independent(inside, Assign(KEPT.entry(N), X))


def test_reading_together_is_no_dependence() -> None:
    assert independent(loop(Assign(A.at(), KEPT.at())), Assign(X, KEPT.entry(1)))


def test_reversible_loops() -> None:
    assert reversible(loop(Assign(X, KEPT.at()), Assign(A.at(), X)))
    assert not reversible(
        loop(Assign(A.at(), X), Assign(X, KEPT.at()))
    )  # the scalar comes from the last station
    assert not reversible(loop(Assign(A.at(), A.at(-1))))
    assert not reversible(
        loop(Assign(A.at(), KEPT.at()), Assign(A.at(1), X))
    )  # two stations write one element


def test_reading_before_writing_is_found() -> None:
    late = routine(Assign(X, C.ref), Assign(C.ref, KEPT.entry(0)))
    assert read_before_written(late) == C
    assert read_before_written(routine(Assign(C.ref, KEPT.entry(0)), Assign(X, C.ref))) is None
    assert read_before_written(routine(loop(Assign(KEPT.at(), A.at())))) == A
    assert read_before_written(routine(loop(Assign(X, X + KEPT.at())))) == X.variable
