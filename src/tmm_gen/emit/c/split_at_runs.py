"""Loops over independent stations are cut where recursions are, so that fusion puts each piece into a walk.

Walks of an arm in space are loops over runs of stations alike; what they hand each other (what joints are predicted to
do, what their own laws ask for) is computed for all stations at once. Cut at the runs' bounds such loops go into the
walks, and two walks outward with nothing but them in between become one: while a recursion waits for its chain of
operations, a processor does the other's. Every value stays the same bit for bit; code grows.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

from tmm_gen.program.passes.lifetimes import written_scalars
from tmm_gen.program.statements import Assign, Loop, Require, Routine, Statement
from tmm_gen.program.variables import refs_in

_Line = Assign | Require


def split_at_runs(routine: Routine) -> Routine:
    """Return a routine whose loops over independent stations are cut at the bounds of its recursions."""
    walks = [s for s in routine.statements() if isinstance(s, Loop) and written_scalars(s)]
    runs = sorted({(w.start, w.stop, w.stride) for w in walks})
    if len(runs) < 2 or any(a[1] > b[0] for a, b in pairwise(runs)):
        return routine
    sections = (
        replace(section, statements=tuple(p for s in section.statements for p in _pieces(s, runs)))
        for section in routine.sections
    )
    return replace(routine, sections=tuple(sections))


def _pieces(statement: Statement, runs: list[tuple[int, int, int]]) -> Iterator[Statement]:
    """Yield a statement, or the pieces of a loop over independent stations, if runs cover it."""
    if not isinstance(statement, Loop) or not statement.parallel or written_scalars(statement):
        yield statement
        return
    mine = [run for run in runs if statement.start <= run[0] and run[1] <= statement.stop]
    if len(mine) < 2 or sum(stop - start for start, stop, _ in mine) < statement.stop - statement.start:
        yield statement
        return
    for start, stop, stride in mine:
        body = tuple(_at(line, slot) for slot in range(stride) for line in statement.body)
        yield Loop(statement.order, start, stop, body, stride)


def _at(line: _Line, slot: int) -> _Line:
    """Return a line for a station farther out."""
    refs = refs_in(line.value) | ({line.target} if isinstance(line, Assign) else set())
    moved = {r: r.variable.at(r.offset + slot) for r in refs if r.offset is not None}
    value = line.value.xreplace(moved)
    return Assign(moved.get(line.target, line.target), value) if isinstance(line, Assign) else Require(value)
