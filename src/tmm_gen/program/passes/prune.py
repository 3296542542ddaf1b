"""Drop what nothing reads."""

from __future__ import annotations

from dataclasses import replace

import sympy as sp

from tmm_gen.program.passes.lifetimes import Uses, carried_scalars
from tmm_gen.program.passes.rewrite import keep_assignments, keep_statements
from tmm_gen.program.statements import Assign, Loop, Require, Routine, Section, Statement
from tmm_gen.program.variables import SCRATCH, Variable, variables_in


def prune(routine: Routine, wanted: frozenset[Variable]) -> Routine:
    """Remove assignments to variables that are neither wanted nor read by anything that stays.

    Parameters
    ----------
    wanted : frozenset of Variable
        Results of the routine: state, coefficients or outputs that live on after it.
    """
    while True:
        kept = _without_dead(routine, wanted)
        pruned = _without_unread(kept, wanted)
        if pruned == kept:  # nor is anything dead then that was alive before
            return routine if kept == routine else kept
        routine = pruned


def _without_dead(routine: Routine, wanted: frozenset[Variable]) -> Routine:
    """Remove what only feeds itself, or others that do."""
    alive = _alive(routine, wanted)
    return keep_assignments(routine, lambda assign: assign.target.variable in alive)


def _alive(routine: Routine, wanted: frozenset[Variable]) -> set[Variable]:
    """Return what is wanted, or read by what is; what only feeds itself, or others that do, is not among it."""
    alive = set(wanted)
    for value in _required(routine):
        alive |= variables_in(value)
    feeding: dict[Variable, set[Variable]] = {}
    for assign in routine.assignments():
        feeding.setdefault(assign.target.variable, set()).update(variables_in(assign.value))
    ahead = list(alive)
    while ahead:
        more = feeding.get(ahead.pop(), set()) - alive
        alive |= more
        ahead += more
    return alive


def without_requirements(routine: Routine, wanted: frozenset[Variable] = frozenset()) -> Routine:
    """Remove what a routine requires, and what it computes for nothing else.

    Parameters
    ----------
    wanted : frozenset of Variable
        Scratch that lives on after the routine, beside all that is no scratch.
    """
    lives_on = frozenset(v for v in routine.written() if v.role not in SCRATCH)
    return prune(keep_statements(routine, lambda s: not isinstance(s, Require)), lives_on | wanted)


def _required(routine: Routine) -> list[sp.Expr]:
    assigned = {id(a.value) for a in routine.assignments()}
    return [value for value in routine.values() if id(value) not in assigned]


def _without_unread(routine: Routine, wanted: frozenset[Variable]) -> Routine:
    """Remove what a loop sets for itself and never reads, though another loop reads its own of that name."""
    then = Uses()
    sections: list[Section] = []
    for section in reversed(routine.sections):
        kept: list[Statement] = []
        for statement in reversed(section.statements):
            if not isinstance(statement, Loop):
                kept.append(statement)
            elif body := _read_body(statement, then, wanted):
                kept.append(statement if len(body) == len(statement.body) else replace(statement, body=body))
            then.before(statement)
        if kept:
            sections.append(replace(section, statements=tuple(reversed(kept))))
    return replace(routine, sections=tuple(reversed(sections)))


def _read_body(loop: Loop, then: Uses, wanted: frozenset[Variable]) -> tuple[Assign | Require, ...]:
    """Return a loop's statements without those that set what nothing reads: neither the loop nor what comes then."""
    carried = carried_scalars(loop)
    read: dict[Variable, bool] = {}  # whether the next use of a variable, within the visit, reads it
    kept: list[Assign | Require] = []
    for inner in reversed(loop.body):
        if isinstance(inner, Assign):
            variable = inner.target.variable
            private = variable.length is None and variable.role in SCRATCH and variable not in wanted
            if not private or read.get(variable, variable in carried or not then.dead(variable)):
                kept.append(inner)
            read[variable] = False
        else:
            kept.append(inner)
        read.update(dict.fromkeys(variables_in(inner.value), True))
    return tuple(reversed(kept))
