"""A loop outward, of which the loop inward behind it reads each station and its inner neighbour, goes into that loop.

What the first computes at a station is then at hand where the second uses it, instead of in memory, and there is one
loop less to count: a tenth of a chain's instructions. Station ``j`` of the second needs ``j - 1`` of the first, so the
first runs one station ahead; its last station and the second's first stand outside the loop. Every value stays the
same bit for bit.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import sympy as sp

from tmm_gen.program.passes.lifetimes import carried_scalars
from tmm_gen.program.statements import Assign, Loop, Order, Require, Routine, Section, Statement
from tmm_gen.program.variables import Ref, Role, Variable, refs_in

FEWEST = 4
"""Stations below which the copies outside the loop are most of it."""


def interleave(routine: Routine) -> Routine:
    """Return a routine with the first such pair of loops made one."""
    sections = list(routine.sections)
    places = [
        (s, k, statement)
        for s, section in enumerate(sections)
        for k, statement in enumerate(section.statements)
    ]
    for at, (s, k, first) in enumerate(places):
        if not isinstance(first, Loop):
            continue
        between: list[Statement] = []
        for t, m, second in places[at + 1 :]:
            if not isinstance(second, Loop):
                between.append(second)
                continue
            if _fits(first, second, between):
                ahead, both, behind = _parts(first, second)
                _put(sections, t, m, (both, *behind))
                _put(sections, s, k, ahead)
                titles = f"{sections[s].title}; {sections[t].title}" if s != t else sections[t].title
                sections[s] = replace(sections[s], title=f"{sections[s].title}: at the last station")
                sections[t] = replace(sections[t], title=titles)
                return replace(routine, sections=tuple(sections))
            break
    return routine


def _put(sections: list[Section], place: int, position: int, new: Iterable[Statement]) -> None:
    old = sections[place].statements
    sections[place] = replace(sections[place], statements=(*old[:position], *new, *old[position + 1 :]))


def _fits(first: Loop, second: Loop, between: list[Statement]) -> bool:
    if (first.order, second.order) != (Order.OUTWARD, Order.INWARD):
        return False
    if first.visits != second.visits or first.stride > 1 or len(first.visits) < FEWEST:
        return False
    if not all(isinstance(s, Assign) for s in (*first.body, *second.body, *between)):
        return False
    if carried_scalars(first) or any(s.value.has(sp.sin, sp.cos) for s in (*first.body, *second.body)):
        return False
    made = _written(first.body)
    if made & (_written(second.body) | _written(between) | _read(between)):
        return False
    if _read(first.body) & (_written(second.body) | _written(between)):
        return False
    arrays = {v for v in made if v.length is not None}
    ahead = {r.offset for s in _assigns(first) for r in (s.target, *refs_in(s.value)) if r.variable in arrays}
    used = {r.offset for s in second.body for r in refs_in(s.value) if r.variable in made}
    return arrays <= {v for v in arrays if v.role is Role.WORK} and ahead == {1} and used == {0, 1}


def _parts(first: Loop, second: Loop) -> tuple[tuple[Assign, ...], Loop, tuple[Assign, ...]]:
    """Return the first loop's last station, the loop of both, and the second's first station."""
    shifted = tuple(_moved(s, lambda r: r.variable.at((r.offset or 0) - 1)) for s in _assigns(first))
    both = Loop(Order.INWARD, second.start + 1, second.stop, (*shifted, *second.body))
    ahead = _at(first, first.stop - 1, "last")
    return ahead, both, _at(second, second.start, "first")


def _at(loop: Loop, station: int, label: str) -> tuple[Assign, ...]:
    """Return a loop's body at one station; scalars of the body alone get names of their own."""
    carried = carried_scalars(loop)
    own = {
        v: replace(v, name=f"{label}_{v.name}")
        for v in _written(loop.body)
        if v.length is None and v.role is Role.LOCAL and v not in carried
    }

    def place(ref: Ref) -> Ref:
        return ref.variable.entry(station + (ref.offset or 0))

    renamed = [
        Assign(
            s.target if s.target.variable not in own else own[s.target.variable].ref,
            s.value.xreplace({v.ref: new.ref for v, new in own.items()}),
        )
        for s in _assigns(loop)
    ]
    return tuple(_moved(s, place) for s in renamed)


def _moved(statement: Assign, place: object) -> Assign:
    assert callable(place)
    moved = {r: place(r) for r in (statement.target, *refs_in(statement.value)) if r.offset is not None}
    return Assign(moved.get(statement.target, statement.target), statement.value.xreplace(moved))


def _assigns(loop: Loop) -> list[Assign]:
    return [s for s in loop.body if isinstance(s, Assign)]


def _written(statements: Iterable[Statement | Assign | Require]) -> set[Variable]:
    return {s.target.variable for s in statements if isinstance(s, Assign)}


def _read(statements: Iterable[Statement | Assign | Require]) -> set[Variable]:
    return {r.variable for s in statements if isinstance(s, Assign | Require) for r in refs_in(s.value)}
