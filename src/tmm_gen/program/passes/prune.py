"""Drop what nothing reads."""

from __future__ import annotations

from dataclasses import replace

from tmm_gen.program.passes.dependence import SCRATCH, carried_scalars, dead_after
from tmm_gen.program.passes.rewrite import keep_assignments, keep_statements
from tmm_gen.program.statements import Assign, Loop, Require, Routine, Section, Statement
from tmm_gen.program.variables import Variable, refs_in


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
        pruned = _without_unread(pruned, wanted)
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


def _without_unread(routine: Routine, wanted: frozenset[Variable]) -> Routine:
    """Remove what a loop sets for itself and never reads, though another loop reads its own of that name."""
    statements = tuple(routine.statements())
    sections: list[Section] = []
    place = 0
    for section in routine.sections:
        kept: list[Statement] = []
        for statement in section.statements:
            place += 1
            later = statements[place:]
            if isinstance(statement, Loop):
                body = tuple(
                    inner
                    for number, inner in enumerate(statement.body)
                    if not (isinstance(inner, Assign) and _unread(inner, number, statement, later, wanted))
                )
                if not body:
                    continue
                statement = statement if len(body) == len(statement.body) else replace(statement, body=body)
            kept.append(statement)
        if kept:
            sections.append(replace(section, statements=tuple(kept)))
    return replace(routine, sections=tuple(sections))


def _unread(
    assign: Assign, number: int, loop: Loop, later: tuple[Statement, ...], wanted: frozenset[Variable]
) -> bool:
    variable = assign.target.variable
    if variable.length is not None or variable.role not in SCRATCH or variable in wanted:
        return False
    for inner in loop.body[number + 1 :]:
        if any(ref.variable == variable for ref in refs_in(inner.value)):
            return False
        if isinstance(inner, Assign) and inner.target.variable == variable:
            return True
    return variable not in carried_scalars(loop) and dead_after(variable, later)
