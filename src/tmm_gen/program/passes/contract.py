"""Contraction: scratch that lives within one station needs no array.

Arrays of scratch that every loop sets before reading, at one and the same offset, become scalars; copies of
scratch are replaced by what they copy; what is then unread goes. No expression changes but for names, and no
name changes where it would alter the order in which backends write terms: values stay the same bit for bit.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from operator import is_
from typing import TypeGuard

import sympy as sp

from tmm_gen.program.passes.accesses import accesses, first_uses, uses_of
from tmm_gen.program.passes.lifetimes import Uses
from tmm_gen.program.passes.prune import prune
from tmm_gen.program.statements import Assign, Loop, Mark, Require, Routine, Section, Statement
from tmm_gen.program.variables import SCRATCH, Ref, Role, Variable, refs_in


def contract(routine: Routine) -> Routine:
    """Return the routine with less scratch."""
    for variable in routine.variables(Role.WORK):
        if _private_to_stations(routine, variable):
            routine = _as_scalar(routine, variable)
    routine = _without_dead_copies(_map_blocks(routine, _propagate_copies))
    return prune(routine, frozenset(v for v in routine.written() if v.role not in SCRATCH))


def _map_blocks(
    routine: Routine, change: Callable[[tuple[Statement, ...]], tuple[Statement, ...]]
) -> Routine:
    """Change every section's statements, and those of every loop."""

    def inside(statement: Statement) -> Statement:
        if not isinstance(statement, Loop):
            return statement
        body = change(statement.body)
        if len(body) == len(statement.body) and all(map(is_, body, statement.body)):
            return statement  # and caches know it at once
        return replace(statement, body=body)  # type: ignore[arg-type]

    sections = (
        replace(s, statements=change(tuple(inside(x) for x in s.statements))) for s in routine.sections
    )
    return replace(routine, sections=tuple(sections))


# -- arrays -----------------------------------------------------------------------------------------


def _private_to_stations(routine: Routine, variable: Variable) -> bool:
    """Whether each loop that uses an array sets each element itself, at the station where it reads it."""
    for statement in routine.statements():
        uses = uses_of(statement).get(variable, ())
        if uses and not (
            uses[0].writes and uses[0].ref.offset is not None and len({a.ref.offset for a in uses}) == 1
        ):
            return False
    return True


def _as_scalar(routine: Routine, variable: Variable) -> Routine:
    scalar = replace(variable, role=Role.LOCAL, length=None, doc=variable.doc.replace("each", "this")).ref
    names = {
        access.ref: scalar
        for statement in routine.statements()
        for access in uses_of(statement).get(variable, ())
    }
    if not all(_keeps_order(value, names) for value in routine.values()):
        return routine

    def renamed(block: tuple[Statement, ...]) -> tuple[Statement, ...]:
        return tuple(s if isinstance(s, Loop | Mark) else _rename(s, names, target=True) for s in block)

    return _map_blocks(routine, renamed)


# -- copies -----------------------------------------------------------------------------------------


def _propagate_copies(block: tuple[Statement, ...]) -> tuple[Statement, ...]:
    """Replace, within a block, scratch scalars by the references they are copies of."""
    copies: dict[Ref, Ref] = {}
    changed: list[Statement] = []
    for statement in block:
        if isinstance(statement, Mark):
            copies = {}
            changed.append(statement)
            continue
        if isinstance(statement, Loop):
            written = {a.variable for a in accesses(statement) if a.writes}
            copies = {x: y for x, y in copies.items() if not {x.variable, y.variable} & written}
            changed.append(statement)
            continue
        if _keeps_order(statement.value, copies):
            statement = _rename(statement, copies, target=False)
        if isinstance(statement, Assign) and statement.value == statement.target:
            continue  # a copy of what it was a copy of: nothing changes
        changed.append(statement)
        if isinstance(statement, Assign):
            target = statement.target
            copies = {x: y for x, y in copies.items() if target.variable not in (x.variable, y.variable)}
            if (
                target.variable.role is Role.LOCAL
                and isinstance(statement.value, Ref)
                and statement.value != target
            ):
                copies[target] = statement.value
    return tuple(changed)


def _without_dead_copies(routine: Routine) -> Routine:
    """Remove copies into scratch scalars that are set again, or forgotten, before anything reads them."""
    sections: list[Section] = []
    then = Uses()
    for section in reversed(routine.sections):
        kept: list[Statement] = []
        for statement in reversed(section.statements):
            if isinstance(statement, Loop):
                kept.append(_loop_without_dead_copies(statement, then))
            elif not (_copies_into_scratch(statement) and then.dead(statement.target.variable)):
                kept.append(statement)
            then.before(statement)
        if kept:
            sections.append(replace(section, statements=tuple(reversed(kept))))
    return replace(routine, sections=tuple(reversed(sections)))


def _loop_without_dead_copies(loop: Loop, then: Uses) -> Loop:
    """Do the same inside a loop, whose end leads to its beginning and to what comes then."""
    body: list[Assign | Require] = []
    again, rest = first_uses(loop), dict[Variable, bool]()
    for inner in reversed(loop.body):
        if _copies_into_scratch(inner):
            variable = inner.target.variable
            dead = rest.get(variable, again[variable] and then.dead(variable))
        else:
            dead = False
        if not dead:
            body.append(inner)
        rest.update(first_uses(inner))
    return loop if len(body) == len(loop.body) else replace(loop, body=tuple(reversed(body)))


def _copies_into_scratch(statement: Assign | Require | Mark) -> TypeGuard[Assign]:
    return (
        isinstance(statement, Assign)
        and statement.target.variable.role is Role.LOCAL
        and isinstance(statement.value, Ref)
    )


def _rename(statement: Assign | Require, names: Mapping[Ref, Ref], *, target: bool) -> Assign | Require:
    touched = statement.target in names if target and isinstance(statement, Assign) else False
    if not touched and names.keys().isdisjoint(refs_in(statement.value)):
        return statement
    value = statement.value.xreplace(dict(names))
    if isinstance(statement, Require):
        return Require(value)
    return Assign(names.get(statement.target, statement.target) if target else statement.target, value)


def _keeps_order(value: sp.Expr, names: Mapping[Ref, Ref]) -> bool:
    """Whether renaming leaves terms and factors in the order in which they are written."""
    if names.keys().isdisjoint(refs_in(value)):
        return True
    return _written_order(value, names) == _written_order(value.xreplace(dict(names)), {})


def _written_order(e: sp.Expr, names: Mapping[Ref, Ref]) -> tuple[object, ...]:
    if isinstance(e, Ref):
        return (names.get(e, e).name,)
    if e.is_Atom:
        return (str(e),)
    if not (e.is_Add or e.is_Mul):
        return (type(e).__name__, *(_written_order(a, names) for a in e.args))
    # the two orders of a product: above the line as they stand, below it inverted
    orders = [sorted(e.args, key=sp.default_sort_key)]
    if e.is_Mul:
        orders.append(sorted(e.args, key=lambda f: sp.default_sort_key(f.as_base_exp()[0])))
    return (type(e).__name__, *(tuple(_written_order(a, names) for a in order) for order in orders))
