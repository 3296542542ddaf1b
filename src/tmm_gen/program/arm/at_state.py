"""What a derivation's symbols stand for where nothing is predicted: the state itself."""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from tmm_gen.derive.elements.declaration import Element
from tmm_gen.derive.integrators.declaration import KINDS, Kind, Past
from tmm_gen.derive.station.frame import INNER, OUTER
from tmm_gen.derive.station.lets import Line, Pivot, Update
from tmm_gen.derive.station.reading import TOTAL, kinds_of, place, walk
from tmm_gen.program.arm.binding import Binding, Scratch
from tmm_gen.program.arm.branches import from_fork, kept_at_fork, resumed
from tmm_gen.program.arm.layout import Layout
from tmm_gen.program.statements import Assign, Loop, Order, Statement
from tmm_gen.program.variables import Ref


class AtState:
    """Binds derived lines at the state.

    Parameters
    ----------
    layout : Layout
        The row's variables.
    """

    def __init__(self, layout: Layout) -> None:
        self.layout = layout
        self.scratch = Scratch()
        units = {"q": "m", "v": "m/s", "a": "m/s^2"}
        words = {"q": "place", "v": "velocity", "a": "acceleration"}
        for c in layout.row.coordinates:
            for kind in KINDS:
                self.scratch.described[f"{kind}_{c.name}"] = (
                    f"{words[kind]} of a node along {c.name}",
                    units[kind],
                )

    def motion(self, station: int, kind: Kind) -> sp.Expr:
        """Return the motion of a station, counted from 1; 0 is the base."""
        layout = self.layout
        if station:
            return layout.state[Past(kind, 0)].entry(station - 1)
        return layout.hub[Past(kind, 0)].ref if layout.hub else sp.Integer(0)

    def place_of_base(self, name: str, kind: Kind) -> sp.Expr:
        """Return the motion of the base in a coordinate that is not integrated."""
        found = self.layout.floating.get(name)
        return found[Past(kind, 0)].ref if found else sp.Integer(0)

    def at_station(self, index: int | None, **more: sp.Expr) -> Binding:
        """Return what symbols stand for at station j of a loop, or at one with an index from 0 (-1: the base)."""
        layout = self.layout
        values: dict[sp.Symbol, sp.Expr] = {}
        for name, variable in layout.parameters.items():
            values[sp.Symbol(name)] = variable.at() if index is None else variable.entry(max(index, 0))
        for kind in KINDS:
            state = layout.state[Past(kind, 0)]
            inner = 0 if index is None or index < 0 else layout.row.host(index) + 1
            values[INNER[kind]] = state.at(-1) if index is None else self.motion(inner, kind)
            values[OUTER[kind]] = state.at() if index is None else self.motion(index + 1, kind)
        values |= {sp.Symbol(name, real=True): value for name, value in more.items()}
        return Binding(self.scratch, values)

    def loop(self, lines: Sequence[Line], start: int, stop: int, **more: sp.Expr) -> list[Statement]:
        """Write lines for a run of stations; the first one's inner side is the base, or where a branch begins."""
        if not lines or start >= stop:
            return []
        inner = any(symbols & set(INNER.values()) for symbols in map(_symbols, lines))
        if not inner or self.layout.row.host(start) == start - 1 >= 0:
            return [Loop(Order.OUTWARD, start, stop, tuple(self.at_station(None, **more).lines(lines)))]
        first: list[Statement] = list(self.at_station(start, **more).lines(lines))
        return [*first, *self.loop(lines, start + 1, stop, **more)]

    def summed(self, energy: str, target: Ref) -> list[Statement]:
        """Return the statements that add up an energy of the whole row."""
        row = self.layout.row
        every: tuple[Element, ...] = (*row.detail_base, *(e for s in row.detail for e in s), *row.detail_tail)
        kinds = kinds_of(every, energy) & frozenset(KINDS)
        carried = [c for c in row.coordinates if not c.integrated]
        if not carried:
            kinds = frozenset()
        total = {TOTAL.name: target}
        found: list[Statement] = [Assign(target, sp.Integer(0))]
        moves = [(c, kind) for c in carried for kind in KINDS if kind in kinds]
        places = [self.scratch.ref(place(c, kind).name) for c, kind in moves]
        begun = [self.place_of_base(c.name, kind) for c, kind in moves]
        found += [Assign(ref, value) for ref, value in zip(places, begun, strict=True)]
        at_base = walk(row.detail_base, row.coordinates, kinds, energy, moved=True)
        found += self.at_station(-1, **total).lines(at_base)
        for start, stop, elements in row.runs(row.detail):
            lines = walk(elements, row.coordinates, kinds, energy)
            found += resumed(row, start, from_fork(places, begun))
            found += self.loop(lines, start, stop, **total)
            found += kept_at_fork(row, stop, places)
        at_tip = walk(row.detail_tail, row.coordinates, kinds, energy, moved=True)
        found += self.at_station(self.layout.stations - 1, **total).lines(at_tip)
        return found


def _symbols(line: Line) -> set[sp.Symbol]:
    if isinstance(line, Update):
        return set().union(*(v.free_symbols for v in line.values.values()))
    return set() if isinstance(line, Pivot) else line.value.free_symbols
