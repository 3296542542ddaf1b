"""What is always zero is not computed, and what is not always zero is."""

from __future__ import annotations

import sympy as sp

from tmm_gen.program.passes.prune import prune
from tmm_gen.program.passes.zeros import without_zeros
from tmm_gen.program.statements import Assign, Loop, Order, Routine, Section
from tmm_gen.program.variables import Ref, Role, Variable, local

ANGLE = Variable("angle", Role.STATE, 5)
KEPT = Variable("kept", Role.WORK, 5)
UP, ALONG = local("up"), local("along")


def routine(*statements: Assign | Loop) -> Routine:
    """Return statements as a step."""
    return Routine("step", "", (Section("all", statements),))


def handed_on(start: int, entering: sp.Expr) -> Loop:
    """Return a loop that hands on two values, of which one gets nothing new."""
    body = (
        Assign(UP, 2 * UP),
        Assign(ALONG, ALONG + UP + entering),
        Assign(KEPT.at(), UP * ALONG),
        Assign(ANGLE.at(), ANGLE.at() + ALONG + KEPT.at()),
    )
    return Loop(Order.OUTWARD, start, 5, body)


def left(*statements: Assign | Loop) -> list[tuple[Ref, sp.Expr]]:
    """Return the assignments that stay."""
    found = prune(without_zeros(routine(*statements)), frozenset({ANGLE}))
    return [(each.target, each.value) for each in found.assignments()]


def test_what_starts_as_zero_and_gets_nothing_new_is_zero() -> None:
    zero = [Assign(UP, sp.Integer(0)), Assign(ALONG, sp.Integer(0))]
    assert left(*zero, handed_on(0, ANGLE.at())) == [
        (ALONG, sp.Integer(0)),
        (ALONG, ALONG + ANGLE.at()),
        (ANGLE.at(), ANGLE.at() + ALONG),
    ]


def test_what_starts_otherwise_is_not() -> None:
    """Nor is an array that one of two loops sets to something."""
    whole = [Assign(UP, ANGLE.entry(0)), Assign(ALONG, sp.Integer(0)), handed_on(0, ANGLE.at())]
    assert left(*whole) == [
        (each.target, each.value) for each in prune(routine(*whole), frozenset({ANGLE})).assignments()
    ]
    zero = [Assign(UP, sp.Integer(0)), Assign(ALONG, sp.Integer(0)), handed_on(0, sp.Integer(0))]
    set_before = Loop(Order.OUTWARD, 0, 5, (Assign(KEPT.at(), ANGLE.at()),))
    read_behind = Loop(Order.OUTWARD, 0, 5, (Assign(ANGLE.at(), KEPT.at()),))
    assert left(set_before, read_behind, *zero) == [
        (KEPT.at(), ANGLE.at()),
        (ANGLE.at(), KEPT.at()),
        (KEPT.at(), sp.Integer(0)),
        (ANGLE.at(), ANGLE.at() + KEPT.at()),
    ]
