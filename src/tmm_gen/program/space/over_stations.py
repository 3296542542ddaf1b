"""One walk over the stations of an arm in space: derived lines as loops, with what joints and branches hand on."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

import sympy as sp

from tmm_gen.derive.space.base_motion import GRAVITY
from tmm_gen.derive.space.declaration import (
    ACCEL,
    ACCELERATION,
    ALPHA,
    ANGLE,
    AXES,
    BASE_ACCEL,
    BASE_PLACE,
    BASE_VELOCITY,
    OMEGA,
    RATE,
)
from tmm_gen.derive.space.inward import ADMITTANCE, IMBALANCE, IMPEDANCE, OWN, RELIEF, TORQUE, YIELD
from tmm_gen.derive.space.newton import ABOUT_AXIS, PUSH
from tmm_gen.derive.space.newton import CHANGE as ALL_CHANGES
from tmm_gen.derive.space.outward import COSINE, OWN_FORCE, OWN_MOMENT, SINE
from tmm_gen.derive.space.pattern import Pattern
from tmm_gen.derive.station.lets import Let, Line, needed
from tmm_gen.program.arm.binding import Binding, Scratch
from tmm_gen.program.space.bodies import Bodies
from tmm_gen.program.space.layout import SpaceLayout
from tmm_gen.program.space.runs import Run
from tmm_gen.program.space.turns import fixed
from tmm_gen.program.statements import Assign, Loop, Order, Require, Statement
from tmm_gen.program.variables import Ref, Role, Variable, local, refs_in

_KEPT: dict[sp.Symbol, tuple[str, str]] = {
    SINE: ("sine of each joint's angle", "1"),
    COSINE: ("cosine of each joint's angle", "1"),
    **dict.fromkeys(OWN_FORCE, ("force that each body takes", "N")),
    **dict.fromkeys(OWN_MOMENT, ("moment that each body takes", "N m")),
    **dict.fromkeys(YIELD[:3, :], ("of an acceleration of its section, what each joint takes back", "1/m")),
    **dict.fromkeys(
        YIELD[3:, :], ("of an angular acceleration of its section, what each joint takes back", "1")
    ),
    RELIEF: ("what each joint does by itself", "rad/s^2"),
    ADMITTANCE: ("motion of each joint per torque in it", "1/(kg m^2)"),
    IMBALANCE: ("torque that each joint lacks", "N m"),
    IMPEDANCE: ("torque of each joint's spring, damper and rotor per unknown", "kg m^2"),
    TORQUE: ("torque of each joint's own before the sweep", "N m"),
    OWN: ("what the sweep finds each joint to do", "rad/s^2"),
    **dict.fromkeys(ABOUT_AXIS, ("moment about each joint's axis per change of its section's motion", "1")),
    **dict.fromkeys(PUSH, ("change of each section's motion per unknown of its joint", "1")),
}
"""What walks hand each other, one value a joint."""

_UNITS = {"accel": "m/s^2", "alpha": "rad/s^2", "omega": "rad/s"}


MOTION = {"q": ANGLE, "v": RATE, "a": ACCELERATION}
"""Symbols of a hinge's motion by its kind."""


class OverStations:
    """Binds derived lines to the stations of an arm, and goes over them.

    Parameters
    ----------
    layout : SpaceLayout
        The arm's variables.
    bodies : Bodies
        What is prepared of them.
    motion : mapping from sympy.Symbol to Variable
        Angle, rate and acceleration of the joints at the point of linearisation.
    absent : frozenset of sympy.Symbol
        What of the joints' own law is zero everywhere.
    base : mapping from sympy.Symbol to sympy.Expr
        What symbols of the motion of a base that floats, or is moved as given, stand for.
    """

    def __init__(
        self,
        layout: SpaceLayout,
        bodies: Bodies,
        motion: Mapping[sp.Symbol, Variable],
        absent: frozenset[sp.Symbol],
        base: Mapping[sp.Symbol, sp.Expr],
    ) -> None:
        self._base_values = {**base, **bodies.of_base, **gravity_values(layout)}
        self.layout, self._bodies, self._motion, self._absent = layout, bodies, motion, absent
        self._runs = layout.tree.runs()
        self._totals: set[sp.Symbol] = set()
        n = layout.stations
        self._arrays = {
            symbol: Variable(symbol.name, Role.WORK, n, doc, unit) for symbol, (doc, unit) in _KEPT.items()
        }
        self._scratch = Scratch()
        for symbol in (*OMEGA, *ALPHA, *ACCEL, *ALL_CHANGES):
            kind = symbol.name.removeprefix("change_").split("_")[0]
            self._scratch.described[symbol.name] = ("", _UNITS[kind])

    def array(self, symbol: sp.Symbol) -> Variable:
        """Return the array of what walks hand each other."""
        return self._arrays[symbol]

    def read_later(self) -> frozenset[sp.Symbol]:
        """Return what of the way out is read later at any station: one array, or one scalar, has one name."""
        return frozenset()

    def _kept(self, symbol: sp.Symbol) -> Variable:
        """Return the array of what of the way out slopes are taken at."""
        if symbol not in self._arrays:
            kind = symbol.name.split("_")[1]
            doc, unit = f"{symbol.name[:-2].replace('_', ' ')} of each joint", _UNITS.get(kind, "1")
            # a name of its own: where nothing is kept, a scalar has the plain one
            name = f"kept_{symbol.name}"
            self._arrays[symbol] = Variable(name, Role.WORK, self.layout.stations, doc, unit)
        return self._arrays[symbol]

    def at_station(self, index: int, lines: Sequence[Line]) -> list[Statement]:
        """Return lines at one station that stands by itself."""
        run = next(r for r in self._runs if r.start == index)
        return [Loop(Order.OUTWARD, index, index + 1, tuple(self._lines(lines, 0, "", (), run)))]

    def scalar(self, symbol: sp.Symbol, doc: str, unit: str) -> Ref:
        """Return the scratch scalar that stands for a symbol."""
        self._scratch.described.setdefault(symbol.name, (doc, unit))
        self._totals.add(symbol)
        return self._scratch.ref(symbol.name)

    def at_base(self, symbol: sp.Symbol, words: tuple[str, str] = ("", "1")) -> Ref:
        """Return the scratch scalar that stands for a symbol at a base that floats.

        Parameters
        ----------
        words : tuple of (str, str)
            What it is and its unit, where no lines say so.
        """
        self._scratch.described.setdefault(symbol.name, words)
        return self._scratch.ref(symbol.name)

    def base_lines(self, lines: Sequence[Line]) -> list[Assign | Require]:
        """Return lines at a base that floats as statements."""
        return Binding(self._scratch, self._base_values).lines(lines)

    def walk(
        self,
        order: Order,
        lines_of: Callable[[Pattern], Sequence[Line]],
        carried: tuple[sp.Symbol, ...],
        read: Callable[[int], Sequence[Line]] = lambda _: (),
        within: frozenset[int] | None = None,
        base: Sequence[Line] = (),
        *,
        whole: bool = False,
    ) -> list[Statement]:
        """Return loops over the stations.

        Parameters
        ----------
        lines_of : callable
            Lines of a station by its pattern.
        carried : tuple of sympy.Symbol
            What is handed from station to station.
        read : callable
            Further lines behind those of stations that stand by themselves, by index.
        within : frozenset of int, optional
            Stations to be visited, with all of their run; all if left out.
        base : sequence of Line
            Of a base that floats: before the stations outward, behind them inward.
        whole : bool
            Whether what is handed inward is passed on to joints that move as given too.
        """
        runs = [r for r in self._runs if within is None or within & set(range(r.start, r.stop))]
        found: list[Statement] = []
        if order is Order.OUTWARD:
            found += self._at_base(base, order, carried)
        for run in reversed(runs) if order is Order.INWARD else runs:
            slots = list(enumerate(run.patterns))
            body: list[Assign | Require] = []
            for slot, pattern in reversed(slots) if order is Order.INWARD else slots:
                suffix = f"_{slot + 1}" if len(slots) > 1 else ""
                body += self._lines(lines_of(pattern), slot, suffix, carried, run)
            if run.single:
                body += self._lines(read(run.start), 0, "", carried, run)
                body = self._joined(run.start, body, order, carried, whole)
            if body:
                found.append(Loop(order, run.start, run.stop, tuple(body), len(slots)))
        if order is Order.INWARD:
            found += self._at_base(base, order, carried)
        return found

    def _at_base(
        self, lines: Sequence[Line], order: Order, carried: tuple[sp.Symbol, ...]
    ) -> list[Assign | Require]:
        """Return what happens at a base that floats, with what its branches take over from there or leave there."""
        if not lines:
            return []
        body = self.base_lines(lines)
        if not self.layout.tree.forks(-1):
            return body
        here = [(self._here(s), self._fork(-1, s)) for s in carried]
        if order is Order.OUTWARD:
            return [*body, *(Assign(fork, own) for own, fork in here)]
        return [*(Assign(own, own + fork) for own, fork in here), *body]

    def _joined(
        self,
        index: int,
        body: list[Assign | Require],
        order: Order,
        carried: tuple[sp.Symbol, ...],
        whole: bool,
    ) -> list[Assign | Require]:
        """Add what a station takes over from where its branch begins, or leaves there."""
        tree, host = self.layout.tree, self.layout.tree.host(index)
        branch = (host >= 0 or self.layout.base is not None) and host != tree.before(index)
        if order is Order.OUTWARD:
            taken = [Assign(self._here(s), self._fork(host, s)) for s in carried] if branch else []
            left = [Assign(self._fork(index, s), self._here(s)) for s in carried] if tree.forks(index) else []
            return [*taken, *body, *left]
        # else nothing is passed on to what moves as given
        if not whole and (tree.given(index) or tree.given(host)):
            return body
        added = (
            [Assign(self._here(s), self._here(s) + self._fork(index, s)) for s in carried]
            if tree.forks(index)
            else []
        )
        kept: list[Assign | Require] = []
        if branch:
            first = index == max(tree.carried(host))
            kept = [
                Assign(self._fork(host, s), self._here(s) if first else self._fork(host, s) + self._here(s))
                for s in carried
            ]
        return [*added, *body, *kept]

    def _here(self, symbol: sp.Symbol) -> Ref:
        return self._scratch.ref(symbol.name)

    def _fork(self, index: int, symbol: sp.Symbol) -> Ref:
        return local(f"fork{index + 1}_{symbol.name}")  # the base is 0

    def _lines(
        self, lines: Sequence[Line], slot: int, suffix: str, carried: Iterable[sp.Symbol], run: Run
    ) -> list[Assign | Require]:
        pattern = run.patterns[slot]
        total = self._with_shaft() if self.layout.tree.geared(run.start) else {}
        values: dict[sp.Symbol, sp.Expr] = (
            self._values(slot) | total | fixed(self.layout.arm.joints[run.start + slot].turn)
        )
        values |= {s: self._kept(s).at(slot) for s in self.read_later()}
        if pattern.rooted:
            values |= {
                s: self._base_values.get(s, sp.Integer(0)) - self.layout.at(f"gravity_{axis}", None)
                for s, axis, falls in zip(BASE_ACCEL, AXES, pattern.falls, strict=True)
                if falls
            }
            told = (*BASE_PLACE, *BASE_VELOCITY)
            values |= {s: self._base_values[s] for s in told if s in self._base_values}
        if suffix:
            described = {
                line.symbol: (line.doc, line.unit) for line in reversed(lines) if isinstance(line, Let)
            }
            for symbol in described.keys() - values.keys() - set(carried):
                self._scratch.described.setdefault(f"{symbol.name}{suffix}", described[symbol])
                values[symbol] = self._scratch.ref(f"{symbol.name}{suffix}")
        kept = needed(lines, frozenset(values) | frozenset(carried) | frozenset(self._totals))
        written = Binding(self._scratch, values).lines(kept)
        read = {ref for statement in written for ref in refs_in(statement.value)}
        sums = [(total[s], v.at(slot) + v.at(slot - 1)) for s, v in self._motion.items() if s in total]
        return [*(Assign(both, value) for both, value in sums if both in read), *written]

    def _with_shaft(self) -> dict[sp.Symbol, Ref]:
        """Return what stands for the motion of a joint and of the shaft before it together."""
        for symbol in self._motion:
            words = f"{symbol.name} of a joint and its shaft together"
            self._scratch.described.setdefault(f"geared_{symbol.name}", (words, ""))
        return {symbol: self._scratch.ref(f"geared_{symbol.name}") for symbol in self._motion}

    def _values(self, slot: int) -> dict[sp.Symbol, sp.Expr]:
        """Return what symbols stand for at station ``j + slot``."""
        names: dict[str, sp.Expr] = {name: v.at(slot) for name, v in self.layout.parameters.items()}
        names |= self._bodies.at(slot)
        values: dict[sp.Symbol, sp.Expr] = {
            sp.Symbol(name, real=True): value for name, value in names.items()
        }
        values |= {symbol: self._arrays[symbol].at(slot) for symbol in _KEPT}
        values |= {symbol: variable.at(slot) for symbol, variable in self._motion.items()}
        return values | dict.fromkeys(self._absent, sp.Integer(0))


def gravity_values(layout: SpaceLayout) -> dict[sp.Symbol, sp.Expr]:
    """Return gravity by the symbols of its components."""
    return {s: layout.at(s.name, None) for s in GRAVITY}
