"""Sums of recursions in the order in which their terms become known.

A loop that hands values from station to station takes as long as the longest chain of operations between them, and
compilers may not reorder sums of floating-point numbers: so they are written in the order that makes chains short.
Every sum keeps its terms; rounding differs in the last digits.
"""

from __future__ import annotations

from dataclasses import replace

import sympy as sp

from tmm_gen.emit.c.clock import Pair, settled
from tmm_gen.emit.c.late_factor import late_factors_last
from tmm_gen.program.passes.accesses import written_elements
from tmm_gen.program.passes.lifetimes import carried_scalars, dead_after, written_scalars
from tmm_gen.program.statements import Assign, Loop, Order, Require, Routine, Section, Statement
from tmm_gen.program.variables import Ref, Role, Variable, refs_in

_Line = Assign | Require


def early_first(routine: Routine) -> Routine:
    """Return a routine whose recursions add first what is known first."""
    later = list(routine.statements())
    taken = {v.name for v in routine.read() | routine.written()}
    sections = []
    for section in routine.sections:
        statements: list[Statement] = []
        for statement in section.statements:
            later = later[1:]
            if isinstance(statement, Loop) and carried_scalars(statement):
                ahead, statement = _begun_ahead(statement, tuple(later), routine)
                statements += ahead
                statement = late_factors_last(statement, lambda variable: _part_of(variable, taken))
                statement = _sorted(statement, taken)
            statements.append(statement)
        sections.append(Section(section.title, tuple(statements)))
    return replace(routine, sections=tuple(sections))


# -- what a station begins with ---------------------------------------------------------------------


def _begun_ahead(loop: Loop, later: tuple[Statement, ...], routine: Routine) -> tuple[list[Assign], Loop]:
    """Let each station end with what the next one begins with, where that adds what is known to what is carried.

    The addition then need not wait for the end of the chain. The first station's stands before the loop; the last one
    does its own in vain, so that nothing may read it.
    """
    ahead: list[Assign] = []
    by = 1 if loop.order is Order.OUTWARD else -1
    first = loop.start if by == 1 else loop.last
    for variable in sorted(carried_scalars(loop), key=lambda v: v.name):
        uses = [k for k, line in enumerate(loop.body) if variable.ref in _refs(line)]
        head = loop.body[uses[0]]
        if len(uses) < 2 or not isinstance(head, Assign) or head.target != variable.ref:
            continue
        rest = head.value - variable.ref
        if not head.value.is_Add or variable.ref not in head.value.args or variable.ref in refs_in(rest):
            continue
        if loop.stride > 1 or not dead_after(variable, later) or not _known(rest, loop, routine, by):
            continue
        last = loop.body[uses[-1]]
        if not (isinstance(last, Assign) and last.target == variable.ref and last.value.is_Add):
            continue
        moved = {r: r.variable.at((r.offset or 0) + by) for r in refs_in(rest) if r.offset is not None}
        body = list(loop.body)
        body[uses[-1]] = Assign(variable.ref, last.value + rest.xreplace(moved))
        del body[uses[0]]
        loop = replace(loop, body=tuple(body))
        at_first = {r: r.variable.entry(first + (r.offset or 0)) for r in moved}
        ahead.append(Assign(variable.ref, variable.ref + rest.xreplace(at_first)))
    return ahead, loop


def _refs(line: _Line) -> frozenset[Ref]:
    found = refs_in(line.value)
    return found | {line.target} if isinstance(line, Assign) else found


def _known(rest: sp.Expr, loop: Loop, routine: Routine, by: int) -> bool:
    """Whether all of an expression is known before the loop, at the station beyond its last one too."""
    beyond = loop.stop if by == 1 else loop.start - 1
    for ref in refs_in(rest):
        if ref.variable in written_scalars(loop) or any(
            isinstance(s, Assign) and s.target.variable == ref.variable for s in loop.body
        ):
            return False
        if ref.offset is None:
            continue
        element = beyond + ref.offset
        if not 0 <= element < (ref.variable.length or 0):
            return False
        if ref.variable.role is Role.WORK and not any(
            begin <= element < end for begin, end in written_elements(routine, ref.variable)
        ):
            return False
    return True


# -- sums -------------------------------------------------------------------------------------------


def _sorted(loop: Loop, taken: set[str]) -> Loop:
    """Return a loop whose sums are added in the order in which their terms are known."""
    clock = settled(loop)
    body: list[_Line] = []
    for line in loop.body:
        value = line.value
        if isinstance(line, Assign) and value.is_Add and len(value.args) > 2:
            known, order = clock.sum(value.args)
            if known < clock.as_written(value):
                *parts, line = _parts(order, line.target, taken)
                body += parts
        body.append(line)
        if isinstance(line, Assign):
            clock.set(line.target, line.value)
    return replace(loop, body=tuple(body))


def _parts(tree: sp.Expr | Pair, target: Ref, taken: set[str]) -> list[Assign]:
    """Return the assignments that add up a tree, the last one to the target."""
    lines: list[Assign] = []

    def whole(tree: sp.Expr | Pair) -> sp.Expr:
        return sp.Add(part(tree.one), part(tree.other)) if isinstance(tree, Pair) else tree

    def part(tree: sp.Expr | Pair) -> sp.Expr:
        if not isinstance(tree, Pair):
            return tree
        value = whole(tree)
        variable = _part_of(target.variable, taken)
        lines.append(Assign(variable.ref, value))
        return variable.ref

    value = whole(tree)
    return [*lines, Assign(target, value)]


def _part_of(variable: Variable, taken: set[str]) -> Variable:
    """Return a scalar for a part of a sum under a name of its own."""
    number = 1
    while (name := f"{variable.name}_part{number}") in taken:
        number += 1
    taken.add(name)
    return Variable(name, Role.LOCAL, doc=f"part of {variable.doc}", unit=variable.unit)
