"""What statements read and write, and at which stations."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

from tmm_gen.program.statements import Assign, Loop, Mark, Require, Routine, Statement
from tmm_gen.program.variables import Ref, Variable, refs_in


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


@lru_cache(maxsize=1 << 12)
def first_uses(statement: Statement) -> dict[Variable, bool]:
    """Return whether the first use of each variable writes it."""
    found: dict[Variable, bool] = {}
    for access in accesses(statement):
        found.setdefault(access.variable, access.writes)
    return found


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
