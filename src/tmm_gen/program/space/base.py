"""A base that floats: its variables, and the statements around the sweeps of a step that integrate where it is.

Its place is integrated like angles are. Its orientation is, by a turn counted from where the step begins; what is kept
from step to step is a quaternion, and angular velocity and acceleration in the axes of the base.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from tmm_gen.derive.integrators.declaration import KINDS, STEP, Kind, Past, Scheme, past, stage
from tmm_gen.derive.integrators.relations import AffineMotion
from tmm_gen.derive.space import base_motion as motion_of
from tmm_gen.derive.space.base_balance import MOVED, TURNED
from tmm_gen.derive.space.declaration import AXES, vector
from tmm_gen.program.arm.binding import Binding, Scratch
from tmm_gen.program.arm.motion import KNOWN_RATE, StartingPoint
from tmm_gen.program.motion import in_order, update_assignments
from tmm_gen.program.space.base_layout import BaseLayout
from tmm_gen.program.statements import Assign, Statement
from tmm_gen.program.variables import Ref, Variable, local

Sources = Mapping[str, Mapping[sp.Symbol, sp.Expr]]
"""Where the history of each coordinate is read from."""

_PLACE, _VELOCITY = vector("base_place_now"), vector("base_velocity_now")
_WORDS: dict[tuple[str, Kind], tuple[sp.Matrix, str, str]] = {
    ("place", "q"): (_PLACE, "place of the base, as known so far", "m"),
    ("place", "v"): (_VELOCITY, "velocity of the base, as known so far", "m/s"),
    ("place", "a"): (motion_of.PUSH, "acceleration of the base, as known so far", "m/s^2"),
    ("turn", "q"): (motion_of.TURN, "what has turned the base since the step began, as known so far", "rad"),
    ("turn", "v"): (motion_of.TURN_RATE, "rate of that turn", "rad/s"),
    ("turn", "a"): (motion_of.TURN_ACCELERATION, "second derivative of that turn", "rad/s^2"),
}
_FOUND = {"place": MOVED, "turn": TURNED}
COORDINATES = tuple(f"{what}_{axis}" for what in ("place", "turn") for axis in AXES)


def _trial(coordinate: str, kind: Kind) -> Ref:
    """Return a coordinate's motion as it is known so far in a stage."""
    what, axis = coordinate.split("_")
    symbols, doc, unit = _WORDS[what, kind]
    return local(symbols[AXES.index(axis)].name, f"{doc}, {axis}", unit)


def _found(coordinate: str) -> Ref:
    """Return what a sweep has found a coordinate to do."""
    what, axis = coordinate.split("_")
    unit = "m/s^2" if what == "place" else "rad/s^2"
    doc = f"what the sweep finds the base's {what} to do, {axis}"
    return local(_FOUND[what][AXES.index(axis)].name, doc, unit)


def base_refs() -> dict[sp.Symbol, sp.Expr]:
    """Return what stands for the motion of the base before a sweep and for what the sweep finds."""
    found: dict[sp.Symbol, sp.Expr] = {}
    for coordinate in COORDINATES:
        what, axis = coordinate.split("_")
        for kind in KINDS:
            found[_WORDS[what, kind][0][AXES.index(axis)]] = _trial(coordinate, kind)
        found[_FOUND[what][AXES.index(axis)]] = _found(coordinate)
    return found


@dataclass(frozen=True)
class BaseStep:
    """Statements of one scheme's step.

    Parameters
    ----------
    layout : BaseLayout
        The base's variables.
    step : Variable
        The time step.
    scheme : Scheme
        What to step with.
    sources : mapping from str to mapping from sympy.Symbol to sympy.Expr
        Where history is read from, by coordinate.
    start : sympy.Matrix
        Quaternion where the step begins.
    """

    layout: BaseLayout
    step: Variable
    scheme: Scheme
    sources: Sources
    start: sp.Matrix

    @cached_property
    def values(self) -> dict[sp.Symbol, sp.Expr]:
        """What symbols of the base's motion stand for."""
        return {**base_refs(), **dict(zip(motion_of.START, self.start, strict=True))}

    def begin(self, point: StartingPoint) -> list[Statement]:
        """Predict the motion of a stage."""
        found: list[Statement] = []
        for coordinate in COORDINATES:
            for kind in ("v", "q", "a"):  # rates first: places may be written by them
                if kind not in point.still or kind != "a":
                    value = self._written(coordinate, point.values[kind])
                    found.append(Assign(_trial(coordinate, kind), value))
        return found

    def improve(self, gains: Mapping[Kind, sp.Expr], *, still: bool) -> list[Statement]:
        """Take up what a sweep has found; ``still`` where no acceleration was predicted before it."""
        return [
            Assign(
                _trial(c, kind),
                (sp.Integer(0) if still and kind == "a" else _trial(c, kind)) + gain * _found(c),
            )
            for c in COORDINATES
            for kind, gain in gains.items()
            if gain != 0 or (still and kind == "a")
        ]

    def cleared(self) -> list[Statement]:
        """Let accelerations be zero where a round of corrections adds to them."""
        return [Assign(_trial(c, "a"), sp.Integer(0)) for c in COORDINATES]

    def keep(self, index: int, kept: Iterable[tuple[Kind, int]]) -> list[Statement]:
        """Keep what later stages read of a stage, counted from 1, whose motion has been taken up."""
        mine = sorted((kind, i) for kind, i in kept if i == index)
        return [Assign(self._stage(kind, i, c), _trial(c, kind)) for c in COORDINATES for kind, i in mine]

    def finish(self) -> list[Statement]:
        """Set the motion at the end of the step, when that of its last stage has been taken up."""
        last = len(self.scheme.stages)
        ends: list[Assign] = []
        for c in COORDINATES:
            own = {stage(kind, last): _trial(c, kind) for kind in KINDS}
            for kind in KINDS:
                value = sp.sympify(self.scheme.update[kind]).xreplace(own)
                ends.append(Assign(_trial(c, kind), sp.expand(self._written(c, value))))
        found: list[Statement] = list(in_order([a for a in ends if a.target != a.value], "new_"))
        found += _bound(self.values)
        for axis in AXES:
            new = {kind: _trial(f"place_{axis}", kind) for kind in KINDS}
            found += update_assignments(self.layout.place[axis], new, lambda v: v.ref, "")
        return found + _turned_on(self.layout)

    def _written(self, coordinate: str, value: sp.Expr) -> sp.Expr:
        stages = {
            stage(kind, i): self._stage(kind, i, coordinate)
            for kind in KINDS
            for i in range(1, len(self.scheme.stages))
        }
        return value.xreplace(
            {
                STEP: self.step.ref,
                KNOWN_RATE: _trial(coordinate, "v"),
                **self.sources[coordinate],
                **stages,
            }
        )

    def _stage(self, kind: Kind, index: int, coordinate: str) -> Ref:
        what, axis = coordinate.split("_")
        word = {"q": what, "v": f"{what}_rate", "a": f"{what}_acceleration"}[kind]
        _, _, unit = _WORDS[what, kind]
        doc = f"{word.replace('_', ' ')} of the base at stage {index}, {axis}"
        return local(f"base_stage{index}_{word}_{axis}", doc, unit)


def turned_on(layout: BaseLayout, values: Mapping[sp.Symbol, sp.Expr]) -> list[Statement]:
    """Set quaternion, angular velocity and acceleration at the end of a step, by its turn there.

    Parameters
    ----------
    values : mapping from sympy.Symbol to sympy.Expr
        What the turn, its derivatives and the quaternion at the step's start stand for.
    """
    return [*_bound(values), *_turned_on(layout)]


def _bound(values: Mapping[sp.Symbol, sp.Expr]) -> list[Statement]:
    ends = (*motion_of.NEW_QUATERNION, *motion_of.NEW_OMEGA, *motion_of.NEW_ALPHA)
    bound = Binding(Scratch(), {**values, **{s: local(s.name) for s in ends}})
    return [*bound.lines(motion_of.end_lines())]


def _turned_on(layout: BaseLayout) -> list[Statement]:
    kinds: tuple[tuple[Kind, sp.Matrix, dict[str, dict[Past, Variable]]], ...] = (
        ("q", motion_of.NEW_QUATERNION, layout.quaternion),
        ("v", motion_of.NEW_OMEGA, layout.omega),
        ("a", motion_of.NEW_ALPHA, layout.alpha),
    )
    found: list[Statement] = []
    for kind, symbols, variables in kinds:
        for symbol, history in zip(symbols, variables.values(), strict=True):
            found += update_assignments(history, {kind: local(symbol.name)}, lambda v: v.ref, "")
    return found


def gains_of(motion: AffineMotion, step: Variable) -> dict[Kind, sp.Expr]:
    """Return what a unit of the unknown does, by kind of motion."""
    return {kind: motion.gain[kind].xreplace({STEP: step.ref}) for kind in KINDS}


def history_sources(layout: BaseLayout) -> dict[str, dict[sp.Symbol, sp.Expr]]:
    """Return where a step reads the history of each coordinate: turns are counted from the newest instant."""
    found: dict[str, dict[sp.Symbol, sp.Expr]] = {}
    for k, axis in enumerate(AXES):
        found[f"place_{axis}"] = {past(p.kind, p.lag): v.ref for p, v in layout.place[axis].items()}
        turn: dict[sp.Symbol, sp.Expr] = {
            past("q"): sp.Integer(0),
            past("v"): layout.omega[axis][Past("v", 0)].ref,
            past("a"): layout.alpha[axis][Past("a", 0)].ref,
        }
        for lag in layout.lags[1:]:
            symbols = zip(
                KINDS, (motion_of.PAST_TURN, motion_of.PAST_RATE, motion_of.PAST_ACCELERATION), strict=True
            )
            turn |= {past(kind, lag): _past(symbol[k], lag) for kind, symbol in symbols}
        found[f"turn_{axis}"] = turn
    return found


def earlier(layout: BaseLayout) -> list[Statement]:
    """Return earlier turns of the base, counted from where the step begins."""
    found: list[Statement] = []
    start = dict(zip(motion_of.START, layout.start, strict=True))
    for lag in layout.lags[1:]:
        then: dict[sp.Symbol, sp.Expr] = {
            s: h[Past("q", lag)].ref
            for s, h in zip(motion_of.AGO_QUATERNION, layout.quaternion.values(), strict=True)
        }
        for symbols, at, variables in (
            (motion_of.AGO_OMEGA, Past("v", lag), layout.omega),
            (motion_of.AGO_ALPHA, Past("a", lag), layout.alpha),
        ):
            then |= {s: h[at].ref for s, h in zip(symbols, variables.values(), strict=True)}
        for symbols in (motion_of.PAST_TURN, motion_of.PAST_RATE, motion_of.PAST_ACCELERATION):
            then |= {s: _past(s, lag) for s in symbols}
        found += Binding(Scratch(), {**start, **then}).lines(motion_of.past_lines())
    return found


def _past(symbol: sp.Symbol, lag: int) -> Ref:
    return local(f"{symbol.name}_{lag}_ago", "turn of the base counted from where the step begins")
