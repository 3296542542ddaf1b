"""A prediction within the sweep that reads it: one loop less, and the same bits."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tmm_gen.emit.c.interleave import interleave
from tmm_gen.program.evaluate import execute, key
from tmm_gen.program.statements import Assign, Loop, Order, Routine, Section
from tmm_gen.program.variables import Role, Variable, local

N = 6
NODE = Variable("node", Role.WORK, N + 1)
ANGLE = Variable("angle", Role.STATE, N)
SUMMED = Variable("summed", Role.WORK, N)
CARRIED, PART = local("carried"), local("part")

AHEAD = Loop(Order.OUTWARD, 0, N, (Assign(NODE.at(1), ANGLE.at() * 3),))
SWEEP = Loop(
    Order.INWARD,
    0,
    N,
    (
        Assign(PART, NODE.at(1) - NODE.at()),
        Assign(CARRIED, CARRIED * 2 + PART),
        Assign(SUMMED.at(), CARRIED),
    ),
)


BASE, BEFORE = Assign(NODE.entry(0), ANGLE.entry(2)), Assign(CARRIED, ANGLE.entry(0))


def routine(*statements: Any) -> Routine:
    return Routine("step", "", (Section("all", statements),))


def plain(second: Loop = SWEEP, first: Loop = AHEAD, between: Any = BEFORE) -> Routine:
    return routine(BASE, first, between, second)


def result(done: Routine) -> list[float]:
    values = {key(ANGLE): list(np.random.default_rng(1).normal(size=N))}
    values |= {key(v): [float("nan")] * (v.length or 1) for v in (NODE, SUMMED)}
    execute(done, values)
    return [*values[key(SUMMED)], *values[key(NODE)], values[key(CARRIED.variable)]]


def test_one_loop_with_the_same_bits() -> None:
    made = interleave(plain())
    assert sum(isinstance(s, Loop) for s in made.statements()) == 1
    assert result(made) == result(plain())


@pytest.mark.parametrize(
    "left",
    [
        plain(second=Loop(Order.OUTWARD, 0, N, SWEEP.body)),
        plain(second=Loop(Order.INWARD, 1, N, SWEEP.body)),
        plain(second=Loop(Order.INWARD, 0, N, (Assign(ANGLE.at(), NODE.at() + NODE.at(1)),))),
        plain(second=Loop(Order.INWARD, 0, N, (Assign(SUMMED.at(), NODE.at()),))),
        plain(first=Loop(Order.OUTWARD, 0, N, (Assign(NODE.at(1), NODE.at() + ANGLE.at()),))),
        plain(between=Assign(CARRIED, NODE.entry(3))),
        plain(between=Assign(ANGLE.entry(3), ANGLE.entry(0))),
    ],
)
def test_what_does_not_fit_is_left(left: Routine) -> None:
    assert interleave(left) == left
