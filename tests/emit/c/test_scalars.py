"""Declarations of scratch: where it is first set, and no wider than its use."""

from __future__ import annotations

from tmm_gen.emit.c.body import sentence
from tmm_gen.emit.c.scalars import place_scalars
from tmm_gen.program.statements import Assign, Loop, Order, Routine, Section
from tmm_gen.program.variables import Role, Variable

KEPT = Variable("kept", Role.STATE, 3)
X = Variable("x", Role.LOCAL).ref


def routine(*statements: Assign | Loop) -> Routine:
    return Routine("step", "", (Section("all", statements),))


def loop(*body: Assign) -> Loop:
    return Loop(Order.OUTWARD, 0, 3, body)


def test_private_to_a_station() -> None:
    inside = loop(Assign(X, KEPT.at() * 2), Assign(KEPT.at(), X))
    assert place_scalars(routine(inside, inside)).constant == {0: True, 2: True}
    twice = loop(Assign(X, KEPT.at()), Assign(X, X * 2), Assign(KEPT.at(), X))
    assert place_scalars(routine(twice)).constant == {0: False}


def test_carried_along() -> None:
    carried = loop(Assign(X, X + KEPT.at()))
    found = place_scalars(routine(Assign(X, KEPT.entry(0)), carried, Assign(KEPT.entry(0), X)))
    assert found.constant == {0: False}
    assert found.at_top == ()


def test_constant_before_a_loop() -> None:
    found = place_scalars(routine(Assign(X, KEPT.entry(0)), loop(Assign(KEPT.at(), X))))
    assert found.constant == {0: True}


def test_first_set_in_a_loop_and_read_behind_it() -> None:
    found = place_scalars(routine(loop(Assign(X, KEPT.at())), Assign(KEPT.entry(0), X)))
    assert found.at_top == (X.variable,)
    assert found.constant == {}


def test_titles_become_sentences() -> None:
    assert sentence("the base") == "The base."
    assert sentence("sweep; motion") == "Sweep; motion."
    title = "Stage 1 of 2: sweep; Stage 1 of 2: motion; Stage 2 of 2: sweep"
    assert sentence(title) == "Stage 1 of 2: sweep; motion. Stage 2 of 2: sweep."
