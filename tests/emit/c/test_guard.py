"""What is added up of a new state: finite only if all of it is."""

from __future__ import annotations

from tmm_gen.emit.c.guard import sums_of
from tmm_gen.program.statements import Assign, Loop, Order, Routine, Section
from tmm_gen.program.variables import Role, Variable

N = 4
ANGLE = Variable("angle", Role.STATE, N)
RATE = Variable("rate", Role.STATE, N)
HUB = Variable("hub_angle", Role.STATE)
CARRIED = Variable("carried", Role.LOCAL).ref


def routine(*statements: Assign | Loop) -> Routine:
    return Routine("step", "", (Section("all", statements),))


def test_all_that_is_written_counts() -> None:
    loop = Loop(Order.OUTWARD, 0, N, (Assign(ANGLE.at(), RATE.at() * 2), Assign(RATE.at(), RATE.at() * 3)))
    hub = Assign(HUB.ref, HUB.ref * 2)
    found = sums_of(routine(hub, loop))
    assert found.inside == {loop: loop.body}
    assert found.behind == (hub,)
    assert found.ends == ()


def test_of_what_is_written_over_the_last_counts() -> None:
    first = Loop(Order.OUTWARD, 0, N, (Assign(ANGLE.at(), RATE.at() * 2),))
    last = Loop(Order.INWARD, 0, N, (Assign(ANGLE.at(), RATE.at() * 3),))
    assert sums_of(routine(first, last)).inside == {last: last.body}


def test_half_of_an_array_does_not_write_over_all_of_it() -> None:
    whole = Loop(Order.OUTWARD, 0, N, (Assign(ANGLE.at(), RATE.at() * 2),))
    half = Loop(Order.OUTWARD, 0, 2, (Assign(ANGLE.at(), RATE.at() * 3),))
    assert set(sums_of(routine(whole, half)).inside) == {whole, half}


def test_a_number_carried_by_sums_and_products_tells_of_those_before() -> None:
    for order, end in ((Order.OUTWARD, N - 1), (Order.INWARD, 0)):
        loop = Loop(order, 0, N, (Assign(CARRIED, RATE.at() * CARRIED + 1), Assign(ANGLE.at(), CARRIED)))
        assert sums_of(routine(Assign(CARRIED, HUB.ref), loop)).ends == ((ANGLE, end),)


def test_a_number_carried_below_a_line_does_not() -> None:
    for value in (RATE.at() / CARRIED, RATE.at() + 1 / CARRIED):
        loop = Loop(Order.OUTWARD, 0, N, (Assign(CARRIED, value), Assign(ANGLE.at(), CARRIED)))
        found = sums_of(routine(Assign(CARRIED, HUB.ref), loop))
        assert found.ends == ()
        assert found.inside == {loop: (loop.body[1],)}
