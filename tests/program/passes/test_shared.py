"""What two walks write alike stays with the first of them."""

from __future__ import annotations

from tmm_gen.program.passes.shared import shared_arrays, taken_over
from tmm_gen.program.statements import Assign, Loop, Order, Section
from tmm_gen.program.variables import Role, Variable

ANGLE = Variable("angle", Role.STATE, 3)
LEVER, NODE, SWING = (Variable(name, Role.WORK, 3) for name in ("lever", "node", "swing"))
REACH = Variable("reach", Role.LOCAL)


def walk(*, reach: int, more: int) -> Section:
    """Return a walk that sets levers, nodes that add them up, and swings."""
    levers = Loop(Order.OUTWARD, 0, 3, (Assign(LEVER.at(), 2 * ANGLE.at()),))
    nodes = (Assign(REACH.ref, REACH.ref + LEVER.at()), Assign(NODE.at(), REACH.ref))
    swings = Loop(Order.OUTWARD, 0, 3, (Assign(SWING.at(), more * LEVER.at() + NODE.at()),))
    return Section(
        "walk", (levers, Assign(REACH.ref, ANGLE.entry(reach)), Loop(Order.OUTWARD, 0, 3, nodes), swings)
    )


def test_arrays_of_equal_lines_are_shared() -> None:
    assert shared_arrays([walk(reach=0, more=1)], [walk(reach=0, more=2)]) == {LEVER, NODE}


def test_an_array_that_follows_from_something_else_is_not() -> None:
    """Nodes are written by the same line in both, but begin elsewhere; so do swings, which add them."""
    assert shared_arrays([walk(reach=0, more=1)], [walk(reach=1, more=1)]) == {LEVER}


def test_the_later_walk_reads_what_the_earlier_one_has_written() -> None:
    stage = Variable("lever_stage2", Role.WORK, 3)
    (found,) = taken_over(
        [walk(reach=1, more=2)],
        frozenset({LEVER}),
        lambda ref: stage.at(ref.offset or 0) if ref.variable == LEVER else ref,
    )
    assert len(found.statements) == 3  # the loop of levers is empty now
    swings = found.statements[-1]
    assert isinstance(swings, Loop)
    assert swings.body == (Assign(SWING.at(), 2 * stage.at() + NODE.at()),)
