"""Variables a linearised step keeps for its tangents: only what takes arithmetic, and nothing twice."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count

import sympy as sp

from tmm_gen.program.statements import Assign
from tmm_gen.program.variables import Ref, Role, Variable


class Point:
    """Collects what is kept in one sweep of one stage.

    Parameters
    ----------
    stations : int
        Number of links.
    sweeps : int
        How many sweeps a step has in all: names are numbered where there are several.
    sweep : int
        Which of them this is, from 1.
    """

    def __init__(self, stations: int, sweeps: int, sweep: int) -> None:
        self._stations = stations
        self._suffix = f"_{sweep}" if sweeps > 1 else ""
        self._kept: dict[sp.Expr, Ref] = {}
        self._unnamed: Iterator[int] = count(1)

    def at_station(self, name: str, value: sp.Expr, doc: str, unit: str = "1") -> sp.Expr:
        """Return what stands for a value of the loop's station: itself, what is kept of it, or its opposite."""
        return self._keep(name, value, doc, unit, self._stations)

    def scalar(self, name: str, value: sp.Expr, doc: str, unit: str = "1") -> sp.Expr:
        """Return what stands for a value there is once."""
        return self._keep(name, value, doc, unit, None)

    def assignments(self, of: tuple[sp.Expr, ...] = ()) -> tuple[Assign, ...]:
        """Return the statements that keep the values of some stand-ins, in the order they were asked for."""
        wanted = {ref for expression in of for ref in expression.free_symbols}
        return tuple(Assign(ref, value) for value, ref in self._kept.items() if not of or ref in wanted)

    @property
    def variables(self) -> tuple[Variable, ...]:
        """What is kept."""
        return tuple(ref.variable for ref in self._kept.values())

    def _keep(self, name: str, value: sp.Expr, doc: str, unit: str, length: int | None) -> sp.Expr:
        value = sp.sympify(value)
        if all(isinstance(s, Ref) and s.variable.role.bound_at_prepare for s in value.free_symbols) and (
            value.is_Atom
        ):
            return value
        if value in self._kept:
            return self._kept[value]
        if -value in self._kept:
            return -self._kept[-value]
        self._kept[value] = Variable(name + self._suffix, Role.POINT, length, doc, unit).at()
        return self._kept[value]
