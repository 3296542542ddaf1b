"""The walks of a sweep as tangents need them: with its factors kept, and on changes with the factors kept."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import sympy as sp

from tmm_gen.derive.station.frame import (
    INNER,
    MOUNT,
    OUTER,
    UNKNOWN,
    Frame,
    node,
    of_shaft,
    predicted_force,
)
from tmm_gen.derive.station.inward import Inward, back
from tmm_gen.derive.station.lets import Let, Line, Pivot, Update, composed
from tmm_gen.derive.station.motion import Outward
from tmm_gen.derive.station.station import outward
from tmm_gen.derive.station.tangent import SOLVED, Tangent, beyond, solved_force, solved_node
from tmm_gen.program.arm.base import Balance, base_acceleration, base_change, floating_base
from tmm_gen.program.arm.binding import Binding
from tmm_gen.program.arm.branches import Gathered, resumed
from tmm_gen.program.arm.layout import Layout
from tmm_gen.program.arm.walks import BASE, Walks, hub_unknown
from tmm_gen.program.sensitivities.point import Point
from tmm_gen.program.statements import Assign, Loop, Order, Require, Section, Statement
from tmm_gen.program.variables import Role, Variable, refs_in

ZERO = sp.Integer(0)
HUB_PIVOT = sp.Symbol("hub_pivot", real=True)


class TangentableWalks(Walks):
    """Walks whose factors depend on predicted motion alone, not on what the sweep itself has found.

    As accurate as the others, for a walk of predicted forces more; their exact derivative needs no derivatives of
    factors.
    """

    def __init__(self, layout: Layout, prepared: Mapping[str, Variable], frame: Frame, *more: Any) -> None:
        super().__init__(layout, prepared, replace(frame, predicted=True), *more)

    def tangents(self) -> list[tuple[int, int, Inward, Outward, Tangent]]:
        """Return the derived tangents of all runs."""
        found = []
        for (start, stop, elements), derived in zip(self.runs, self._inwards, strict=True):
            out = outward(elements, self.frame)
            found.append((start, stop, derived, out, Tangent(derived, out)))
        return found

    def _named_balance(self) -> Balance:
        """Return how a base that floats is solved for, with names for all that tangents need of it."""
        return floating_base(self.layout.row.base, self.frame, self._at_base, named=True)

    def _walk_in(
        self, at_tip: Mapping[sp.Symbol, sp.Expr], bodies: Sequence[Sequence[Assign | Require]]
    ) -> list[Statement]:
        """Walk inward with scalars that begin with given values at the tip, and with zero where branches end."""
        row, gathered = self.layout.row, Gathered(self.layout.row)
        carried = {s: self.scratch.ref(s.name) for s in at_tip}
        found: list[Statement] = []
        for (start, stop, _), body in reversed(list(zip(self.runs, bodies, strict=True))):
            begin = gathered.joined(stop - 1, carried.values())
            if not row.carried(stop - 1):
                begin = {ref: at_tip[s] if stop == len(row.stations) else ZERO for s, ref in carried.items()}
            found += [Assign(ref, value) for ref, value in begin.items()]
            found.append(self.over(Order.INWARD, start, stop, body))
            found += gathered.leave(start, carried.values())
        at_base = gathered.joined(BASE - 1, carried.values())
        return [*found, *(Assign(ref, value) for ref, value in at_base.items())]


class LinearisedWalks(TangentableWalks):
    """The same walks, which also keep their point of linearisation and their factors."""

    points: tuple[Point, ...] = ()
    """Where each sweep of the step keeps them, in order."""

    def plain(self) -> list[Section]:
        """Return the sweep, and what is kept of it."""
        point, self.points = self.points[0], self.points[1:]
        kept = _kept_symbols(self.tangents())
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
        solved = {c.name: _solved_node(c.name, n) for c in carried}
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
        tail = self._tail_tangent()
        left = composed(tail.keep_in)
        forces = [s for c in carried for s in (solved_force(c), predicted_force(c))]
        at_end = {s: at_tip.value(left.get(s, s).subs(dict.fromkeys(forces, 0))) for s in forces}
        lines = [[*tangent.keep_out, *tangent.keep_in] for *_, tangent in tangents]
        return [*found, *self._walk_in(at_end, [keep.lines(x) for x in lines])]

    def _tail_tangent(self) -> Tangent:
        row = self.layout.row
        return Tangent(self._tail, outward(row.tail, self.frame, moved=True))


class TangentWalks(TangentableWalks):
    """The walks on changes: factors are known."""

    points: tuple[Point, ...] = ()

    def plain(self) -> list[Section]:
        """Return the sweep on changes."""
        point, self.points = self.points[0], self.points[1:]
        self._tangents = self.tangents()
        kept = {**_kept_symbols(self._tangents)}
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
        return [replace(s, statements=tuple(_with_point(x, names) for x in s.statements)) for s in found]

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
            for s, v in ((node(c), self.nodes[c.name]), (solved_node(c), _solved_node(c.name, n)))
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
            array = _solved_node(c.name, n)
            here |= {solved_node(c): array.at(0), beyond(solved_node(c)): array.at(1)}
            there |= {solved_node(c): array.entry(n)}
        tail = Tangent(self._tail, outward(self.layout.row.tail, self.frame, moved=True))
        left = composed(tail.inward)
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


def _moved(solved: Variable, predicted: Variable, node: int) -> sp.Expr:
    """Return the change of a node's acceleration by what the sweep has found."""
    return solved.entry(node) - predicted.entry(node)


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


def _kept_symbols(tangents: list[tuple[int, int, Inward, Outward, Tangent]]) -> dict[str, tuple[str, str]]:
    """Return what is kept at the point of linearisation, with its description and unit."""
    every: dict[str, tuple[str, str]] = {}
    for _, _, derived, out, tangent in tangents:
        found: dict[str, tuple[str, str]] = {}
        for let in (
            *out.lets,
            *(x for x in derived.lines if isinstance(x, Let)),
            *tangent.keep_out,
            *(x for x in tangent.keep_in if isinstance(x, Let)),
        ):
            found.setdefault(let.symbol.name, (let.doc, let.unit))
        read: set[str] = set()
        for line in (*tangent.outward, *tangent.inward, *back(derived)):
            values = (
                line.values.values()
                if isinstance(line, Update)
                else ()
                if isinstance(line, Pivot)
                else (line.value,)
            )
            read |= {s.name for v in values for s in v.free_symbols}
        own = {"answer_own", "unknown", *(let.symbol.name for let in derived.known)}
        own |= {
            line.symbol.name
            for line in derived.lines
            if isinstance(line, Let) and line.symbol.name.endswith("_impedance")
        }
        own |= {beyond(s(c)).name for c in out.frame.coordinates for s in (node, solved_node)}
        every |= {name: words for name, words in found.items() if name in read and name not in own}
    every["hub_inverse_pivot"] = ("inverse of the hub's pivot", "1")
    return every


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


def _with_point(statement: Statement, names: Mapping[str, sp.Expr | None]) -> Statement:
    """Read kept values from the point of linearisation."""

    def value(e: sp.Expr) -> sp.Expr:
        found = {r: names[r.variable.name] for r in refs_in(e) if names.get(r.variable.name) is not None}
        return e.xreplace(found)

    if isinstance(statement, Loop):
        return replace(statement, body=tuple(replace(x, value=value(x.value)) for x in statement.body))
    return replace(statement, value=value(statement.value))


def _solved_node(axis: str, n: int) -> Variable:
    doc = f"acceleration of the nodes along {axis} as solved"
    return Variable(f"solved_acceleration_{axis}", Role.WORK, n + 1, doc, "m/s^2")
