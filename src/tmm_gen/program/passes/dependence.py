"""Which statements may change places, and which loops may run the other way or as one."""

from __future__ import annotations

from collections.abc import Mapping, Set
from dataclasses import dataclass

from tmm_gen.program.passes.accesses import accesses, uses_of
from tmm_gen.program.passes.lifetimes import carried_scalars, dead_after, set_before_use, written_scalars
from tmm_gen.program.statements import Loop, Mark, Order, Statement
from tmm_gen.program.variables import Variable


@dataclass(frozen=True, eq=False)
class Touched:
    """What a statement reads and writes, gathered once for the many comparisons of a pass.

    Parameters
    ----------
    reads, writes : dict from Variable to frozenset of (int, int)
        First and last elements touched, by variable.
    mark : bool
        Whether it is one between which and what stands around it nothing may change places.
    """

    reads: dict[Variable, frozenset[tuple[int, int]]]
    writes: dict[Variable, frozenset[tuple[int, int]]]
    mark: bool = False

    @classmethod
    def of(cls, statement: Statement) -> Touched:
        """Gather the accesses of a statement."""
        found: tuple[dict[Variable, set[tuple[int, int]]], dict[Variable, set[tuple[int, int]]]] = ({}, {})
        for access in accesses(statement):
            found[access.writes].setdefault(access.variable, set()).add((access.first, access.last))
        reads, writes = ({v: frozenset(spans) for v, spans in each.items()} for each in found)
        return cls(reads, writes, isinstance(statement, Mark))


class Together:
    """What several statements read and write together: whoever is independent of it is independent of each."""

    def __init__(self, *statements: Touched) -> None:
        self._reads: dict[Variable, set[tuple[int, int]]] = {}
        self._writes: dict[Variable, set[tuple[int, int]]] = {}
        self._mark = False
        for touched in statements:
            self.add(touched)

    def add(self, touched: Touched) -> None:
        """Take one more statement in."""
        self._mark = self._mark or touched.mark
        for mine, its in ((self._reads, touched.reads), (self._writes, touched.writes)):
            for variable, spans in its.items():
                mine.setdefault(variable, set()).update(spans)

    def independent(self, touched: Touched) -> bool:
        """Whether a statement may change places with all of them."""
        return not (
            self._mark
            or touched.mark
            or _overlap(self._writes, touched.writes)
            or _overlap(self._writes, touched.reads)
            or _overlap(self._reads, touched.writes)
        )


def _overlap(
    one: Mapping[Variable, Set[tuple[int, int]]], other: Mapping[Variable, Set[tuple[int, int]]]
) -> bool:
    if len(other) < len(one):
        one, other = other, one
    return any(
        first <= end and start <= last
        for variable in one
        if variable in other
        for first, last in one[variable]
        for start, end in other[variable]
    )


def reversible(loop: Loop) -> bool:
    """Whether a loop gives the same arrays in either order; scalars it leaves behind may differ."""
    if carried_scalars(loop):
        return False
    return all(
        not a.meets(b) or (a.ref.offset is not None and a.ref.offset == b.ref.offset)
        for variable, used in uses_of(loop).items()
        if variable.length is not None
        for a in used
        for b in used
    )


def order_keeping_dependences(first: Loop, second: Loop, later: tuple[Statement, ...]) -> Order | None:
    """Return an order in which one loop may do the work of two, or None.

    Every element the first loop wrote must be written, and every element the second overwrites must have been
    read, by the time a station is visited.

    Parameters
    ----------
    first, second : Loop
        Loops over the same stations, the second right behind the first.
    later : tuple of Statement
        What follows them: scalars it reads keep their value.
    """
    if first.visits != second.visits or first.stride != second.stride or not _scalars_apart(first, second):
        return None
    orders: tuple[Order, ...] = (second.order, *Order)
    for order in dict.fromkeys(orders):
        turned = [loop for loop in (first, second) if loop.order is not order]
        if all(_turns(loop, later) for loop in turned) and _elements_in_time(first, second, order):
            return order
    return None


def _scalars_apart(first: Loop, second: Loop) -> bool:
    """Whether scalars that either loop writes are its own, set anew at every station before they are read."""
    for variable, used in uses_of(first).items():
        if variable.length is not None:
            continue
        if set_before_use(first, variable) and set_before_use(second, variable):
            continue
        if any(a.meets(b) for a in used for b in uses_of(second).get(variable, ())):
            return False
    return True


def _turns(loop: Loop, later: tuple[Statement, ...]) -> bool:
    return reversible(loop) and all(dead_after(v, later) for v in written_scalars(loop))


def _elements_in_time(first: Loop, second: Loop, order: Order) -> bool:
    for a in accesses(first):
        if a.variable.length is None:
            continue
        for b in uses_of(second).get(a.variable, ()):
            if not a.meets(b):
                continue
            if a.ref.offset is None or b.ref.offset is None:
                return False
            ahead = a.ref.offset - b.ref.offset  # stations between the first loop's visit and the second's
            if ahead < 0 if order is Order.OUTWARD else ahead > 0:
                return False
    return True
