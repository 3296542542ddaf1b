"""Hoisting moves early-bound factors and changes no value."""

from __future__ import annotations

import sympy as sp

from tmm_gen.program.count import count_expression
from tmm_gen.program.passes.hoist import Hoister
from tmm_gen.program.passes.prune import prune
from tmm_gen.program.statements import Assign, Loop, Order, Routine, Section
from tmm_gen.program.variables import Role, Variable

STEP = Variable("step", Role.STEP)
ANGLE, RATE = Variable("angle", Role.STATE, 4), Variable("rate", Role.STATE, 4)
GUESS = Variable("guess", Role.WORK, 4)


def routine(value: sp.Expr) -> Routine:
    loop = Loop(Order.OUTWARD, 0, 4, (Assign(GUESS.at(), value),))
    return Routine("step", "", (Section("", (loop,)),))


def test_affine_expressions_keep_one_factor_each() -> None:
    h = STEP.ref
    value = ANGLE.at() + h * RATE.at() / 2 + h**2 * (RATE.at() - ANGLE.at()) / 4
    hoister = Hoister()
    (hoisted,) = hoister.hoist(routine(value)).values()
    assert all(v.role is Role.COEFFICIENT for v in hoister.coefficients)
    back = {
        v.ref: assign.value
        for v, assign in zip(hoister.coefficients, hoister.section().statements, strict=True)
    }
    assert sp.expand(hoisted.subs(back) - value) == 0
    assert not hoisted.has(h)
    assert count_expression(hoisted).total == 3


def test_equal_factors_are_shared() -> None:
    h = STEP.ref
    hoister = Hoister()
    hoister.hoist(routine(h**2 / 4 * ANGLE.at()))
    hoister.hoist(routine(RATE.at() - h**2 / 4 * ANGLE.at()))
    assert len(hoister.coefficients) == 1


def test_nonlinear_expressions_keep_their_shape() -> None:
    h = STEP.ref
    value = (h**2 / 4 * 3) * sp.sin(ANGLE.at()) * (RATE.at() + ANGLE.at())
    hoister = Hoister()
    (hoisted,) = hoister.hoist(routine(value)).values()
    assert count_expression(hoisted).total == 4
    assert len(hoister.coefficients) == 1


def test_prune_keeps_what_is_wanted_and_what_feeds_it() -> None:
    idle = Variable("idle", Role.WORK, 4)
    body = (
        Assign(GUESS.at(), ANGLE.at() + RATE.at()),
        Assign(idle.at(), idle.at() + RATE.at()),
        Assign(ANGLE.at(), GUESS.at()),
    )
    whole = Routine("step", "", (Section("", (Loop(Order.OUTWARD, 0, 4, body),)),))
    kept = prune(whole, frozenset({ANGLE}))
    assert {a.target.variable.name for a in kept.assignments()} == {"guess", "angle"}


def test_stations_that_are_alike_are_rewritten_once() -> None:
    """With the same factor and the same value, whatever is set; values of another hoister are its own."""
    value = STEP.ref * RATE.entry(0) / 2 + ANGLE.entry(0)
    asked = []

    class Counting(Hoister):
        def _rewrite(self, value: sp.Expr) -> sp.Expr:
            asked.append(value)
            return super()._rewrite(value)

    lines = tuple(Assign(GUESS.entry(k), value) for k in range(4))
    found = [Counting().hoist(Routine("step", "", (Section("", lines),))) for _ in range(2)]
    assert asked == [value, value]
    assert len({*found[0].values()}) == 1
    assert found[0] == found[1]
