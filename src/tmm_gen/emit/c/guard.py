"""Which values to look at so that no NaN stays in the state unnoticed.

NaN passes through every operation, so one value that depends on the whole state tells about all of it. Which
value that is follows from the program: walked backward from a number of the new state, it says on which numbers of
the old one that depends. If on all that enter an operation, it will do.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from tmm_gen.program.statements import Assign, Loop, Mark, Order, Require, Routine
from tmm_gen.program.variables import Ref, Role, Variable, refs_in

_Number = int
"""A variable and which of its elements, as one integer: there may be very many."""


class _Visit(NamedTuple):
    """A statement as it is executed once: what it writes, if anything, and what it reads."""

    target: _Number | None
    reads: list[_Number]
    copies: bool


def telling_value(routine: Routine, state: tuple[Variable, ...]) -> Ref | None:
    """Return a number of the new state that is NaN whenever anything a step computes with is NaN.

    Takes time in proportion to the stations, of which there may be very many.

    Parameters
    ----------
    routine : Routine
        A step.
    state : tuple of Variable
        The program's state.

    Returns
    -------
    Ref or None
        An end of an array or a scalar; None where no single number tells.
    """
    numbers = _Numbers()
    visits = list(_visits(routine, numbers))
    needed = _computed_with(visits, {numbers.of(v, k) for v in state for k in range(v.length or 1)})
    for variable in reversed(state):
        for entry in (0,) if variable.length is None else (variable.length - 1, 0):
            if needed <= _reached(visits, numbers.of(variable, entry)):
                return variable.entry(entry)
    return None


class _Numbers:
    """Gives each variable a range of integers, one for each of its elements."""

    def __init__(self) -> None:
        self._first: dict[Variable, int] = {}
        self._next = 0

    def of(self, variable: Variable, element: int) -> _Number:
        first = self._first.get(variable)
        if first is None:
            first = self._first[variable] = self._next
            self._next += (variable.length or 0) + 1
        return first + element

    def place(self, ref: Ref) -> tuple[int, int]:
        """Return ``first, factor`` with ``first + factor * j`` the number at station ``j``."""
        if ref.variable.length is None or ref.variable.role is Role.LOCAL:
            return self.of(ref.variable, 0), 0
        if ref.offset is None:
            return self.of(ref.variable, ref.entry or 0), 0
        return self.of(ref.variable, 0) + ref.offset, 1


def _visits(routine: Routine, numbers: _Numbers) -> Iterator[_Visit]:
    """Yield the statements of a routine as they are executed."""
    for statement in routine.statements():
        if isinstance(statement, Loop):
            body = [_parts(inner, numbers) for inner in statement.body]
            stations = range(statement.start, statement.stop)
            for j in reversed(stations) if statement.order is Order.INWARD else stations:
                for parts in body:
                    yield _visit(parts, j)
        else:
            yield _visit(_parts(statement, numbers), 0)


_Place = tuple[int, int]
_Parts = tuple[_Place | None, list[_Place], bool]


def _parts(statement: Assign | Require | Mark, numbers: _Numbers) -> _Parts:
    target = numbers.place(statement.target) if isinstance(statement, Assign) else None
    reads = [numbers.place(ref) for ref in refs_in(statement.value)]
    return target, reads, isinstance(statement.value, Ref)


def _visit(parts: _Parts, j: int) -> _Visit:
    target, reads, copies = parts
    at = [first + factor * j for first, factor in reads]
    return _Visit(None if target is None else target[0] + target[1] * j, at, copies)


def _computed_with(visits: list[_Visit], state: set[_Number]) -> set[_Number]:
    """Return the numbers of the old state that enter an operation, perhaps as copies."""
    source: dict[_Number, _Number] = {number: number for number in state}
    needed: set[_Number] = set()
    for target, reads, copies in visits:
        if copies and target is not None:
            if reads[0] in source:
                source[target] = source[reads[0]]
            else:
                source.pop(target, None)
            continue
        needed.update(source[read] for read in reads if read in source)
        if target is not None:
            source.pop(target, None)
    return needed


def _reached(visits: list[_Visit], number: _Number) -> set[_Number]:
    """Return what a number depends on when all is done, as it is before anything is done."""
    live = {number}
    for target, reads, _ in reversed(visits):
        if target in live:
            live.remove(target)
            live.update(reads)
    return live
