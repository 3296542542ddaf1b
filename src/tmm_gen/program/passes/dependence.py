"""Which statements may change places: what they read and write, and at which stations."""

from __future__ import annotations

from collections.abc import Mapping, Set
from dataclasses import dataclass
from functools import lru_cache

from tmm_gen.program.statements import Assign, Loop, Mark, Order, Require, Routine, Statement
from tmm_gen.program.variables import Ref, Role, Variable, refs_in

SCRATCH = frozenset({Role.WORK, Role.LOCAL})
"""Roles of variables that no one reads after the routine."""


@dataclass(frozen=True)
class Access:
    """One use of a variable by a top-level statement.

    Parameters
    ----------
    ref : Ref
        Scalar, fixed entry, or element relative to the loop's index.
    writes : bool
        Whether it is assigned.
    first, last, every : int
        Elements touched (0, 0 for a scalar): every so manieth.
    """

    ref: Ref
    writes: bool
    first: int
    last: int
    every: int = 1

    @property
    def variable(self) -> Variable:
        """What is used."""
        return self.ref.variable

    def meets(self, other: Access) -> bool:
        """Whether both touch a common element and at least one writes."""
        return (
            (self.writes or other.writes)
            and self.variable == other.variable
            and self.first <= other.last
            and other.first <= self.last
            and not (self.every == other.every and (self.first - other.first) % self.every)
        )


@lru_cache(maxsize=1 << 14)
def accesses(statement: Statement) -> tuple[Access, ...]:
    """Return every use of a variable by a statement, in the order of execution."""
    if isinstance(statement, Loop):
        return tuple(a for inner in statement.body for a in _of(inner, statement.visits))
    return tuple(_of(statement, range(1)))


@lru_cache(maxsize=1 << 14)
def uses_of(statement: Statement) -> dict[Variable, tuple[Access, ...]]:
    """Return what a statement does with each variable, in the order of execution."""
    found: dict[Variable, list[Access]] = {}
    for access in accesses(statement):
        found.setdefault(access.variable, []).append(access)
    return {variable: tuple(used) for variable, used in found.items()}


def written_elements(routine: Routine, array: Variable) -> list[tuple[int, int]]:
    """Return the elements of an array that a routine writes, as first and one past the last of each run of them."""
    touched = {
        element
        for line in routine.statements()
        for a in accesses(line)
        if a.writes and a.variable == array and array.length is not None
        for element in range(a.first, a.last + 1, a.every)
    }
    begins = sorted(element for element in touched if element - 1 not in touched)
    ends = sorted(element + 1 for element in touched if element + 1 not in touched)
    return list(zip(begins, ends, strict=True))


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


@lru_cache(maxsize=1 << 12)
def carried_scalars(loop: Loop) -> frozenset[Variable]:
    """Return scalars a loop assigns whose value one station hands to the next."""
    return frozenset(v for v in written_scalars(loop) if not _set_before_use(loop, v))


@lru_cache(maxsize=1 << 12)
def first_uses(statement: Statement) -> dict[Variable, bool]:
    """Return whether the first use of each variable writes it."""
    found: dict[Variable, bool] = {}
    for access in accesses(statement):
        found.setdefault(access.variable, access.writes)
    return found


@lru_cache(maxsize=1 << 12)
def written_scalars(loop: Loop) -> frozenset[Variable]:
    """Return the scalars a loop assigns."""
    return frozenset(
        s.target.variable for s in loop.body if isinstance(s, Assign) and s.target.variable.length is None
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


def dead_after(variable: Variable, later: tuple[Statement, ...]) -> bool:
    """Whether nothing reads a scalar before it is assigned anew."""
    for statement in later:
        if isinstance(statement, Mark):  # what comes next is not only what stands next
            return False
        uses = first_uses(statement)
        if variable in uses:
            return uses[variable]
    return variable.role in SCRATCH


class Uses:
    """What comes next of each variable, for a pass that goes backward: `dead_after` without asking all that follows."""

    def __init__(self) -> None:
        self._writes: dict[Variable, bool] = {}
        self._marked = False

    def before(self, statement: Statement) -> None:
        """Go before a statement."""
        if isinstance(statement, Mark):  # what comes next is not only what stands next
            self._writes, self._marked = {}, True
        else:
            self._writes.update(first_uses(statement))

    def dead(self, variable: Variable) -> bool:
        """Whether nothing reads a scalar before it is assigned anew."""
        return self._writes.get(variable, variable.role in SCRATCH and not self._marked)


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


def _of(statement: Assign | Require | Mark, visits: range) -> list[Access]:
    found = [_access(ref, False, visits) for ref in sorted(refs_in(statement.value), key=lambda r: r.name)]
    if isinstance(statement, Assign):
        found.append(_access(statement.target, True, visits))
    return found


def _access(ref: Ref, writes: bool, visits: range) -> Access:
    if ref.variable.length is None:
        return Access(ref, writes, 0, 0)
    if ref.offset is None:
        return Access(ref, writes, ref.entry or 0, ref.entry or 0)
    return Access(ref, writes, visits[0] + ref.offset, visits[-1] + ref.offset, visits.step)


def _set_before_use(loop: Loop, scalar: Variable) -> bool:
    return first_uses(loop).get(scalar, False)


def _scalars_apart(first: Loop, second: Loop) -> bool:
    """Whether scalars that either loop writes are its own, set anew at every station before they are read."""
    for variable, used in uses_of(first).items():
        if variable.length is not None:
            continue
        if _set_before_use(first, variable) and _set_before_use(second, variable):
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


def read_before_written(routine: Routine) -> Variable | None:
    """Return a variable of the routine's own making that it reads before it has written any of it, or None.

    Such a routine reads what happens to be in memory: no backend can be right about it.
    """
    own = {v for v in routine.written() if v.role in SCRATCH or v.role in (Role.COEFFICIENT, Role.OUTPUT)}
    own |= {v for v in routine.read() if v.role in SCRATCH}
    for statement in routine.statements():
        for access in accesses(statement):
            if access.writes:
                own.discard(access.variable)
            elif access.variable in own:
                return access.variable
    return None
