"""Looking into statements: assignments and what is read, inside of loops and outside."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from tmm_gen.program.statements import Assign, Loop, Statement
from tmm_gen.program.variables import Ref, refs_in


def inside(statement: Statement) -> tuple[Any, ...]:
    """Return what a loop repeats; of anything else, itself."""
    return statement.body if isinstance(statement, Loop) else (statement,)


def assigns_of(statements: Iterable[Statement]) -> Iterable[Assign]:
    """Yield all assignments in order."""
    for statement in statements:
        for inner in inside(statement):
            if isinstance(inner, Assign):
                yield inner


def read_by(statement: Statement) -> set[Ref]:
    """Return all that a statement reads."""
    return {ref for inner in inside(statement) for ref in refs_in(inner.value)}
