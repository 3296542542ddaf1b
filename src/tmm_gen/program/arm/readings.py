"""Outputs, read off the state."""

from __future__ import annotations

from collections.abc import Callable
from itertools import groupby

import sympy as sp

from tmm_gen.derive.integrators.declaration import KINDS
from tmm_gen.derive.station.frame import INNER, OUTER, Frame
from tmm_gen.derive.station.law import law_of
from tmm_gen.derive.station.lets import Coordinate, Update, composed
from tmm_gen.derive.station.reading import exact_forces, place, walk
from tmm_gen.derive.station.station import outward
from tmm_gen.derive.station.written import grouped
from tmm_gen.program.arm.at_state import AtState
from tmm_gen.program.arm.binding import Binding
from tmm_gen.program.arm.branches import resumed, rooted
from tmm_gen.program.arm.layout import Layout
from tmm_gen.program.arm.loads import exactly
from tmm_gen.program.statements import Assign, Loop, Order, Routine, Section, Statement
from tmm_gen.program.variables import Ref, Role, Variable
from tmm_gen.row.row import Reading

ZERO = sp.Integer(0)


def output_routine(layout: Layout, turned: Variable | None = None) -> Routine:
    """Build the outputs from the state.

    Parameters
    ----------
    turned : Variable, optional
        Angle that is taken out of all others.
    """
    readings = Readings(layout, turned)
    sections = tuple(
        Section(title, tuple(s for r in group for s in readings.statements(r)))
        for title, group in groupby(layout.row.readings, key=lambda r: r.title)
    )
    return Routine("output", "Read the outputs off the state.", sections)


class Readings:
    """Statements for each kind of reading."""

    def __init__(self, layout: Layout, turned: Variable | None) -> None:
        self._layout, self._row, self._turned = layout, layout.row, turned
        self._at = AtState(layout)
        self._outputs = {v.name: v.ref for v in layout.outputs}
        self._by: dict[str, Callable[[Reading, list[Ref]], list[Statement]]] = {
            "motion": self._motion,
            "bend": self._bend,
            "own": self._own,
            "place": self._place,
            "force": self._force,
            "energy": self._energy,
        }

    def statements(self, reading: Reading) -> list[Statement]:
        """Return the statements of one reading."""
        return self._by[reading.what](reading, [self._outputs[s.name] for s in reading.targets])

    def _motion(self, reading: Reading, targets: list[Ref]) -> list[Statement]:
        value = self._at.motion(reading.station, reading.kind)  # type: ignore[arg-type]
        if reading.kind == "q" and self._turned is not None:
            value = self._turned.ref + value
        return [Assign(targets[0], sp.expand(exactly(reading.factor) * value))]

    def _bend(self, reading: Reading, targets: list[Ref]) -> list[Statement]:
        outer, inner = (
            self._at.motion(station, reading.kind)  # type: ignore[arg-type]
            for station in (reading.station, reading.inner)
        )
        return [Assign(targets[0], outer - inner)]

    def _own(self, reading: Reading, targets: list[Ref]) -> list[Statement]:
        """Return the force of the element that gives way, or what stands beyond the last station needs."""
        n = self._layout.stations
        if reading.station > n:
            forces = self._beyond()
            own = next(i for i, c in enumerate(self._row.coordinates) if c.integrated)
            return [Assign(targets[0], sp.expand(reading.sign * forces[own]))]
        stations = [reading.station - 1] if reading.station else list(self._row.carried(-1))
        factor = reading.sign * exactly(reading.factor)
        return [Assign(targets[0], sp.Add(*(factor * self._torque(station) for station in stations)))]

    def _torque(self, station: int) -> sp.Expr:
        """Return the own force of the element that gives way at a station, counted from 0."""
        element = self._row.detail[station][0]
        law = law_of(element)
        assert law.free is not None
        values = {}
        for k in KINDS:
            values[getattr(element.inboard.motions[law.free], k)] = INNER[k]
            values[getattr(element.outboard.motions[law.free], k)] = OUTER[k]
        value = grouped(law.own.subs(values), {k: (INNER[k], OUTER[k]) for k in KINDS})
        return self._loaded(station).value(value)

    def _place(self, reading: Reading, targets: list[Ref]) -> list[Statement]:
        row = self._row
        carried = [c for c in row.coordinates if not c.integrated]
        names = {place(c, reading.kind).name: t for c, t in zip(carried, targets, strict=True)}
        begun = [self._at.place_of_base(c.name, reading.kind) for c in carried]  # type: ignore[arg-type]
        found: list[Statement] = [Assign(t, value) for t, value in zip(targets, begun, strict=True)]
        within = self._inward_of(reading.station)
        for start, stop, elements in row.runs():
            if start in within:
                lines = walk(elements, row.coordinates, frozenset({reading.kind}), None)
                found += self._at.loop(lines, start, min(stop, reading.station), **names)
        return found

    def _inward_of(self, station: int) -> set[int]:
        """Return the indices of the stations from a station, counted from 1, to the base."""
        found, index = set(), station - 1
        while index >= 0:
            found.add(index)
            index = self._row.host(index)
        return found

    def _force(self, reading: Reading, targets: list[Ref]) -> list[Statement]:
        """Walk out with accelerations, then in with forces, to the element that gives way."""
        row, n = self._row, self._layout.stations
        carried = [c for c in row.coordinates if not c.integrated]
        nodes = {
            c.name: Variable(
                f"acceleration_{c.name}",
                Role.WORK,
                n + 1,
                f"acceleration of the nodes along {c.name}",
                c.unit,
            )
            for c in carried
        }
        moving = {c.name: self._at.scratch.ref(place(c, "a").name) for c in carried}
        falls = dict.fromkeys(nodes, ZERO)
        falls[carried[-1].name] = self._at.at_station(-1).value(row.fall)
        falls = {name: value + self._at.place_of_base(name, "a") for name, value in falls.items()}
        found: list[Statement] = [Assign(moving[name], value) for name, value in falls.items()]
        found += [Assign(v.entry(0), moving[name]) for name, v in nodes.items()]
        for start, stop, elements in row.runs(row.detail):
            lines = walk(elements, row.coordinates, frozenset({"a"}), None)
            body = [
                *self._at.at_station(None).lines(lines),
                *(Assign(v.at(1), moving[name]) for name, v in nodes.items()),
            ]
            found += resumed(row, start, {moving[name]: v.entry for name, v in nodes.items()})
            found.append(rooted(row, Loop(Order.OUTWARD, start, stop, tuple(body))))
        names = dict(zip([c.name for c in carried], targets, strict=True))
        to_tip = row.beyond(reading.station - 1) == n
        beyond = self._beyond({name: v.entry(n) for name, v in nodes.items()})
        for i, c in enumerate(row.coordinates):
            if not c.integrated:
                found.append(Assign(names[c.name], beyond[i] if to_tip else ZERO))
        return [*found, *self._forces_in(reading.station, nodes, names)]

    def _forces_in(self, joint: int, nodes: dict[str, Variable], names: dict[str, Ref]) -> list[Statement]:
        row = self._row
        forces = tuple(sp.Symbol(f"held_{c.force}", real=True) for c in row.coordinates)
        wanted = {s for s, c in zip(forces, row.coordinates, strict=True) if not c.integrated}
        fill, loads = self._held_loads()
        found: list[Statement] = list(fill)
        end = row.beyond(joint - 1)
        for start, stop, elements in reversed(row.runs(row.detail)):
            first = max(start, joint - 1)
            if first >= stop or start >= end:
                continue
            out = outward(elements, _plain(row.coordinates))
            lines = [
                Update({s: v for s, v in line.values.items() if s in wanted})
                for line in exact_forces(out, forces)
            ]
            values = dict(self._at.at_station(None).values) | loads
            for name, variable in nodes.items():
                values[sp.Symbol(f"node_{name}", real=True)] = variable.at(0)
                values[sp.Symbol(f"node_{name}_outer", real=True)] = variable.at(1)
            for symbol, c in zip(forces, row.coordinates, strict=True):
                if not c.integrated:
                    values[symbol] = names[c.name]
            body = Binding(self._at.scratch, values).lines(lines)
            found.append(rooted(row, Loop(Order.INWARD, first, stop, tuple(body))))
        return found

    def _beyond(self, nodes: dict[str, sp.Expr] | None = None) -> list[sp.Expr]:
        """Return the forces at the inner side of what stands beyond the last station."""
        row = self._row
        forces = tuple(sp.Symbol(f"held_{c.force}", real=True) for c in row.coordinates)
        out = outward(row.detail_tail, _plain(row.coordinates), moved=True)
        left = composed(exact_forces(out, forces))
        values = dict(self._loaded(self._layout.stations - 1).values) | dict.fromkeys(forces, ZERO)
        for c in row.coordinates:
            if not c.integrated:
                values[sp.Symbol(f"node_{c.name}", real=True)] = (nodes or {}).get(c.name, ZERO)
        return [Binding(self._at.scratch, values).value(left.get(f, ZERO)) for f in forces]

    def _loaded(self, index: int) -> Binding:
        """Bind at a station with loads as they last acted."""
        values = dict(self._at.at_station(index).values)
        for load in self._row.loads:
            acting = [name for i, name in load.places if i in (None, index) and name in self._layout.held]
            values[load.symbol] = sp.Add(*(self._layout.held[name].ref for name in acting))
        return Binding(self._at.scratch, values)

    def _held_loads(self) -> tuple[list[Statement], dict[sp.Symbol, sp.Expr]]:
        """Return arrays of loads on stations as they last acted."""
        n, held = self._layout.stations, self._layout.held
        fill: list[Statement] = []
        values: dict[sp.Symbol, sp.Expr] = {}
        for load in self._row.loads:
            places = [(i, name) for i, name in load.places if i is not None and name in held]
            if not places:
                values[load.symbol] = ZERO
                continue
            array = Variable(f"held_{load.symbol.name.rstrip('_')}", Role.WORK, n, load.doc, load.unit)
            values[load.symbol] = array.at()
            fill.append(Loop(Order.OUTWARD, 0, n, (Assign(array.at(), ZERO),)))
            fill += [Assign(array.entry(i), array.entry(i) + held[name].ref) for i, name in places]
        return fill, values

    def _energy(self, reading: Reading, targets: list[Ref]) -> list[Statement]:
        if reading.kind == "dissipated":
            heat = self._layout.dissipated
            return [Assign(targets[0], heat.ref if heat else ZERO)]
        if reading.kind == "gravitational" and self._row.fall == 0:
            return [Assign(targets[0], ZERO)]
        return self._at.summed(reading.kind, targets[0])


def _plain(coordinates: tuple[Coordinate, ...]) -> Frame:
    """Return a frame for exact laws alone."""
    one = sp.Integer(1)
    return Frame(coordinates, (one, one, one))
