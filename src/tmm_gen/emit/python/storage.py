"""How a routine uses arrays and scratch scalars: whether a loop may become whole-array statements."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from tmm_gen.program.statements import Assign, Loop, Mark, Require, Routine, Statement
from tmm_gen.program.variables import Ref, Role, Variable, refs_in


def vectorised(routine: Routine) -> frozenset[int]:
    """Return the positions, among a routine's statements, of loops to be done for all stations at once.

    Such a loop is parallel, and nothing after it reads a scratch scalar that its last station left behind.
    """
    statements = tuple(routine.statements())
    return frozenset(
        place
        for place, statement in enumerate(statements)
        if isinstance(statement, Loop)
        and statement.parallel
        and not any(_outlives(inner) for inner in statement.body)
        and not any(_reads_first(scalar, statements[place + 1 :]) for scalar in _scalars_written(statement))
    )


def rebound(routine: Routine, whole: frozenset[int]) -> frozenset[Variable]:
    """Return the arrays that are only ever assigned as a whole, by loops done for all stations at once."""
    written: dict[Variable, bool] = {}
    for place, statement in enumerate(routine.statements()):
        scalars: set[Variable] = set()  # scratch of this loop that differs between stations
        for inner in _body(statement):
            if not isinstance(inner, Assign):
                continue
            target = inner.target.variable
            varies = any(r.offset is not None or r.variable in scalars for r in refs_in(inner.value))
            if target.length is None:
                if varies and place in whole:
                    scalars.add(target)
                continue
            in_one = place in whole and isinstance(statement, Loop) and _covers(statement, inner.target)
            written[target] = written.get(target, True) and varies and in_one
    return frozenset(variable for variable, always in written.items() if always)


def written_later(routine: Routine, place: int) -> frozenset[Variable]:
    """Return the variables that a statement, or any after it, assigns."""
    statements = tuple(routine.statements())[place:]
    return frozenset(
        inner.target.variable for s in statements for inner in _body(s) if isinstance(inner, Assign)
    )


def _covers(loop: Loop, target: Ref) -> bool:
    length = target.variable.length
    offset = target.offset
    return offset is not None and loop.start + offset == 0 and loop.stop + offset == length


def _scalars_written(loop: Loop) -> list[Variable]:
    return [
        s.target.variable for s in loop.body if isinstance(s, Assign) and s.target.variable.length is None
    ]


def _outlives(statement: Assign | Require) -> bool:
    """Whether a statement sets a scalar that is no scratch: a loop over all stations would make an array of it."""
    if not isinstance(statement, Assign):
        return False
    variable = statement.target.variable
    return variable.length is None and variable.role not in (Role.LOCAL, Role.COEFFICIENT)


def _reads_first(scalar: Variable, statements: Sequence[Statement]) -> bool:
    """Return whether statements read a scalar before they assign it."""
    for statement in statements:
        for inner in _body(statement):
            if any(ref.variable == scalar for ref in refs_in(inner.value)):
                return True
            if isinstance(inner, Assign) and inner.target.variable == scalar:
                return False
    return False


def _body(statement: Statement) -> Iterator[Assign | Require | Mark]:
    if isinstance(statement, Loop):
        yield from statement.body
    else:
        yield statement
