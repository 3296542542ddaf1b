"""The sweep of a step that also keeps its point of linearisation and its factors."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import Any

import sympy as sp

from tmm_gen.derive.station.frame import (
    predicted_force,
)
from tmm_gen.derive.station.lets import composed
from tmm_gen.derive.station.tangent import SOLVED, beyond, solved_force, solved_node
from tmm_gen.program.arm.at_places import BASE
from tmm_gen.program.arm.base import Balance, base_change
from tmm_gen.program.arm.binding import Binding
from tmm_gen.program.arm.branches import resumed
from tmm_gen.program.sensitivities.kept import kept_symbols, solved_acceleration
from tmm_gen.program.sensitivities.point import Point
from tmm_gen.program.sensitivities.walks import TangentableWalks
from tmm_gen.program.statements import Assign, Loop, Order, Section, Statement
from tmm_gen.program.variables import Variable

ZERO = sp.Integer(0)


class LinearisedWalks(TangentableWalks):
    """The same walks, which also keep their point of linearisation and their factors."""

    points: tuple[Point, ...] = ()
    """Where each sweep of the step keeps them, in order."""

    def plain(self) -> list[Section]:
        """Return the sweep, and what is kept of it."""
        point, self.points = self.points[0], self.points[1:]
        kept = kept_symbols(self.tangents())
        of_base = self._balance().kept if self.layout.row.floats else {}
        title = "what tangents need: motion and forces as solved, slopes, factors"
        sections = [*super().plain(), Section(title, tuple(self._keep()))]
        return [
            replace(s, statements=tuple(y for x in s.statements for y in _keeping(x, kept, of_base, point)))
            for s in sections
        ]

    def _balance(self) -> Balance:
        return self._named_balance()

    def _keep(self) -> list[Statement]:
        """Walk out and in with motion and forces as solved."""
        row, n, here = self.layout.row, self.layout.stations, self.at_station()
        carried = [c for c in self.frame.coordinates if not c.integrated]
        solved = {c.name: solved_acceleration(c.name, n) for c in carried}
        values = dict(here.values)
        for c in carried:
            values[solved_node(c)] = solved[c.name].at(0)
            values[beyond(solved_node(c))] = solved[c.name].at(1)
        values[SOLVED] = self.solved.at()
        keep = Binding(self.scratch, values)
        moved = {c.name: self.scratch.ref(f"solved_change_{c.name}") for c in carried}
        at_base = {c.name: base_change(c) if row.floats else ZERO for c in carried}
        found: list[Statement] = [Assign(ref, at_base[name]) for name, ref in moved.items()]
        found += [
            Assign(solved[c.name].entry(BASE), self.nodes[c.name].entry(BASE) + at_base[c.name])
            for c in carried
        ]
        tangents = self.tangents()
        for start, stop, _, out, _ in tangents:
            body: list[Assign] = []
            for i, c in enumerate(self.frame.coordinates):
                if c.integrated:
                    continue
                swing = sp.Add(*(p.swings.get(i, ZERO) for p in out.passed))
                body.append(Assign(moved[c.name], moved[c.name] + here.value(swing) * self.solved.at()))
                body.append(Assign(solved[c.name].at(1), self.nodes[c.name].at(1) + moved[c.name]))
            found += resumed(
                row, start, {ref: partial(_moved, solved[c], self.nodes[c]) for c, ref in moved.items()}
            )
            found.append(self.over(Order.OUTWARD, start, stop, body if out.passed else ()))
        tip_values = dict(self.at_node(n).values) | {solved_node(c): solved[c.name].entry(n) for c in carried}
        last = self.solved.entry(n - 1)
        at_tip = Binding(self.scratch, tip_values | {SOLVED: last})
        left = composed(self._tail_tangent().keep_in)
        forces = [s for c in carried for s in (solved_force(c), predicted_force(c))]
        at_end = {s: at_tip.value(left.get(s, s).subs(dict.fromkeys(forces, 0))) for s in forces}
        lines = [[*tangent.keep_out, *tangent.keep_in] for *_, tangent in tangents]
        return [*found, *self._walk_in(at_end, [keep.lines(x) for x in lines])]


def _moved(solved: Variable, predicted: Variable, node: int) -> sp.Expr:
    """Return the change of a node's acceleration by what the sweep has found."""
    return solved.entry(node) - predicted.entry(node)


def _keeping(
    statement: Statement,
    kept: Mapping[str, tuple[str, str]],
    of_base: Mapping[str, tuple[str, str]],
    point: Point,
) -> list[Any]:
    """Return a statement followed by the keeping of what it sets, at each station or once."""

    def followed(inner: Any) -> list[Any]:
        if not isinstance(inner, Assign):
            return [inner]
        name = inner.target.variable.name
        if name == "hub_pivot":
            return [
                inner,
                Assign(point.scalar("hub_inverse_pivot", *kept["hub_inverse_pivot"]), 1 / inner.target),
            ]
        if name in of_base:
            return [inner, Assign(point.scalar(name, *of_base[name]), inner.target)]
        if name not in kept:
            return [inner]
        return [inner, Assign(point.at_station(name, *kept[name]), inner.target)]

    if isinstance(statement, Loop):
        return [replace(statement, body=tuple(x for inner in statement.body for x in followed(inner)))]
    return followed(statement)
