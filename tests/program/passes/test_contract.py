"""Contraction: less scratch, the same values."""

from __future__ import annotations

from typing import Any

import pytest
import sympy as sp
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tmm_gen.derive.integrators import registry
from tmm_gen.program.build import build_program, build_unchecked
from tmm_gen.program.count import count_routine
from tmm_gen.program.passes.contract import contract
from tmm_gen.program.passes.fuse import fuse
from tmm_gen.program.statements import Assign, Loop, Order, Routine, Section
from tmm_gen.program.variables import Role, Variable
from tmm_gen.resources import scenes_dir
from tmm_gen.scene import load_scene

N = 3
A = Variable("A", Role.WORK, N + 2, "torque of each joint")
KEPT = Variable("kept", Role.STATE, N + 2)
X, Y = (Variable(name, Role.LOCAL).ref for name in ("x", "y"))


def routine(*statements: Assign | Loop) -> Routine:
    return Routine("step", "", (Section("all", statements),))


def loop(*body: Assign) -> Loop:
    return Loop(Order.OUTWARD, 1, N + 1, body)


@settings(max_examples=200, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_values_stay(data: st.DataObject, random_routines: Any, run: Any) -> None:
    before = data.draw(random_routines)
    for after in (contract(before), contract(fuse(before))):
        assert run(after) == run(before)
        assert count_routine(after).total <= count_routine(before).total


def test_an_array_of_one_station_becomes_a_scalar() -> None:
    before = routine(loop(Assign(A.at(), KEPT.at() + 1), Assign(KEPT.at(), 2 * A.at())))
    after = contract(before)
    (scalar,) = after.variables(Role.LOCAL)
    assert (scalar.name, scalar.length, scalar.doc) == ("A", None, "torque of this joint")
    assert after.variables(Role.WORK) == ()


@pytest.mark.parametrize(
    "other",
    [
        loop(Assign(KEPT.at(), A.at())),  # reads what another loop wrote
        Assign(KEPT.entry(0), A.entry(2)),
        loop(Assign(A.at(1), KEPT.at()), Assign(KEPT.at(), A.at() + A.at(1))),
    ],
)
def test_an_array_read_elsewhere_stays(other: Assign | Loop) -> None:
    before = routine(loop(Assign(A.at(), KEPT.at() + 1), Assign(KEPT.at(), 2 * A.at())), other)
    assert contract(before).variables(Role.WORK) == (A,)


def test_copies_are_replaced_by_what_they_copy() -> None:
    before = routine(loop(Assign(X, KEPT.at() + 1), Assign(Y, X), Assign(KEPT.at(), 2 * Y)))
    assert contract(before) == routine(loop(Assign(X, KEPT.at() + 1), Assign(KEPT.at(), 2 * X)))


def test_a_copy_back_into_what_was_copied_goes() -> None:
    """Compilers warn of `x = x`."""
    before = routine(loop(Assign(Y, X), Assign(KEPT.at(), 2 * Y), Assign(X, Y)))
    assert contract(before) == routine(loop(Assign(KEPT.at(), 2 * X)))


def test_a_copy_of_what_changes_stays() -> None:
    before = routine(loop(Assign(Y, KEPT.at()), Assign(KEPT.at(), KEPT.at() + 1), Assign(KEPT.at(1), Y)))
    assert contract(before) == before


def test_no_name_changes_the_order_of_terms() -> None:
    """Sums of three terms are written in the order of their names: putting y for x would change rounding."""
    z, last = Variable("z", Role.LOCAL).ref, Variable("zz", Role.LOCAL).ref
    total = X + z + KEPT.at()
    assert sp.default_sort_key(X) < sp.default_sort_key(z) < sp.default_sort_key(last)
    before = routine(
        Assign(z, KEPT.entry(0)), Assign(last, KEPT.entry(1)), loop(Assign(X, last), Assign(KEPT.at(), total))
    )
    assert contract(before) == before


def test_unread_scratch_disappears() -> None:
    before = routine(Assign(X, KEPT.entry(0) * 3), loop(Assign(KEPT.at(), KEPT.at() + 1)))
    assert contract(before) == routine(loop(Assign(KEPT.at(), KEPT.at() + 1)))


@pytest.mark.parametrize("scene", ["thesis10", "drivetrain"])
@pytest.mark.parametrize("integrator", ["newmark", "houbolt", "bathe", "sdirk4"])
@pytest.mark.parametrize("sweep", ["riccati", "product"])
def test_operations_of_a_chain_stay(scene: str, integrator: str, sweep: str) -> None:
    changes = {"integrator.name": integrator, "model.sweep": sweep}
    changed = load_scene(scenes_dir() / f"{scene}.toml").replace(**changes)
    program = build_unchecked(
        changed, registry.integrator(integrator)
    )  # products may be too long to be of use
    for before in (program.prepare, program.initialise, *program.steps, program.output):
        after = contract(fuse(before))
        assert count_routine(after) == count_routine(before)
        assert len(after.variables(Role.WORK)) <= len(before.variables(Role.WORK))


def test_scratch_of_a_newmark_step() -> None:
    """What remains is what one loop hands to another."""
    program = build_program(load_scene(scenes_dir() / "thesis10.toml"))
    names = [v.name for v in contract(fuse(program.main)).variables(Role.WORK)]
    assert names == ["answer_own", "known_angle", "known_rate"]
