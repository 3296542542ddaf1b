"""How long a recursion waits for itself: the chain of dependent operations from one station to the next."""

from __future__ import annotations

import heapq
from collections.abc import Iterable
from itertools import count
from typing import NamedTuple

import sympy as sp

from tmm_gen.emit.expressions import ordered_terms
from tmm_gen.program.passes.lifetimes import carried_scalars
from tmm_gen.program.statements import Assign, Loop
from tmm_gen.program.variables import Ref

ADDITION = MULTIPLICATION = 4.0
"""Cycles until a result can be used, on processors that do several operations at a time."""
DIVISION = 13.0
EARLY = -1e9
"""When what no station hands on is known."""
_STATIONS = 6
"""After which chains have taken their lead."""


class Pair(NamedTuple):
    """Two sums or terms that are added."""

    one: sp.Expr | Pair
    other: sp.Expr | Pair


class Clock:
    """When values of a loop's body are known, in cycles.

    Parameters
    ----------
    loop : Loop
        Its scalars that are carried are known at 0 at first.
    """

    def __init__(self, loop: Loop) -> None:
        self.known: dict[Ref, float] = {v.ref: 0.0 for v in carried_scalars(loop)}

    def of(self, value: sp.Expr) -> float:
        """Return when an expression is known whose sums are added in the best order."""
        if isinstance(value, Ref):
            return self.known.get(value, EARLY)
        if value.is_Atom:
            return EARLY
        if value.is_Add:
            return self.sum(value.args)[0]
        if value.is_Pow and value.exp.is_Integer and value.exp < 0:
            return self.of(value.base) + DIVISION
        times = sorted(self.of(factor) for factor in value.args if not factor.is_Number)
        found = times[0] if times else EARLY
        for time in times[1:]:
            found = max(found, time) + MULTIPLICATION
        return found + (MULTIPLICATION if value.is_Pow or (len(times) == 1 and not _sign(value)) else 0.0)

    def sum(self, terms: Iterable[sp.Expr]) -> tuple[float, sp.Expr | Pair]:
        """Return when a sum is known, and in which order its terms are added: the earliest two again and again."""
        order = count()
        heap: list[tuple[float, int, sp.Expr | Pair]] = [(self.of(t), next(order), t) for t in terms]
        heapq.heapify(heap)
        while len(heap) > 1:
            one, other = heapq.heappop(heap), heapq.heappop(heap)
            heapq.heappush(heap, (max(one[0], other[0]) + ADDITION, next(order), Pair(one[2], other[2])))
        return heap[0][0], heap[0][2]

    def as_written(self, value: sp.Expr) -> float:
        """Return when a sum is known whose terms are added as they are printed."""
        first, *rest = ordered_terms(value)
        found = self.of(first)
        for term in rest:
            found = max(found, self.of(term)) + ADDITION
        return found

    def set(self, target: Ref, value: sp.Expr) -> None:
        """Take an assignment in."""
        self.known[target] = self.of(value)


def _sign(value: sp.Expr) -> bool:
    """Whether a product's number is a mere sign."""
    return bool(value.args[0] == -1)


def settled(loop: Loop) -> Clock:
    """Return the clock of a loop at the end of a station, after some of them."""
    clock = Clock(loop)
    for _ in range(_STATIONS):
        _take(loop, clock)
    return clock


def period(loop: Loop) -> float:
    """Return how long a loop waits for itself at each station, in cycles."""
    clock = settled(loop)
    before = max(clock.known.values())
    for _ in range(_STATIONS):
        _take(loop, clock)
    return (max(clock.known.values()) - before) / _STATIONS


def _take(loop: Loop, clock: Clock) -> None:
    for inner in loop.body:
        if isinstance(inner, Assign):
            clock.set(inner.target, inner.value)
