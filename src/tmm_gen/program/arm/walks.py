"""The walks of one sweep, as sections: out with motion, in with forces, the base, out with the answers."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import replace
from functools import cached_property
from typing import NamedTuple

import sympy as sp

from tmm_gen.derive.elements.declaration import Element
from tmm_gen.derive.station.frame import change, force, impedance, of_shaft, predicted_force
from tmm_gen.derive.station.inward import Inward, back
from tmm_gen.derive.station.lets import Coordinate, Let, Line, composed
from tmm_gen.derive.station.station import ceasing, everything, inward, outward, recurring
from tmm_gen.program.arm.at_places import BASE, AtPlaces, hub_unknown, prescribed_unknown
from tmm_gen.program.arm.base import Balance, base_acceleration, base_change, floating_base, turning_base
from tmm_gen.program.arm.binding import Binding
from tmm_gen.program.arm.branches import Gathered, from_fork, kept_at_fork, resumed, rooted
from tmm_gen.program.arm.spread import spread
from tmm_gen.program.statements import Assign, Loop, Order, Require, Section, Statement
from tmm_gen.program.variables import Ref


class _Derived(NamedTuple):
    tail: Inward
    at_base: frozenset[sp.Symbol]
    arriving: list[frozenset[sp.Symbol]]
    """What is known to be zero beyond each run."""
    inwards: list[Inward]


class Walks(AtPlaces):
    """Builds the sections of one sweep, from what :class:`AtPlaces` binds."""

    def sections(self, then: Callable[[], Iterable[Section]] = tuple) -> list[Section]:
        """Return the whole sweep, and what follows it: that may read what the sweep has named at each station."""
        plain = (*self.plain(), *then())
        found = [replace(s, statements=tuple(x for x in s.statements if not _empty(x))) for s in plain]
        return spread([s for s in found if s.statements], self.scratch, self.layout.stations)

    def plain(self) -> list[Section]:
        """Return the whole sweep, with scratch of stations as scalars."""
        falling = (
            ", seen from a falling frame: gravity is the base's own" if self.layout.row.fall != 0 else ""
        )
        return [
            Section("accelerations of the nodes" + falling, tuple(self.outward_motion())),
            Section("forces of the joints at the motion so far", tuple(self.joint_forces())),
            Section(
                "sweep inward: force beyond each joint as an affine function of the motion at it",
                tuple(self.inward_forces()),
            ),
            Section("the base", tuple(self.base())),
            Section("sweep outward: the unknown of each station", tuple(self.answers())),
        ]

    # -- walks ---------------------------------------------------------------------------------------------

    def outward_motion(self) -> list[Statement]:
        """Walk out with the motion of nodes, and with how they answer to the unknowns."""
        here = self.at_station()
        first: list[Statement] = []
        walk: list[Statement] = []
        carried = {
            sp.Symbol(f"node_{name}", real=True): self.scratch.ref(f"node_{name}") for name in self.nodes
        }
        moving = {
            sp.Symbol(f"node_{name}_outer", real=True): ref
            for name, ref in zip(self.nodes, carried.values(), strict=True)
        }
        along = Binding(self.scratch, {**here.values, **carried, **moving})
        kept = {ref: v.entry for ref, v in zip(carried.values(), self.nodes.values(), strict=True)}
        for (start, stop, elements), derived in zip(self.runs, self._derived.inwards, strict=True):
            lets = self.ways_out(elements, derived)
            self.scratch.describe(let for let in lets if let.symbol not in moving)
            at_nodes = _depending(lets, set(carried))
            still = [let for let in lets if let not in at_nodes]
            if still:
                first.append(self.over(Order.OUTWARD, start, stop, here.lines(still)))
            walk += resumed(self.layout.row, start, kept)  # a shaft may begin a branch, and moves no node
            if at_nodes:
                body = [Assign(along.target(let.symbol), along.value(let.value)) for let in at_nodes]
                body += [Assign(v.at(1), self.scratch.ref(f"node_{name}")) for name, v in self.nodes.items()]
                walk.append(self.over(Order.OUTWARD, start, stop, body))
        return [*first, *self._start_nodes(), *walk] if walk else first

    def ways_out(self, elements: tuple[Element, ...], derived: Inward) -> list[Let]:
        """Return what is computed on the way out over a station."""
        del derived
        return outward(elements, self.frame).lets

    def _start_nodes(self) -> list[Statement]:
        falls = dict.fromkeys(self.nodes, sp.Integer(0))
        if self.nodes:
            falls[list(self.nodes)[-1]] = self.at_node(BASE).value(self.layout.row.fall)
        if self.layout.row.floats:
            falls = {c.name: falls[c.name] + base_acceleration(c) for c in self._carried_along}
        begin = [Assign(self.scratch.ref(f"node_{name}"), value) for name, value in falls.items()]
        kept = [Assign(v.entry(BASE), self.scratch.ref(f"node_{name}")) for name, v in self.nodes.items()]
        return [*begin, *kept]

    def joint_forces(self) -> list[Statement]:
        """Return the forces of elements that give way, at the motion about which it is linearised."""
        here = self.at_station()
        found: list[Statement] = self.loads.filled(self._driven)
        for (start, stop, _), derived in zip(self.runs, self._derived.inwards, strict=True):
            if derived.known:
                lines = [*self.ways_ahead(derived), *derived.known]
                found.append(self.over(Order.OUTWARD, start, stop, here.lines(lines)))
        return found

    def ways_ahead(self, derived: Inward) -> Sequence[Line]:
        """Return what the forces of joints need of parameters and gains alone."""
        return derived.ahead

    @property
    def _driven(self) -> set[sp.Symbol]:
        """What stands in the laws of elements that give way."""
        found = {
            s for derived in self._derived.inwards for let in derived.known for s in let.value.free_symbols
        }
        return found | {s for s in self.loads.values if of_shaft(s) in found}

    def inward_forces(self) -> list[Statement]:
        """Walk in with the force beyond each place as an affine function of the motion there."""
        here = self.at_station()
        found: list[Statement] = self.loads.filled_besides(self._driven)
        unread = set() if self.frame.predicted else set(map(predicted_force, self.frame.coordinates))
        row, gathered = self.layout.row, Gathered(self.layout.row)
        for (start, stop, _), derived, arriving in reversed(
            list(zip(self.runs, self._derived.inwards, self._derived.arriving, strict=True))
        ):
            begin = self.tail() if stop == len(row.stations) else {}
            begin |= self._joined(gathered, stop - 1, arriving)
            begin |= dict.fromkeys(arriving - derived.arriving - unread, sp.Integer(0))
            for symbol in self.carried_inward():
                if symbol in begin:
                    found.append(Assign(self.scratch.ref(symbol.name), begin[symbol]))
            lines = [*self.ways_in(derived), *ceasing(derived, stop - start, self.carried_inward())]
            found.append(self.over(Order.INWARD, start, stop, here.lines(lines)))
            found += gathered.leave(start, self._carried(derived.zero))
        if row.boundary == "free":
            at_base = self._joined(gathered, BASE - 1, self._derived.at_base)
            found += [Assign(self.scratch.ref(s.name), value) for s, value in at_base.items()]
        return found

    def ways_in(self, derived: Inward) -> Sequence[Line]:
        """Return what is computed on the way in over a station."""
        return derived.lines

    def carried_inward(self) -> list[sp.Symbol]:
        """Return what is carried from each station to the next on the way in."""
        c = self.frame.coordinates
        return [*(impedance(a, b) for a in c for b in c), *map(force, c), *map(predicted_force, c)]

    def over(self, order: Order, start: int, stop: int, body: Sequence[Assign | Require]) -> Loop:
        """Return a loop over a run of stations."""
        return rooted(self.layout.row, Loop(order, start, stop, tuple(body)))

    def _carried(self, zero: Collection[sp.Symbol]) -> list[Ref]:
        """Return the scalars of the walk inward that are not known to be zero."""
        return [self.scratch.ref(s.name) for s in self.carried_inward() if s not in zero]

    def _joined(
        self, gathered: Gathered, station: int, zero: Collection[sp.Symbol]
    ) -> dict[sp.Symbol, sp.Expr]:
        values = gathered.joined(station, self._carried(zero))
        return {sp.Symbol(ref.name, real=True): value for ref, value in values.items()}

    def tail(self) -> dict[sp.Symbol, sp.Expr]:
        """Return what stands beyond the last station, as forces there."""
        at_tip = self.at_node(self.layout.stations)
        left = composed(self._derived.tail.lines)
        return {s: at_tip.value(left[s]) for s in self.carried_inward() if s in left}

    def base(self) -> list[Statement]:
        """Solve for the unknown of the base."""
        here, unknown = self.at_node(BASE), self.scratch.ref("unknown")
        row = self.layout.row
        if row.boundary != "free":
            return [Assign(unknown, self._unknown_of_base())]
        if row.floats:
            return [*here.lines(self._balance().lines), *self._found_of_base()]
        return [*here.lines(self._free_base()), Assign(hub_unknown(), unknown)]

    def _balance(self) -> Balance:
        return floating_base(self.layout.row.base, self.frame, self._derived.at_base)

    def _found_of_base(self) -> list[Statement]:
        """Keep what has been found of a base that floats: the way out changes the same scalars."""
        changed = [Assign(base_change(c), self.scratch.ref(change(c).name)) for c in self._carried_along]
        return [*changed, Assign(hub_unknown(), self.scratch.ref("unknown"))]

    @property
    def _carried_along(self) -> list[Coordinate]:
        return [c for c in self.frame.coordinates if not c.integrated]

    def _unknown_of_base(self) -> sp.Expr:
        boundary = self.layout.row.boundary
        if boundary == "held":
            return sp.Integer(0)
        return hub_unknown() if boundary == "free" else prescribed_unknown(self.frame.still, self.loads)

    def _free_base(self) -> list[Line]:
        return turning_base(self.layout.row.base, self.frame, self._derived.at_base)

    def answers(self) -> list[Statement]:
        """Walk out with the unknowns."""
        here, unknown = self.at_station(), self.scratch.ref("unknown")
        row, zero = self.layout.row, sp.Integer(0)
        moved = [self.scratch.ref(change(c).name) for c in self._carried_along]
        at_base = [base_change(c) if row.floats else zero for c in self._carried_along]
        found: list[Statement] = [Assign(ref, value) for ref, value in zip(moved, at_base, strict=True)]
        forks = from_fork(moved, at_base)
        for (start, stop, elements), derived in zip(self.runs, self._derived.inwards, strict=True):
            found += resumed(row, start, forks | {unknown: self._solved_at})
            if elements:
                body = [*here.lines(back(derived)), Assign(self.solved.at(), unknown), *self.after_answer()]
                found.append(self.over(Order.OUTWARD, start, stop, body))
            found += kept_at_fork(row, stop, moved)
        return found

    def _solved_at(self, node: int) -> sp.Expr:
        """Return the unknown at a node, counted from the base."""
        return self.solved.entry(node - 1) if node else self._unknown_of_base()

    def after_update(self) -> list[Statement]:
        """Return updates of other states than motion of stations; they read the history before it ages."""
        return []

    def after_answer(self) -> list[Assign]:
        """Return what else to keep at each station."""
        return []

    # -- derivation ----------------------------------------------------------------------------------------

    @cached_property
    def runs(self) -> tuple[tuple[int, int, tuple[Element, ...]], ...]:
        """Stations of the same elements, from the base outward."""
        row = self.layout.row
        return row.runs(row.swept())

    @cached_property
    def _derived(self) -> _Derived:
        row = self.layout.row
        tail = inward(row.tail, self.frame, everything(self.frame), moved=True)
        arriving: list[frozenset[sp.Symbol]] = []
        inwards: list[Inward] = []
        begun: dict[int, frozenset[sp.Symbol]] = {}
        for start, stop, elements in reversed(self.runs):
            zero = tail.zero if stop == len(row.stations) else everything(self.frame)
            for station in row.carried(stop - 1):
                zero &= begun[station]
            derived = recurring(elements, self.frame, zero, stop - start)
            begun[start] = derived.zero
            arriving.insert(0, zero)
            inwards.insert(0, derived)
        at_base = frozenset.intersection(*(begun[station] for station in row.carried(BASE - 1)))
        return _Derived(tail, at_base, arriving, inwards)


def _empty(statement: Statement) -> bool:
    return isinstance(statement, Loop) and not statement.body


def _depending(lets: list[Let], on: set[sp.Symbol]) -> list[Let]:
    found: list[Let] = []
    reached = set(on)
    for let in lets:
        if let.value.free_symbols & reached:
            found.append(let)
            reached.add(let.symbol)
    return found
