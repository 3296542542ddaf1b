"""Where scratch scalars are declared: as late and as narrowly as their use allows."""

from __future__ import annotations

from dataclasses import dataclass, field

from tmm_gen.program.passes.accesses import accesses
from tmm_gen.program.passes.lifetimes import carried_scalars, written_scalars
from tmm_gen.program.statements import Assign, Loop, Mark, Routine, Statement
from tmm_gen.program.variables import Role, Variable


@dataclass(frozen=True)
class Placement:
    """Declarations of a routine's scratch scalars.

    Parameters
    ----------
    at_top : tuple of Variable
        Declared before the first statement, without a value.
    constant : dict from int to bool
        By the position of an assignment among :meth:`Routine.assignments`: those that declare their target,
        and whether it never changes afterwards.
    """

    at_top: tuple[Variable, ...] = ()
    constant: dict[int, bool] = field(default_factory=dict)


def place_scalars(routine: Routine) -> Placement:
    """Decide where each scratch scalar of a routine is declared."""
    statements = tuple(routine.statements())
    settings = _settings(statements)
    repeats = any(isinstance(s, Mark) for s in statements)  # what is declared in there is not known behind
    at_top: list[Variable] = []
    constant: dict[int, bool] = {}
    users_of: dict[Variable, list[int]] = {}
    for place, statement in enumerate(statements):
        for used in dict.fromkeys(a.variable for a in accesses(statement)):
            users_of.setdefault(used, []).append(place)
    set_at: dict[tuple[int, Variable], list[int]] = {}
    for at, place, target in settings:
        set_at.setdefault((place, target), []).append(at)
    for variable in routine.variables(Role.LOCAL):
        users = users_of.get(variable, [])
        by_user = {user: set_at.get((user, variable), []) for user in users}
        if all(_private(statements[user], variable) for user in users):
            constant |= {found[0]: len(found) == 1 for found in by_user.values()}
        elif isinstance(statements[users[0]], Assign) and not repeats:
            constant[by_user[users[0]][0]] = sum(map(len, by_user.values())) == 1
        else:
            at_top.append(variable)
    return Placement(tuple(at_top), constant)


def _settings(statements: tuple[Statement, ...]) -> list[tuple[int, int, Variable]]:
    """Return every assignment's position, top-level statement and target."""
    targets = [
        (place, inner.target.variable)
        for place, statement in enumerate(statements)
        for inner in (statement.body if isinstance(statement, Loop) else (statement,))
        if isinstance(inner, Assign)
    ]
    return [(at, place, target) for at, (place, target) in enumerate(targets)]


def _private(statement: Statement, variable: Variable) -> bool:
    """Whether a statement is a loop that sets a scalar at every station before it reads it."""
    if not isinstance(statement, Loop) or variable in carried_scalars(statement):
        return False
    return variable in written_scalars(statement)
