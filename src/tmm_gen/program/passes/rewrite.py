"""Shared walking of routines for passes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import sympy as sp

from tmm_gen.program.statements import Assign, Loop, Repeat, Routine, Section, Statement
from tmm_gen.program.variables import Ref, Role, refs_in


def map_values(routine: Routine, change: Callable[[sp.Expr], sp.Expr]) -> Routine:
    """Return the routine with every expression changed."""

    def changed(statement: Statement) -> Statement:
        if isinstance(statement, Loop):
            return replace(statement, body=tuple(changed(s) for s in statement.body))  # type: ignore[misc]
        if isinstance(statement, Repeat):
            return statement
        return replace(statement, value=change(statement.value))

    sections = tuple(
        replace(section, statements=tuple(changed(s) for s in section.statements))
        for section in routine.sections
    )
    return replace(routine, sections=sections)


def map_assigned(routine: Routine, change: Callable[[sp.Expr, Ref | None], sp.Expr]) -> Routine:
    """Return the routine with every expression changed, told what it is assigned to."""

    def changed(statement: Statement) -> Statement:
        if isinstance(statement, Loop):
            return replace(statement, body=tuple(changed(s) for s in statement.body))  # type: ignore[misc]
        if isinstance(statement, Repeat):
            return statement
        target = statement.target if isinstance(statement, Assign) else None
        return replace(statement, value=change(statement.value, target))

    sections = tuple(
        replace(section, statements=tuple(changed(s) for s in section.statements))
        for section in routine.sections
    )
    return replace(routine, sections=sections)


def renamed_scratch(
    routine: Routine, names: Mapping[str, str], *, roles: tuple[Role, ...] = (Role.WORK, Role.LOCAL)
) -> Routine:
    """Return the routine with some of its scratch under other names.

    Parameters
    ----------
    roles : tuple of Role
        Of what is renamed; what was no scratch becomes it.
    """

    def other(ref: Ref) -> Ref:
        variable = ref.variable
        if variable.role not in roles or variable.name not in names:
            return ref
        scratch = Role.LOCAL if variable.length is None else Role.WORK
        role = variable.role if variable.role in (Role.WORK, Role.LOCAL) else scratch
        return Ref(replace(variable, name=names[variable.name], role=role), ref.offset, ref.entry)

    def changed(statement: Statement) -> Statement:
        if isinstance(statement, Loop):
            return replace(statement, body=tuple(changed(s) for s in statement.body))  # type: ignore[misc]
        if isinstance(statement, Repeat):
            return statement
        value = statement.value.xreplace({ref: other(ref) for ref in refs_in(statement.value)})
        if isinstance(statement, Assign):
            return Assign(other(statement.target), value)
        return replace(statement, value=value)

    sections = tuple(replace(s, statements=tuple(map(changed, s.statements))) for s in routine.sections)
    return replace(routine, sections=sections)


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
