"""The number that tells of every NaN."""

from __future__ import annotations

from typing import Any

import pytest

from tmm_gen.emit.c.guard import telling_value
from tmm_gen.program.statements import Assign, Loop, Order, Routine, Section
from tmm_gen.program.variables import Role, Variable

N = 4
ANGLE = Variable("angle", Role.STATE, N)
OLDER = Variable("angle_1_ago", Role.STATE, N)
CARRIED = Variable("carried", Role.LOCAL).ref


def routine(*statements: Assign | Loop) -> Routine:
    return Routine("step", "", (Section("all", statements),))


def sweep(order: Order) -> Routine:
    return routine(
        Assign(CARRIED, ANGLE.entry(0) * 2),
        Loop(order, 0, N, (Assign(CARRIED, CARRIED + ANGLE.at()), Assign(ANGLE.at(), CARRIED * 3))),
    )


def test_the_end_of_a_sweep_tells() -> None:
    assert telling_value(sweep(Order.OUTWARD), (ANGLE,)) == ANGLE.entry(N - 1)
    assert telling_value(sweep(Order.INWARD), (ANGLE,)) == ANGLE.entry(0)


def test_stations_that_do_not_meet_have_no_such_number() -> None:
    alone = routine(Loop(Order.OUTWARD, 0, N, (Assign(ANGLE.at(), ANGLE.at() * 2),)))
    assert telling_value(alone, (ANGLE,)) is None


def test_what_is_only_copied_is_told_of_later() -> None:
    aged = routine(
        Loop(Order.OUTWARD, 0, N, (Assign(OLDER.at(), ANGLE.at()),)), *sweep(Order.OUTWARD).statements()
    )
    assert telling_value(aged, (OLDER, ANGLE)) == ANGLE.entry(N - 1)


@pytest.mark.parametrize(
    ("kind", "found"),
    [
        ({}, True),
        ({"base": "motor"}, True),
        ({"sweep": "product"}, True),
        ({"integrator": "sdirk4", "base": "prescribed"}, True),
        ({"integrator": "newmark", "parameters": "beta = 0.0", "damped": False}, False),
    ],
)
def test_chains(kind: dict[str, Any], found: bool, chain: Any) -> None:
    """Implicit sweeps bring all stations together; explicit ones without dampers only neighbours."""
    program = chain(**kind).program
    assert (telling_value(program.main, program.state) is not None) is found
