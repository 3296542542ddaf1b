"""Joining: loops that do the same at neighbouring runs of stations, one right behind the other, become one."""

from __future__ import annotations

from dataclasses import replace

from tmm_gen.program.statements import Loop, Order, Routine, Section, Statement


def join(routine: Routine) -> Routine:
    """Join the loops of a routine; nothing is computed in another order."""
    return replace(routine, sections=tuple(map(_joined, routine.sections)))


def _joined(section: Section) -> Section:
    found: list[Statement] = []
    for statement in section.statements:
        if found and (both := _both(found[-1], statement)):
            found[-1] = both
        else:
            found.append(statement)
    return replace(section, statements=tuple(found))


def _both(first: Statement, second: Statement) -> Loop | None:
    if not (isinstance(first, Loop) and isinstance(second, Loop)):
        return None
    if (first.order, first.body, first.stride) != (second.order, second.body, second.stride):
        return None
    inner, outer = (first, second) if first.order is Order.OUTWARD else (second, first)
    return replace(first, start=inner.start, stop=outer.stop) if inner.stop == outer.start else None
