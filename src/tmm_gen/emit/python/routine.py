"""What function bodies of NumPy and of CasADi have in common."""

from __future__ import annotations

from tmm_gen.emit.python.names import Names
from tmm_gen.program.statements import Assign, Loop, Order, Routine
from tmm_gen.program.variables import Role, Variable


class PythonRoutine:
    """The body of one generated function.

    Parameters
    ----------
    routine : Routine
        What to print.
    names : Names
        Names of variables inside functions.
    stations : int
        Number of links, which the generated module calls ``STATIONS``.
    """

    def __init__(self, routine: Routine, names: Names, stations: int) -> None:
        self._routine = routine
        self._names = names
        self._stations = stations
        self._types = ScratchTypes()

    def _range(self, loop: Loop) -> str:
        stop = self.count(loop.stop)
        stations = f"range({stop})" if loop.start == 0 else f"range({loop.start}, {stop})"
        if loop.stride > 1:
            stations = f"range({loop.start}, {stop}, {loop.stride})"
        return f"reversed({stations})" if loop.order is Order.INWARD else stations

    def count(self, number: int) -> str:
        """Write a number of stations or nodes by what it means."""
        if number == self._stations:
            return "STATIONS"
        return "STATIONS + 1" if number == self._stations + 1 else str(number)


class ScratchTypes:
    """Says at which assignments of a function a scratch scalar needs an annotation."""

    def __init__(self) -> None:
        self._declared: set[Variable] = set()

    def annotation(self, statement: Assign) -> str:
        """Return what follows the target: a number now may be an array or a symbol at the next station."""
        variable = statement.target.variable
        if variable.role not in (Role.LOCAL, Role.OUTPUT) or variable in self._declared:
            return ""
        self._declared.add(variable)
        return ": Any" if statement.value.is_number else ""
