"""How long values are needed: scalars that one station hands to the next, what is read no more, what is never set."""

from __future__ import annotations

from functools import lru_cache

from tmm_gen.program.passes.accesses import accesses, first_uses
from tmm_gen.program.statements import Assign, Loop, Mark, Routine, Statement
from tmm_gen.program.variables import SCRATCH, Role, Variable


@lru_cache(maxsize=1 << 12)
def written_scalars(loop: Loop) -> frozenset[Variable]:
    """Return the scalars a loop assigns."""
    return frozenset(
        s.target.variable for s in loop.body if isinstance(s, Assign) and s.target.variable.length is None
    )


@lru_cache(maxsize=1 << 12)
def carried_scalars(loop: Loop) -> frozenset[Variable]:
    """Return scalars a loop assigns whose value one station hands to the next."""
    return frozenset(v for v in written_scalars(loop) if not set_before_use(loop, v))


def set_before_use(loop: Loop, scalar: Variable) -> bool:
    """Whether every station assigns a scalar before it reads it."""
    return first_uses(loop).get(scalar, False)


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
