"""The sweep on changes, with the factors that the step has kept."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import sympy as sp

from tmm_gen.derive.station.frame import (
    INNER,
    MOUNT,
    OUTER,
    UNKNOWN,
    node,
    of_shaft,
    predicted_force,
)
from tmm_gen.derive.station.lets import Let, Line, Update, composed
from tmm_gen.derive.station.tangent import beyond, solved_node
from tmm_gen.program.arm.at_places import BASE, hub_unknown
from tmm_gen.program.arm.base import base_acceleration
from tmm_gen.program.arm.binding import Binding
from tmm_gen.program.arm.branches import resumed
from tmm_gen.program.passes.rewrite import map_lines
from tmm_gen.program.sensitivities.kept import kept_symbols, solved_acceleration
from tmm_gen.program.sensitivities.point import Point
from tmm_gen.program.sensitivities.walks import TangentableWalks
from tmm_gen.program.statements import Assign, Order, Section, Statement
from tmm_gen.program.variables import Ref, refs_in

ZERO = sp.Integer(0)
HUB_PIVOT = sp.Symbol("hub_pivot", real=True)


class TangentWalks(TangentableWalks):
    """The walks on changes: factors are known."""

    points: tuple[Point, ...] = ()

    def plain(self) -> list[Section]:
        """Return the sweep on changes."""
        point, self.points = self.points[0], self.points[1:]
        self._tangents = self.tangents()
        kept = {**kept_symbols(self._tangents)}
        if self.layout.row.floats:
            kept |= self._named_balance().kept
        found = [
            Section(
                "accelerations of the nodes, as predicted and as solved but for the unknowns' own changes",
                tuple(self._nodes()),
            ),
            Section("forces of the joints", tuple(self.joint_forces())),
            Section("sweep inward with the factors of the step", tuple(self._forces())),
            Section("the base", tuple(self._base())),
            Section("sweep outward: the change of each station's unknown", tuple(self.answers())),
        ]
        names = {name: point.kept(name) for name in kept}

        def at_point(expression: sp.Expr, _: Ref | None) -> sp.Expr:
            """Read kept values from the point of linearisation."""
            there = {r: names.get(r.variable.name) for r in refs_in(expression)}
            return expression.xreplace({ref: kept for ref, kept in there.items() if kept is not None})

        return [map_lines(section, at_point) for section in found]

    def joint_forces(self) -> list[Statement]:
        """Return the changes of the joints' forces: what is constant in their laws does not change."""
        here = self.at_station()
        loads = {load.symbol for load in self.layout.row.loads}
        changing = {*MOUNT.values(), *INNER.values(), *OUTER.values(), *loads, *map(of_shaft, loads)}
        found: list[Statement] = self.loads.filled(self._driven)
        for start, stop, derived, _, _ in self._tangents:
            each = changing | {let.symbol for let in derived.known}
            lets = [replace(let, value=_varying(let.value, each)) for let in derived.known]
            if lets:
                found.append(self.over(Order.OUTWARD, start, stop, here.lines([*derived.ahead, *lets])))
        return found

    def _nodes(self) -> list[Statement]:
        n, here = self.layout.stations, self.at_station()
        carried = [c for c in self.frame.coordinates if not c.integrated]
        arrays = {
            s: v
            for c in carried
            for s, v in ((node(c), self.nodes[c.name]), (solved_node(c), solved_acceleration(c.name, n)))
        }
        names = {s: self.scratch.ref(s.name) for s in arrays}
        along = Binding(self.scratch, {**here.values, **names, **{beyond(s): r for s, r in names.items()}})
        falls = [base_acceleration(c) if self.layout.row.floats else ZERO for c in carried for _ in range(2)]
        found: list[Statement] = [Assign(names[s], value) for s, value in zip(arrays, falls, strict=True)]
        found += [Assign(v.entry(BASE), value) for v, value in zip(arrays.values(), falls, strict=True)]
        for start, stop, _, _, tangent in self._tangents:
            body = along.lines(tangent.outward)
            body += [Assign(v.at(1), names[s]) for s, v in arrays.items()]
            found += resumed(self.layout.row, start, {names[s]: v.entry for s, v in arrays.items()})
            found.append(self.over(Order.OUTWARD, start, stop, body))
        return found

    def _forces(self) -> list[Statement]:
        n = self.layout.stations
        carried = [c for c in self.frame.coordinates if not c.integrated]
        here = dict(self.at_station().values)
        there = dict(self.at_node(n).values)
        for c in carried:
            array = solved_acceleration(c.name, n)
            here |= {solved_node(c): array.at(0), beyond(solved_node(c)): array.at(1)}
            there |= {solved_node(c): array.entry(n)}
        left = composed(self._tail_tangent().inward)
        symbols = [sp.Symbol(c.force, real=True) for c in self.frame.coordinates]
        symbols += [predicted_force(c) for c in carried]
        at_tip = Binding(self.scratch, there)
        at_end = {s: at_tip.value(left.get(s, s).subs(dict.fromkeys(symbols, 0))) for s in symbols}
        binding = Binding(self.scratch, here)
        lines = [[*_early(derived.lines), *tangent.inward] for *_, derived, _, tangent in self._tangents]
        walk = self._walk_in(at_end, [binding.lines(x) for x in lines])
        return [*self.loads.filled_besides(self._driven), *walk]

    def _base(self) -> list[Statement]:
        if self.layout.row.boundary != "free":
            return self.base()
        here = self.at_node(BASE)
        if self.layout.row.floats:
            balance = self._named_balance()
            return [*here.lines([*balance.forces, *balance.answers]), *self._found_of_base()]
        lines = self._free_base()
        solved = lines[-1]
        assert isinstance(solved, Update)
        inverse = sp.Symbol("hub_inverse_pivot", real=True)
        value = solved.values[UNKNOWN].subs(1 / HUB_PIVOT, inverse)
        lines = [
            *(x for x in lines if isinstance(x, Let) and x.symbol.name == "hub_impedance"),
            Update({UNKNOWN: value}),
        ]
        return [*here.lines(lines), Assign(hub_unknown(), self.scratch.ref("unknown"))]


def _varying(law: sp.Expr, changing: set[sp.Symbol]) -> sp.Expr:
    """Return a law, which is affine, without what is constant in it."""
    return sp.Add(*(term for term in sp.Add.make_args(law) if term.free_symbols & changing))


def _early(lines: Iterable[Line]) -> list[Line]:
    """Return the lets that depend on parameters and gains alone, so that prepare shares them with the step."""
    found: list[Line] = []
    for line in lines:
        if isinstance(line, Let) and line.symbol.name.endswith("_impedance"):
            found.append(line)
    return found
