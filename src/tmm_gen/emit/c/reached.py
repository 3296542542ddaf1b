"""Tangents of arms in space leave out stations that a change has not reached yet.

Where a direction begins at one joint, links within it do not move, and factors of the joints beyond it stay. So what
follows a station's own angle or rate alone, by recursion, begins where one of these changes. Of a walk that does more,
the part that follows angles alone comes first, by itself: it is that of the factors, which rates and torques do not
reach at all. Values stay the same bit for bit.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Set
from dataclasses import dataclass, replace

import sympy as sp

from tmm_gen.program.count import count_expression
from tmm_gen.program.passes.accesses import first_uses
from tmm_gen.program.statements import Assign, Loop, Order, Routine, Section, Statement
from tmm_gen.program.variables import SCRATCH, Ref, Role, Variable, refs_in

MOST_FOLLOWED = 2
"""Arrays of which it is worth asking at every station whether they change."""
_CHANGING = SCRATCH | {Role.TANGENT, Role.INPUT_TANGENT}


@dataclass(frozen=True)
class Reached(Section):
    """Loops over stations that change nothing until something they follow does.

    Parameters
    ----------
    follows : tuple of Variable
        Arrays: at stations visited before one changes, all that the loops set is zero.
    """

    follows: tuple[Variable, ...] = ()


def where_reached(routine: Routine, stations: int) -> Routine:
    """Return a lowered tangent whose recursions begin where what they follow changes.

    Parameters
    ----------
    routine : Routine
        As loops over stations; each of its values is linear in changes.
    stations : int
        Of the arm.
    """
    carried = {
        variable
        for statement in routine.statements()
        for variable, first in first_uses(statement).items()
        if variable.role is Role.LOCAL and not (first and isinstance(statement, Loop))
    }
    own: set[Variable] = {v for v in routine.read() if v.role is Role.TANGENT}
    sections: list[Section] = []
    for section in routine.sections:
        found = _Recursion(section, own, carried)
        sections += found.parts(stations)
        _keep_own(section, own)
    return replace(routine, sections=tuple(sections))


def _keep_own(section: Section, own: set[Variable]) -> None:
    """Note which arrays change with their station's own motion alone."""
    for assign in _assigns(section.statements):
        target, read = assign.target, _changing(assign)
        if target.variable.role is not Role.WORK:
            continue
        if all(r.variable in own and r.offset == target.offset for r in read) and target.offset is not None:
            own.add(target.variable)
        elif not all(r.variable in own or r.variable.role is Role.INPUT_TANGENT for r in read) or not read:
            own.discard(target.variable)


def _assigns(statements: tuple[Statement, ...]) -> Iterator[Assign]:
    for statement in statements:
        for inner in statement.body if isinstance(statement, Loop) else (statement,):
            if isinstance(inner, Assign):
                yield inner


def _changing(assign: Assign) -> list[Ref]:
    return [ref for ref in refs_in(assign.value) if ref.variable.role in _CHANGING]


class _Recursion:
    """A section, and what each of its variables follows from outside.

    Parameters
    ----------
    section : Section
        Of a tangent.
    own : set of Variable
        Arrays that change with their station's own motion alone.
    carried : set of Variable
        Scalars that are handed on from station to station.
    """

    def __init__(self, section: Section, own: Set[Variable], carried: Set[Variable]) -> None:
        self._section, self._own, self._carried = section, frozenset(own), carried
        self._written = {a.target.variable for a in _assigns(section.statements)}
        self._follows: dict[Variable, set[Variable]] = {v: set() for v in self._written}
        self._find()

    def parts(self, stations: int) -> list[Section]:
        """Return the section, or what of it begins where something changes, and what is left."""
        loops = all(isinstance(s, Loop) for s in self._section.statements)
        if not loops or not self._written & self._carried:
            return [self._section]
        everything = set().union(*self._follows.values())
        if self._may(everything):
            return self._beginning(self._section, everything, stations)
        for array in sorted(everything & self._own, key=lambda v: v.name):
            first = {v for v, follows in self._follows.items() if follows <= {array}}
            if self._stands_alone(first):
                return self._apart(array, first, stations)
        return [self._section]

    def _find(self) -> None:
        """Follow changes through the section, round after round until nothing is new."""
        seen: set[Variable] = set()
        outside: dict[Variable, set[Variable]] = {}
        for assign in _assigns(self._section.statements):
            for ref in _changing(assign):
                if ref.variable not in seen:
                    outside.setdefault(assign.target.variable, set()).add(ref.variable)
            seen.add(assign.target.variable)
        for variable, found in outside.items():
            self._follows[variable] |= found
        while True:
            before = sum(map(len, self._follows.values()))
            for assign in _assigns(self._section.statements):
                for ref in _changing(assign):
                    self._follows[assign.target.variable] |= self._follows.get(ref.variable, {ref.variable})
            if sum(map(len, self._follows.values())) == before:
                return

    def _may(self, follows: Set[Variable]) -> bool:
        """Whether a recursion that follows these may begin late: each is a station's own, and read there alone."""
        few = 0 < len(follows) <= MOST_FOLLOWED and follows <= self._own and not follows & self._written
        return few and all(
            ref.offset is not None and 0 <= ref.offset < loop.stride
            for loop in self._section.statements
            if isinstance(loop, Loop)
            for inner in loop.body
            for ref in refs_in(inner.value)
            if ref.variable in follows
        )

    def _stands_alone(self, first: Set[Variable]) -> bool:
        """Whether a part has a recursion, is most of the work, and hands on no scalars to what is left."""
        if not first & self._carried:
            return False
        mine: list[Assign] = []
        rest: list[Assign] = []
        for assign in _assigns(self._section.statements):
            (mine if assign.target.variable in first else rest).append(assign)
        handed = {r.variable for a in rest for r in _changing(a)} & first
        follows = set().union(*(self._follows[v] for v in first))
        if any(v.length is None for v in handed) or not self._may(follows):
            return False
        cost = [sum(count_expression(a.value).total for a in part) for part in (mine, rest)]
        return cost[0] > cost[1]

    def _apart(self, array: Variable, first: Set[Variable], stations: int) -> list[Section]:
        title = self._section.title
        what = array.name.removeprefix("d_").replace("_", " ")
        mine = _of(self._section, lambda a: a.target.variable in first)
        rest = _of(self._section, lambda a: a.target.variable not in first)
        begin = self._beginning(
            replace(mine, title=f"what follows the {what} alone, of: {title}"), {array}, stations
        )
        return [*begin, replace(rest, title=f"the rest of it: {title}")]

    def _beginning(self, section: Section, follows: Set[Variable], stations: int) -> list[Section]:
        """Return what sets a recursion's variables to zero, and the recursion."""
        written = sorted({a.target.variable for a in _assigns(section.statements)}, key=lambda v: v.name)
        zero = sp.Integer(0)
        clear: list[Statement] = [Assign(v.ref, zero) for v in written if v in self._carried]
        arrays = tuple(Assign(v.at(), zero) for v in written if v.length is not None)
        if arrays:
            clear.append(Loop(Order.OUTWARD, 0, stations, arrays))
        ordered = tuple(sorted(follows, key=lambda v: v.name))
        return [
            Section("nothing has changed so far", tuple(clear)),
            Reached(section.title, section.statements, ordered),
        ]


def _of(section: Section, keep: Callable[[Assign], bool]) -> Section:
    """Return a section of loops with some of its assignments."""
    found: list[Statement] = []
    for loop in section.statements:
        assert isinstance(loop, Loop)
        body = tuple(s for s in loop.body if isinstance(s, Assign) and keep(s))
        if body:
            found.append(replace(loop, body=body))
    return replace(section, statements=tuple(found))
