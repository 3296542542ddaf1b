"""Dividing sections into what is bound early and the rest, and taking out of loops what is alike at every station."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from typing import Any

from tmm_gen.program.passes.bound_early import is_early
from tmm_gen.program.passes.look import assigns_of, inside
from tmm_gen.program.statements import Assign, Loop, Require, Section, Statement
from tmm_gen.program.variables import Ref, Role, Variable, refs_in


def divided(sections: list[Section], early: set[Variable]) -> tuple[list[list[Statement]], list[Section]]:
    """Return what of each section is bound early, and the sections without it."""
    taken: list[list[Statement]] = []
    left: list[Section] = []
    for section in sections:
        mine: list[Statement] = []
        kept: list[Statement] = []
        for statement in section.statements:
            soon: list[Assign | Require] = []
            late: list[Assign | Require] = []
            for each in inside(statement):
                (soon if _is_soon(each, early) else late).append(each)
            for part, into in ((soon, mine), (late, kept)):
                if part and isinstance(statement, Loop):
                    into.append(replace(statement, body=tuple(part)))
                else:
                    into += part
        taken.append(mine)
        if kept:
            left.append(replace(section, statements=tuple(kept)))
    return taken, left


def _is_soon(statement: Any, early: set[Variable]) -> bool:
    if isinstance(statement, Assign):
        return statement.target.variable in early
    asked = isinstance(statement, Require) and bool(refs_in(statement.value))
    return asked and is_early(statement.value, early)


def out_of_loops(statements: list[Statement]) -> list[Statement]:
    """Take out of loops what is the same at every station."""
    settings = Counter(a.target.variable for a in assigns_of(statements))
    once = {variable for variable, count in settings.items() if count == 1}
    outside = {s.target for s in statements if isinstance(s, Assign)}
    scalars: set[Ref] = set()
    alike: dict[Ref, Ref] = {}
    found: list[Statement] = []
    for statement in statements:
        if not isinstance(statement, Loop):
            found.append(statement)
            continue
        body: list[Assign | Require] = []
        for inner in statement.body:
            value = inner.value.xreplace(alike)
            uniform = not isinstance(inner, Assign) or inner.target.variable in once
            uniform = uniform and all(
                r.variable.length is None
                and (
                    r.variable.role.bound_at_prepare or r in scalars or (r.variable in once and r in outside)
                )
                for r in refs_in(value)
            )
            if uniform and isinstance(inner, Require):
                found.append(Require(value))
                continue
            if uniform:
                assert isinstance(inner, Assign)
                scalar = replace(inner.target.variable, role=Role.LOCAL, length=None).ref
                if scalar != inner.target:
                    alike[inner.target] = scalar
                else:
                    alike[scalar] = scalar
                scalars.add(scalar)
                found.append(Assign(scalar, value))
            else:
                body.append(replace(inner, value=value))
        if body:
            found.append(replace(statement, body=tuple(body)))
    return found
