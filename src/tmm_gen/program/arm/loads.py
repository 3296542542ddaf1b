"""Where a row's inputs act, at one stage of a step."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from copy import copy

import sympy as sp

from tmm_gen.derive.integrators.declaration import KINDS, Kind
from tmm_gen.program.arm.layout import Layout
from tmm_gen.program.statements import Assign, Loop, Order, Statement
from tmm_gen.program.variables import Role, Variable
from tmm_gen.row.row import Load


class Loads:
    """Loads by the symbols that stand for them in elements.

    Parameters
    ----------
    layout : Layout
        The row's variables.
    stage : int
        Instant of the step, from 0, at which inputs are read: its stages, and its end where a prescribed base asks.
    inputs : mapping from str to sympy.Expr, optional
        What inputs are by name, where they are not read at one instant.
    """

    def __init__(self, layout: Layout, stage: int = 0, inputs: Mapping[str, sp.Expr] | None = None) -> None:
        self._n = layout.stations
        self._inputs = inputs or {v.name: v.entry(stage) for v in layout.inputs}
        self._loads = layout.row.loads
        names = layout.row.prescribed
        self.prescribed: dict[Kind, sp.Expr] = {
            k: self._inputs[name] for k, name in zip(KINDS, names, strict=bool(names))
        }
        """Motion of a prescribed base."""
        self.values: dict[sp.Symbol, sp.Expr] = {}
        self._fill: dict[sp.Symbol, list[Statement]] = {}
        for load in self._loads:
            self._add(load)

    def filled(self, within: Collection[sp.Symbol]) -> list[Statement]:
        """Return the statements that fill the arrays of those loads on stations that stand among some symbols."""
        return [s for symbol, fill in self._fill.items() if symbol in within for s in fill]

    def filled_besides(self, within: Collection[sp.Symbol]) -> list[Statement]:
        """Return the statements that fill the arrays of all other loads on stations."""
        return [s for symbol, fill in self._fill.items() if symbol not in within for s in fill]

    def standing(self) -> Loads:
        """Return the same loads where their arrays are filled already."""
        found = copy(self)
        found._fill = {}
        return found

    def _add(self, load: Load) -> None:
        if all(index is None for index, _ in load.places):
            self.values[load.symbol] = sp.Add(*(self._acting(load, name) for _, name in load.places))
            return
        array = Variable(load.symbol.name.rstrip("_"), Role.WORK, self._n, load.doc, load.unit)
        self.values[load.symbol] = array.at()
        fill: list[Statement] = [Loop(Order.OUTWARD, 0, self._n, (Assign(array.at(), sp.Integer(0)),))]
        sums: dict[int, sp.Expr] = {}
        for index, name in load.places:
            assert index is not None
            sums[index] = sums.get(index, sp.Integer(0)) + self._acting(load, name)
        fill += [Assign(array.entry(index), value) for index, value in sums.items()]
        self._fill[load.symbol] = fill

    def _acting(self, load: Load, name: str) -> sp.Expr:
        """Return what an input is where it acts."""
        return exactly(load.factors.get(name, 1.0)) * self._inputs[name]


def exactly(value: float) -> sp.Rational:
    """Return a number of a scene as one that no rounding of SymPy's touches."""
    return sp.Rational(*value.as_integer_ratio())
