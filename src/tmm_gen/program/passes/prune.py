"""Drop what nothing reads."""

from __future__ import annotations

from tmm_gen.program.passes.rewrite import keep_assignments, keep_statements
from tmm_gen.program.statements import Assign, Require, Routine
from tmm_gen.program.variables import Role, Variable, refs_in


def prune(routine: Routine, wanted: frozenset[Variable]) -> Routine:
    """Remove assignments to variables that are neither wanted nor read by anything that stays.

    Parameters
    ----------
    wanted : frozenset of Variable
        Results of the routine: state, coefficients or outputs that live on after it.
    """

    def feeds_itself_only(assign: Assign, alive: frozenset[Variable]) -> bool:
        return assign.target.variable not in alive

    while True:
        alive = set(wanted)
        for assign in routine.assignments():
            for ref in refs_in(assign.value):
                if ref.variable is not assign.target.variable:
                    alive.add(ref.variable)
        for value in _required(routine):
            alive.update(ref.variable for ref in refs_in(value))
        pruned = keep_assignments(routine, lambda a, alive=frozenset(alive): not feeds_itself_only(a, alive))  # type: ignore[misc]
        if pruned == routine:
            return routine
        routine = pruned


def without_requirements(routine: Routine, wanted: frozenset[Variable] = frozenset()) -> Routine:
    """Remove what a routine requires, and what it computes for nothing else.

    Parameters
    ----------
    wanted : frozenset of Variable
        Scratch that lives on after the routine, beside all that is no scratch.
    """
    lives_on = frozenset(v for v in routine.written() if v.role not in SCRATCH)
    return prune(keep_statements(routine, lambda s: not isinstance(s, Require)), lives_on | wanted)


def _required(routine: Routine) -> list:  # type: ignore[type-arg]
    assigned = {id(a.value) for a in routine.assignments()}
    return [value for value in routine.values() if id(value) not in assigned]


SCRATCH = frozenset({Role.WORK, Role.LOCAL})
"""Roles that never outlive a routine."""
