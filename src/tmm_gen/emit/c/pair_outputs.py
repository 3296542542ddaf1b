"""Outputs of kernels whose numbers are sums of two: summed up as such, and rounded once when they are handed over."""

from __future__ import annotations

from dataclasses import replace

from tmm_gen.program.statements import Assign, Loop, Mark, Require, Routine, Section, Statement
from tmm_gen.program.variables import Ref, Role, local


def rounded_last(routine: Routine) -> Routine:
    """Return a routine that reads none of its outputs: what it adds up there, it adds up in a scalar of its own."""
    held = {
        v.ref: local(f"sum_{v.name}", v.doc, v.unit)
        for v in sorted(routine.read(), key=lambda v: v.name)
        if v.role is Role.OUTPUT
    }
    if not held:
        return routine

    def moved(statement: Statement) -> Statement:
        if isinstance(statement, Mark):  # no output repeats anything
            return statement
        if isinstance(statement, Loop):
            return replace(statement, body=tuple(_moved(inner, held) for inner in statement.body))
        return _moved(statement, held)

    sections = tuple(
        replace(section, statements=tuple(map(moved, section.statements))) for section in routine.sections
    )
    end = Section("rounded", tuple(Assign(output, total) for output, total in held.items()))
    return replace(routine, sections=(*sections, end))


def _moved(statement: Assign | Require, held: dict[Ref, Ref]) -> Assign | Require:
    if isinstance(statement, Require):
        return Require(statement.value.xreplace(held))
    return Assign(held.get(statement.target, statement.target), statement.value.xreplace(held))
