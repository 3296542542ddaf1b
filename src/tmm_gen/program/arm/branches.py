"""Walks over a row with branches: outward each goes back to its fork, inward a fork adds up what all bring."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial

import sympy as sp

from tmm_gen.program.statements import Assign, Loop, Require
from tmm_gen.program.variables import Ref, local, refs_in
from tmm_gen.row.row import Row


def resumed(row: Row, start: int, kept: Mapping[Ref, Callable[[int], sp.Expr]]) -> list[Assign]:
    """Return what sets back the scalars of a walk outward where a branch begins.

    Parameters
    ----------
    start : int
        Index of a run's first station.
    kept : mapping from Ref to callable
        What a scalar was at a node, counted from the base.
    """
    host = row.host(start)
    return [] if host == start - 1 else [Assign(ref, at(host + 1)) for ref, at in kept.items()]


def kept_at_fork(row: Row, stop: int, carried: Iterable[Ref]) -> list[Assign]:
    """Return what keeps the scalars of a walk outward at a node, counted from the base, on which several parts hang."""
    several = any(row.host(k) == stop - 1 != k - 1 for k in range(stop, len(row.stations)))
    places = {ref: _at_fork(ref, sp.S.Zero, stop) for ref in carried} if several else {}
    return [Assign(place, ref) for ref, place in places.items() if isinstance(place, Ref)]


def from_fork(carried: Sequence[Ref], at_base: Sequence[sp.Expr]) -> dict[Ref, Callable[[int], sp.Expr]]:
    """Return what scalars were at a node where they were kept.

    Parameters
    ----------
    at_base : sequence of sympy.Expr
        What they were at the base.
    """
    return {ref: partial(_at_fork, ref, value) for ref, value in zip(carried, at_base, strict=True)}


def _at_fork(ref: Ref, at_base: sp.Expr, node: int) -> sp.Expr:
    doc = f"{ref.variable.doc}, kept for branches"
    return local(f"{ref.name}_at_fork_{node}", doc, ref.variable.unit) if node else at_base


def rooted(row: Row, loop: Loop) -> Loop:
    """Return a loop over a run of stations with its inner node where the first one hangs, or its shaft is mounted.

    Arrays over nodes have one element more than there are stations, base first.
    """
    hosts = {-back: row.host(loop.start - back) for back in (0, 1) if loop.start >= back}
    away: dict[int | None, int] = {k: host for k, host in hosts.items() if host != loop.start + k - 1}
    if not away:
        return loop
    nodes = len(row.stations) + 1

    def value(e: sp.Expr) -> sp.Expr:
        inner = {r for r in refs_in(e) if r.variable.length == nodes and r.offset in away}
        return e.xreplace({r: r.variable.entry(away[r.offset] + 1) for r in inner})

    body: tuple[Assign | Require, ...] = tuple(replace(s, value=value(s.value)) for s in loop.body)
    return replace(loop, body=body)


class Gathered:
    """What branches bring to the node they share, on a walk inward.

    Parameters
    ----------
    row : Row
    """

    def __init__(self, row: Row) -> None:
        self._row = row
        self._brought: dict[int, list[dict[Ref, Ref]]] = defaultdict(list)

    def leave(self, start: int, carried: Iterable[Ref]) -> list[Assign]:
        """Return what keeps the scalars of the walk behind the run that begins a branch."""
        host = self._row.host(start)
        if host == start - 1:
            return []
        kept = {
            ref: local(
                f"{ref.name}_of_branch_{start + 1}", f"{ref.variable.doc}, of a branch", ref.variable.unit
            )
            for ref in carried
        }
        self._brought[host].append(kept)
        return [Assign(target, ref) for ref, target in kept.items()]

    def joined(self, station: int, carried: Iterable[Ref]) -> dict[Ref, sp.Expr]:
        """Return what scalars are beyond a station (-1: the base), where several parts hang there.

        What hangs there first stands in the scalars themselves.
        """
        brought = self._brought.pop(station, [])
        if not brought:
            return {}
        return {ref: sp.Add(ref, *(kept[ref] for kept in brought if ref in kept)) for ref in carried}
