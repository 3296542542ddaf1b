"""Fusion: fewer loops, the same values."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tmm_gen.program.build import build_program
from tmm_gen.program.count import count_routine
from tmm_gen.program.passes.fuse import fuse
from tmm_gen.program.statements import Assign, Loop, Order, Routine, Section
from tmm_gen.program.variables import Role, Variable
from tmm_gen.resources import scenes_dir
from tmm_gen.scene import load_scene

N = 3
A, B = (Variable(name, Role.WORK, N + 2) for name in "AB")
KEPT = Variable("kept", Role.STATE, N + 2)
CARRIED = Variable("carried", Role.LOCAL).ref


def loop(order: Order, *body: Assign) -> Loop:
    return Loop(order, 1, N + 1, body)


def routine(*statements: Assign | Loop) -> Routine:
    return Routine("step", "", tuple(Section(f"part {k}", (s,)) for k, s in enumerate(statements)))


def loops(given_routine: Routine) -> list[Loop]:
    return [s for s in given_routine.statements() if isinstance(s, Loop)]


@settings(max_examples=200, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_values_and_operations_stay(data: st.DataObject, random_routines: Any, run: Any) -> None:
    before = data.draw(random_routines)
    after = fuse(before)
    assert run(after) == run(before)
    assert count_routine(after) == count_routine(before)
    assert len(loops(after)) <= len(loops(before))


def test_random_routines_do_fuse(random_routines: Any) -> None:
    """The property above is not empty: some of its routines lose loops, some keep theirs."""
    fused, kept = [], []

    @settings(max_examples=100)
    @given(random_routines)
    def sort(before: Routine) -> None:
        if len(loops(before)) > 1:
            (fused if len(loops(fuse(before))) < len(loops(before)) else kept).append(before)

    sort()
    assert len(fused) > 5
    assert len(kept) > 5


def test_independent_stations_take_the_order_of_a_recursion() -> None:
    parallel = loop(Order.OUTWARD, Assign(A.at(), KEPT.at() + 1))
    recursion = loop(Order.INWARD, Assign(CARRIED, CARRIED + A.at()), Assign(KEPT.at(), CARRIED))
    (only,) = loops(fuse(routine(Assign(CARRIED, KEPT.entry(0)), parallel, recursion)))
    assert only.order is Order.INWARD
    assert only.body == (*parallel.body, *recursion.body)


@pytest.mark.parametrize(("offset", "order"), [(-1, Order.OUTWARD), (1, Order.INWARD)])
def test_a_neighbour_must_be_written_before_it_is_read(offset: int, order: Order) -> None:
    first = loop(Order.OUTWARD, Assign(A.at(), KEPT.at()))
    second = loop(Order.OUTWARD, Assign(B.at(), A.at(offset)))
    (only,) = loops(fuse(routine(first, second)))
    assert only.order is order


def test_neighbours_on_both_sides_keep_loops_apart() -> None:
    first = loop(Order.OUTWARD, Assign(A.at(), KEPT.at()))
    second = loop(Order.OUTWARD, Assign(B.at(), A.at(-1) + A.at(1)))
    assert len(loops(fuse(routine(first, second)))) == 2


def test_recursions_in_opposite_orders_stay_apart() -> None:
    inward = loop(Order.INWARD, Assign(CARRIED, CARRIED + A.at()), Assign(B.at(), CARRIED))
    outward = loop(Order.OUTWARD, Assign(CARRIED, CARRIED + B.at()), Assign(KEPT.at(), CARRIED))
    given_routine = routine(Assign(CARRIED, KEPT.entry(0)), inward, outward)
    assert loops(fuse(given_routine)) == [inward, outward]


def test_a_scalar_read_afterwards_keeps_its_loop_as_it_is() -> None:
    """The last station visited leaves its value: another order would leave another."""
    parallel = loop(Order.OUTWARD, Assign(CARRIED, KEPT.at()), Assign(A.at(), CARRIED))
    recursion = loop(Order.INWARD, Assign(KEPT.at(), KEPT.at(1) + A.at()))
    end = Assign(KEPT.entry(0), CARRIED)
    assert loops(fuse(routine(parallel, recursion, end))) == [parallel, recursion]
    assert len(loops(fuse(routine(parallel, recursion)))) == 1


def test_titles_join() -> None:
    first = loop(Order.OUTWARD, Assign(A.at(), KEPT.at()))
    second = loop(Order.OUTWARD, Assign(KEPT.at(), 2 * A.at()))
    (section,) = fuse(routine(first, second)).sections
    assert section.title == "part 0; part 1"


@pytest.mark.parametrize(
    ("integrator", "expected"), [("newmark", 3), ("sdirk2", 5), ("sdirk4", 11), ("houbolt", 3), ("zhou", 3)]
)
def test_loops_of_a_chain(integrator: str, expected: int) -> None:
    """Predict; then, for each stage, sweep inward, and sweep outward with all that follows."""
    scene = load_scene(scenes_dir() / "thesis10.toml").replace(**{"integrator.name": integrator})
    main = build_program(scene).main
    assert len(loops(fuse(main))) == expected
    assert count_routine(fuse(main)) == count_routine(main)
