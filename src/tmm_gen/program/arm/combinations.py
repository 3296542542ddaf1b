"""Combinations of parameters that a sweep needs at each station: masses that meet at a node, inertias left over."""

from __future__ import annotations

import sympy as sp

from tmm_gen.program.arm.layout import Layout
from tmm_gen.program.statements import Assign, Loop, Order, Section, Statement
from tmm_gen.program.variables import Ref, Role, Variable, refs_in
from tmm_gen.row.row import Combination


class Combinations:
    """Variables for a row's combinations, and the statements that compute them.

    Parameters
    ----------
    layout : Layout
        The row's variables.
    role : Role
        Kept in the model, or scratch of the start.
    """

    def __init__(self, layout: Layout, role: Role) -> None:
        self._layout = layout
        self.variables: dict[str, Variable] = {}
        self._statements: list[Statement] = []
        for combination in layout.row.combinations:
            self._add(combination, role)

    @property
    def section(self) -> Section:
        """What computes them."""
        masses = len(self._layout.row.coordinates) > 1
        title = "masses at the nodes between links, and what they leave over" if masses else "how gears turn"
        return Section(title, tuple(self._statements))

    def _add(self, found: Combination, role: Role) -> None:
        n = self._layout.stations
        if found.at_base:
            variable = Variable(
                found.name, role if role is not Role.WORK else Role.LOCAL, None, found.doc, found.unit
            )
            self.variables[found.name] = variable
            shares = (self._entry(found.beyond, k) for k in self._meeting(-1))
            self._statements.append(Assign(variable.ref, sp.Add(self._entry(found.own, 0), *shares)))
            return
        own, beyond = self._at(found.own, 0), self._at(found.beyond, 1)
        alike = beyond == 0 and found.last == 0 and not any(r.offset is not None for r in refs_in(own))
        kept = role if role is not Role.WORK or not alike else Role.LOCAL
        variable = Variable(found.name, kept, None if alike else n, found.doc, found.unit)
        self.variables[found.name] = variable
        if alike:
            self._statements.append(Assign(variable.ref, own))
            return
        if beyond == 0:
            self._statements.append(Loop(Order.OUTWARD, 0, n, (Assign(variable.at(), own),)))
            return
        if n > 1:
            self._statements.append(Loop(Order.OUTWARD, 0, n - 1, (Assign(variable.at(), own + beyond),)))
        for index in self._otherwise():
            value = self._entry(found.own, index)
            value += sp.Add(*(self._entry(found.beyond, k) for k in self._meeting(index)))
            value += self._entry(found.last, index) if index == n - 1 else 0
            self._statements.append(Assign(variable.entry(index), value))

    def _otherwise(self) -> list[int]:
        """Return the stations that do not carry the next one alone, the last above all."""
        row, n = self._layout.row, self._layout.stations
        rooted = [k for k, host in enumerate(row.hosts) if host != k - 1]
        others = {*(k - 1 for k in rooted), *(row.hosts[k] for k in rooted), *map(row.host, row.shafts)}
        return sorted({n - 1, *others} - {-1})

    def _meeting(self, index: int) -> list[int]:
        """Return the stations that begin where one ends: beyond a shaft, which has no length, the one it turns."""
        row = self._layout.row
        return [k + 1 if k in row.shafts else k for k in row.carried(index)]

    def _at(self, value: sp.Expr, offset: int) -> sp.Expr:
        return _bound(value, {s: v.at(offset) for s, v in self._symbols().items()})

    def _entry(self, value: sp.Expr, index: int) -> sp.Expr:
        return _bound(value, {s: v.entry(index) for s, v in self._symbols().items()})

    def _symbols(self) -> dict[sp.Symbol, Variable]:
        return {sp.Symbol(name): variable for name, variable in self._layout.parameters.items()}


def _bound(value: sp.Expr, refs: dict[sp.Symbol, Ref]) -> sp.Expr:
    return sp.sympify(value).xreplace(refs)
