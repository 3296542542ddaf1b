"""Fusion: adjacent loops over the same stations become one where dependences allow.

Programs keep station-parallel and recursive loops apart so that array languages can do all stations at once;
a language with cheap loops wants few of them, and values at hand instead of in memory. Statements keep their
expressions, so operations and rounding stay what they were.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import sympy as sp

from tmm_gen.program.passes.dependence import Together, Touched, order_keeping_dependences
from tmm_gen.program.statements import Assign, Loop, Routine, Section, Statement
from tmm_gen.program.variables import Variable, refs_in


@dataclass(frozen=True, eq=False)
class _Item:
    """A top-level statement, the titles it stands under, and what it touches."""

    titles: tuple[str, ...]
    statement: Statement
    touched: Touched

    @classmethod
    def of(cls, titles: tuple[str, ...], statement: Statement) -> _Item:
        return cls(titles, statement, Touched.of(statement))


def fuse(routine: Routine, *, apart: bool = False) -> Routine:
    """Fuse the loops of a routine, from its end backward.

    A loop whose stations are independent takes whatever order the other needs. Statements between two loops
    move before or behind them where nothing depends on their place.

    Parameters
    ----------
    routine : Routine
        As built.
    apart : bool
        Whether loops whose stations are independent stay apart from recursions, so that a compiler can do several
        stations at once, and from what computes the angles of their sines, so that these are checked in between.
    """
    items = [_Item.of((section.title,), s) for section in routine.sections for s in section.statements]
    last = len(items) - 1
    while last > 0:
        fused = _fuse_into(items, last, apart)
        if fused is None:
            last -= 1
        else:
            items, last = fused
    return replace(routine, sections=_sections(items))


def _fuse_into(items: list[_Item], last: int, apart: bool) -> tuple[list[_Item], int] | None:
    """Fuse the loop at ``last`` with the nearest earlier one it may be fused with; say where it then is."""
    second = items[last].statement
    if not isinstance(second, Loop):
        return None
    for first in range(last - 1, -1, -1):
        one = items[first].statement
        if not isinstance(one, Loop) or one.visits != second.visits or one.stride != second.stride:
            continue
        if apart and (one.parallel != second.parallel or _turns(second) & _written(one)):
            continue
        if (fused := _fuse_pair(items, first, last)) is not None:
            return fused
    return None


def _turns(loop: Loop) -> set[Variable]:
    """Return what the angles of a loop's sines and cosines are made of."""
    calls = (call for inner in loop.body for call in inner.value.atoms(sp.sin, sp.cos))
    return {ref.variable for call in calls for ref in refs_in(call)}


def _written(loop: Loop) -> set[Variable]:
    return {inner.target.variable for inner in loop.body if isinstance(inner, Assign)}


def _fuse_pair(items: list[_Item], first: int, last: int) -> tuple[list[_Item], int] | None:
    one, other = items[first], items[last]
    assert isinstance(one.statement, Loop)
    assert isinstance(other.statement, Loop)
    before: list[_Item] = []
    behind: list[_Item] = []
    waited_for, needs = Together(one.touched), Together(other.touched)
    for item in items[first + 1 : last]:
        if waited_for.independent(item.touched):
            before.append(item)
        elif needs.independent(item.touched):
            behind.append(item)
            waited_for.add(item.touched)
        else:  # it can go neither before the first loop nor behind the second
            return None
    later = (*behind, *items[last + 1 :])
    order = order_keeping_dependences(one.statement, other.statement, tuple(i.statement for i in later))
    if order is None:
        return None
    loop = replace(other.statement, order=order, body=(*one.statement.body, *other.statement.body))
    titles = tuple(dict.fromkeys((*one.titles, *other.titles)))
    return [*items[:first], *before, _Item.of(titles, loop), *later], first + len(before)


def _sections(items: list[_Item]) -> tuple[Section, ...]:
    """Gather statements under their titles again, a preparation under those of the loop it prepares."""
    groups: list[tuple[tuple[str, ...], list[Statement]]] = []
    for item in items:
        if groups and (set(groups[-1][0]) <= set(item.titles) or set(item.titles) <= set(groups[-1][0])):
            titles, statements = groups.pop()
            longer = titles if len(titles) >= len(item.titles) else item.titles
            groups.append((longer, [*statements, item.statement]))
        else:
            groups.append((item.titles, [item.statement]))
    return tuple(Section("; ".join(titles), tuple(statements)) for titles, statements in groups)
