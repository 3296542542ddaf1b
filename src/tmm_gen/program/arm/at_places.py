"""What the symbols of a derivation stand for at the places of a row: its stations, and the nodes between them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import sympy as sp

from tmm_gen.derive.station.frame import (
    COSINE,
    INNER,
    MOUNT,
    OUTER,
    SINE,
    Frame,
    change,
    node,
    of_shaft,
    predicted_force,
)
from tmm_gen.derive.station.law import KINDS
from tmm_gen.derive.station.shaft import UNKNOWN as UNKNOWN_OF_SHAFT
from tmm_gen.program.arm.binding import Binding, Scratch
from tmm_gen.program.arm.layout import Layout
from tmm_gen.program.arm.loads import Loads
from tmm_gen.program.arm.motion import Held, Moving, StageOf
from tmm_gen.program.variables import Ref, Role, Variable, local

At = Callable[[Any], sp.Expr]
"""What a variable, or motion that is held, is at a station or node."""

BASE = 0
"""Index of the base among nodes; station j lies between nodes j and j + 1."""


class AtPlaces:
    """Binds symbols to variables at stations and at nodes.

    Parameters
    ----------
    layout : Layout
        The row's variables.
    prepared : mapping from str to Variable
        Combinations of parameters.
    frame : Frame
        What the recursion is derived for.
    gains : mapping from sympy.Symbol to sympy.Expr
        Values of the frame's symbols for gains.
    motion : mapping from "q", "v", "a" to Variable or Held
        Motion about which it is linearised, base first.
    loads : Loads
        What acts.
    stage : StageOf
        Which stage of which scheme it is.
    """

    def __init__(
        self,
        layout: Layout,
        prepared: Mapping[str, Variable],
        frame: Frame,
        gains: Mapping[sp.Symbol, sp.Expr],
        motion: Mapping[str, Moving],
        loads: Loads,
        stage: StageOf,
    ) -> None:
        self.layout, self.frame, self.motion, self.loads = layout, frame, motion, loads
        self.gains, self.prepared, self.stage = gains, prepared, stage
        self.scratch = Scratch(dict(_described(frame)))
        self._parameters = {sp.Symbol(name): v for name, v in {**layout.parameters, **prepared}.items()}
        self.nodes = {
            c.name: Variable(
                f"acceleration_{c.name}",
                Role.WORK,
                layout.stations + 1,
                f"acceleration of the nodes along {c.name}",
                c.unit,
            )
            for c in frame.coordinates
            if not c.integrated
        }
        self.solved = solved_variable(layout.stations)

    def at_station(self) -> Binding:
        """Return what symbols stand for at station j of a loop."""
        values = self._values(lambda v: v.at(), lambda v: v.at(0), lambda v: v.at(1))
        for name, variable in self.nodes.items():
            values[sp.Symbol(f"node_{name}", real=True)] = variable.at(0)
            values[sp.Symbol(f"node_{name}_outer", real=True)] = variable.at(1)
        return Binding(self.scratch, values | self._of_shaft(values))

    def _of_shaft(self, values: Mapping[sp.Symbol, sp.Expr]) -> dict[sp.Symbol, sp.Expr]:
        """Return what symbols of its shaft stand for at station j: what the station before it has."""
        if not self.layout.row.shafts:
            return {}
        own = {of_shaft(s): values[s] for s in (*self._parameters, *self.loads.values)}
        own |= {MOUNT[k]: values[INNER[k]] for k in KINDS if INNER[k] in values}
        own |= {UNKNOWN_OF_SHAFT: self.solved.at()}
        return {s: _one_inward(value) for s, value in own.items()}

    def at_node(self, index: int) -> Binding:
        """Return what symbols stand for at a node, counted from the base."""
        last = max(min(index, self.layout.stations) - 1, 0)
        values = self._values(lambda v: v.entry(last), lambda v: v.entry(index), lambda v: v.entry(index))
        for name, variable in self.nodes.items():
            values[sp.Symbol(f"node_{name}", real=True)] = variable.entry(index)
        return Binding(self.scratch, values)

    def _values(self, parameter: At, inner: At, outer: At) -> dict[sp.Symbol, sp.Expr]:
        values: dict[sp.Symbol, sp.Expr] = {s: parameter(v) for s, v in self._parameters.items()}
        values |= {**self.gains, **self.loads.values}
        for kind in KINDS:
            if kind in self.motion:
                if not isinstance(self.motion[kind], Held):
                    values[INNER[kind]] = inner(self.motion[kind])
                values[OUTER[kind]] = outer(self.motion[kind])
        if self.frame.followed is None and "q" in self.motion:
            values[SINE], values[COSINE] = sp.sin(values[OUTER["q"]]), sp.cos(values[OUTER["q"]])
        return values


def _one_inward(value: sp.Expr) -> sp.Expr:
    return (
        value.variable.at(value.offset - 1) if isinstance(value, Ref) and value.offset is not None else value
    )


def solved_variable(stations: int) -> Variable:
    """Return the scratch array of what a sweep has found."""
    return Variable("solved", Role.WORK, stations, "unknown of each station")


def prescribed_unknown(still: frozenset[str], loads: Loads) -> sp.Expr:
    """Return a prescribed base's unknown: its motion is known, unless the displacement itself is the unknown."""
    return loads.prescribed["q"] if "q" in still else sp.Integer(0)


def hub_unknown() -> Ref:
    """Return what a sweep has found of the base."""
    return local("hub_unknown", "unknown of the hub")


def _described(frame: Frame) -> dict[str, tuple[str, str]]:
    """Return words for what the walks carry."""
    found = {
        "unknown": ("unknown of a station", "1"),
    }
    for c in frame.coordinates:
        found[c.force] = ("force beyond this joint", c.force_unit)
        found[predicted_force(c).name] = ("force beyond this joint as predicted", c.force_unit)
        if not c.integrated:
            found[node(c).name] = (f"acceleration of a node along {c.name}", c.unit)
            found[change(c).name] = (f"change of a node's acceleration along {c.name}", c.unit)
    return found
