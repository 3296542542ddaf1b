"""Which values to look at so that no NaN stays in the state unnoticed.

NaN passes through every operation, so one value that depends on the whole state tells about all of it. Which
value that is follows from the program: each number of the old state gets a mark, marks pass through
assignments, and a number of the new state that carries them all will do.
"""

from __future__ import annotations

from dataclasses import dataclass

from tmm_gen.program.statements import Assign, Loop, Order, Require, Routine
from tmm_gen.program.variables import Ref, Role, Variable, refs_in

_Marks = dict[tuple[Variable, int], int]
"""A set of marks, as the bits of an integer, by variable and element."""


def telling_value(routine: Routine, state: tuple[Variable, ...]) -> Ref | None:
    """Return a number of the new state that is NaN whenever anything a step computes with is NaN.

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
    numbers = [(v, k) for v in state for k in range(v.length or 1)]
    marks: _Marks = {number: 1 << bit for bit, number in enumerate(numbers)}
    needed = _spread(routine, marks)
    for variable in reversed(state):
        for entry in (0,) if variable.length is None else (variable.length - 1, 0):
            if marks[variable, entry] & needed == needed:
                return variable.entry(entry)
    return None


@dataclass
class _Walk:
    marks: _Marks
    needed: int = 0

    def visit(self, statement: Assign | Require, j: int) -> None:
        found = 0
        for ref in refs_in(statement.value):
            found |= self.marks.get((ref.variable, _element(ref, j)), 0)
        if not isinstance(statement.value, Ref):
            self.needed |= found
        if isinstance(statement, Assign):
            self.marks[statement.target.variable, _element(statement.target, j)] = found


def _spread(routine: Routine, marks: _Marks) -> int:
    """Pass marks through a routine in place; return those of all that enters an operation."""
    walk = _Walk(marks)
    for statement in routine.statements():
        if isinstance(statement, Loop):
            stations = range(statement.start, statement.stop)
            for j in reversed(stations) if statement.order is Order.INWARD else stations:
                for inner in statement.body:
                    walk.visit(inner, j)
        else:
            walk.visit(statement, 0)
    return walk.needed


def _element(ref: Ref, j: int) -> int:
    if ref.variable.length is None or ref.variable.role is Role.LOCAL:
        return 0
    return (ref.entry or 0) if ref.offset is None else j + ref.offset
