"""Routines with other expressions, other references, or fewer statements."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import replace

import sympy as sp

from tmm_gen.program.statements import Assign, Loop, Repeat, Require, Routine, Section, Statement, Until
from tmm_gen.program.variables import SCRATCH, Ref, Role, refs_in


def map_lines(
    section: Section,
    value: Callable[[sp.Expr, Ref | None], sp.Expr],
    target: Callable[[Ref], Ref] = lambda ref: ref,
) -> Section:
    """Return the section with every expression changed, and every reference that is assigned.

    Parameters
    ----------
    value : callable
        From an expression, and what it is assigned to, None where it is required, to another expression.
    target : callable
        From what is assigned to what takes its place.
    """

    def line(statement: Assign | Require) -> Assign | Require:
        if isinstance(statement, Assign):
            return Assign(target(statement.target), value(statement.value, statement.target))
        return Require(value(statement.value, None))

    def changed(statement: Statement) -> Statement:
        if isinstance(statement, Loop):
            return replace(statement, body=tuple(map(line, statement.body)))
        if isinstance(statement, Repeat):
            return statement
        if isinstance(statement, Until):
            return Until(value(statement.value, None))
        return line(statement)

    return replace(section, statements=tuple(map(changed, section.statements)))


def map_references(section: Section, change: Callable[[Ref], Ref]) -> Section:
    """Return the section with references changed, read or assigned."""

    def value(expression: sp.Expr, _: Ref | None) -> sp.Expr:
        found = {ref: change(ref) for ref in refs_in(expression)}
        return expression.xreplace({ref: other for ref, other in found.items() if other is not ref})

    return map_lines(section, value, change)


def renamed_scratch(
    routine: Routine, names: Mapping[str, str], *, roles: Collection[Role] = SCRATCH
) -> Routine:
    """Return the routine with some of its scratch under other names.

    Parameters
    ----------
    roles : collection of Role
        Of what is renamed; what was no scratch becomes it.
    """

    def other(ref: Ref) -> Ref:
        variable = ref.variable
        if variable.role not in roles or variable.name not in names:
            return ref
        scratch = Role.LOCAL if variable.length is None else Role.WORK
        role = variable.role if variable.role in SCRATCH else scratch
        return Ref(replace(variable, name=names[variable.name], role=role), ref.offset, ref.entry)

    return replace(routine, sections=tuple(map_references(s, other) for s in routine.sections))


def keep_assignments(routine: Routine, keep: Callable[[Assign], bool]) -> Routine:
    """Return the routine without the assignments that are not kept, nor loops and sections left empty."""
    return keep_statements(routine, lambda s: not isinstance(s, Assign) or keep(s))


def keep_statements(routine: Routine, keep: Callable[[Statement], bool]) -> Routine:
    """Return the routine without the statements that are not kept, nor loops and sections left empty.

    Parameters
    ----------
    keep : callable
        Says of each statement but a loop whether it stays.
    """
    sections: list[Section] = []
    for section in routine.sections:
        statements: list[Statement] = []
        for statement in section.statements:
            if isinstance(statement, Loop):
                body = tuple(s for s in statement.body if keep(s))
                if body:  # one that stays whole stays itself: caches know it at once
                    whole = len(body) == len(statement.body)
                    statements.append(statement if whole else replace(statement, body=body))
            elif keep(statement):
                statements.append(statement)
        if statements:
            sections.append(replace(section, statements=tuple(statements)))
    return replace(routine, sections=tuple(sections))
