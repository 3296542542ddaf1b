"""Drop what is always zero: what starts as zero and is handed on as zero, from station to station and loop to loop.

Where all joints turn about one axis, nothing ever turns about the two others, and no station's equations show that by
themselves: it follows from what the base hands on.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import sympy as sp

from tmm_gen.program.statements import Assign, Loop, Repeat, Require, Routine, Section, Statement, Until
from tmm_gen.program.variables import SCRATCH, Ref, Role, Variable, refs_in

Zeros = frozenset[Variable]
"""Scratch scalars that are zero at a point of a routine; arrays that are zero wherever they have been set."""


def without_zeros(routine: Routine) -> Routine:
    """Return the routine with zeros in place of scratch that is always zero where it is read."""
    statements = list(routine.statements())
    walk = _Walk({v for v in routine.written() if v.role is Role.WORK})
    while True:
        assumed = len(walk.arrays)
        written = walk.through(statements, frozenset())[1]
        if len(walk.arrays) == assumed:
            break
    sections: list[Section] = []
    for section in routine.sections:
        count = len(section.statements)
        sections.append(replace(section, statements=tuple(written[:count])))
        written = written[count:]
    return replace(routine, sections=tuple(sections))


class _Walk:
    """Follows what is zero through statements in the order of execution.

    Parameters
    ----------
    arrays : set of Variable
        Assumed to be zero wherever they have been set; those of which that turns out not to be true leave it, and what
        was found before is to be found again.
    """

    def __init__(self, arrays: set[Variable]) -> None:
        self.arrays = arrays

    def through(self, statements: Sequence[Statement], zeros: Zeros) -> tuple[Zeros, list[Statement]]:
        """Return what is zero behind statements, and these with zeros in place of what is zero."""
        found: list[Statement] = []
        at = 0
        while at < len(statements):
            statement = statements[at]
            if isinstance(statement, Repeat):
                end = next(k for k in range(at, len(statements)) if isinstance(statements[k], Until))
                zeros, body = self._again(statements[at + 1 : end + 1], zeros)
                found += [statement, *body]
                at = end + 1
                continue
            if isinstance(statement, Loop):
                once = len(statement.visits) == 1
                zeros, body = (self.through if once else self._again)(statement.body, zeros)
                same = all(new is old for new, old in zip(body, statement.body, strict=True))
                found.append(statement if same else replace(statement, body=tuple(body)))  # type: ignore[arg-type]
            else:
                zeros, changed = self._one(statement, zeros)
                found.append(changed)
            at += 1
        return zeros, found

    def _again(self, body: Sequence[Statement], zeros: Zeros) -> tuple[Zeros, list[Statement]]:
        """Return what is zero behind what is done again and again, at least once."""
        while True:
            behind, changed = self.through(body, zeros)
            if zeros <= behind:
                return behind, changed
            zeros &= behind

    def _one(self, statement: Assign | Require | Until, zeros: Zeros) -> tuple[Zeros, Statement]:
        nothing = {r: sp.Integer(0) for r in refs_in(statement.value) if self._zero(r, zeros)}
        changed = replace(statement, value=statement.value.xreplace(nothing)) if nothing else statement
        if not isinstance(statement, Assign) or statement.target.variable.role not in SCRATCH:
            return zeros, changed
        variable = statement.target.variable
        if variable.role is Role.WORK:
            if changed.value != 0:
                self.arrays.discard(variable)
            return zeros, changed
        return (zeros | {variable} if changed.value == 0 else zeros - {variable}), changed

    def _zero(self, ref: Ref, zeros: Zeros) -> bool:
        return ref.variable in zeros or ref.variable in self.arrays
