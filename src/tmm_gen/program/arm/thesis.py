"""The thesis's own planar step and its first-order Taylor sibling, kept so that what they cost can be measured.

Both predict sines and cosines from the last instant (2-14, 2-15), linearise the square of the rate by 2-17 and
integrate the places of the nodes on their own (2-13): accelerations of nodes come from their places. ``frozen``
takes the predicted sines for the truth (2-26), so that no place answers to an unknown. ``taylor`` lets places and
lever arms follow the angle to first order.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import sympy as sp

from tmm_gen.derive import expansions
from tmm_gen.derive.integrators.declaration import KINDS, STEP, Kind, past, stage
from tmm_gen.derive.station.frame import COSINE, OUTER, SINE, SQUARE, Frame
from tmm_gen.derive.station.lets import Let
from tmm_gen.derive.station.reading import place, walk
from tmm_gen.derive.station.station import outward
from tmm_gen.program.arm.at_places import At
from tmm_gen.program.arm.at_state import AtState
from tmm_gen.program.arm.layout import Layout
from tmm_gen.program.arm.walks import Walks
from tmm_gen.program.motion import history_values, update_assignments
from tmm_gen.program.statements import Assign, Loop, Order, Section, Statement
from tmm_gen.program.variables import Ref, Role, Variable, local

_OLD: dict[Kind, sp.Symbol] = {"q": expansions.ANGLE, "v": expansions.RATE, "a": expansions.ACCELERATION}


class ThesisWalks(Walks):
    """The walks of eqs. 2-13 to 2-31 for an integrator of one stage; ``follows`` tells "taylor" from "frozen"."""

    follows = False

    def __init__(self, layout: Layout, prepared: Mapping[str, Variable], frame: Frame, *more: Any) -> None:
        follows = sp.Integer(self.follows)
        super().__init__(
            layout,
            prepared,
            replace(
                frame,
                turning=follows,
                square_slope=sp.diff(expansions.square_of_rate(), expansions.NEW_RATE),
                followed=follows * frame.gains["a"],
            ),
            *more,
        )

    def _values(self, parameter: At, inner: At, outer: At) -> dict[sp.Symbol, sp.Expr]:
        values = super()._values(parameter, inner, outer)
        values |= {symbol: self.stage.sources[past(kind)] for kind, symbol in _OLD.items()}
        values[expansions.SPAN] = sp.sympify(self.stage.scheme.stages[0].instant) * self.layout.step.ref
        values[expansions.NEW_RATE] = values[OUTER["v"]]
        return values

    def outward_motion(self) -> list[Statement]:
        """Walk out with places by predicted sines, and accelerations by the integrator applied to places."""
        here = self.at_station()
        sine, cosine = expansions.predicted_trigonometry()
        before = [
            Let(SINE, sine, "predicted sine"),
            Let(COSINE, cosine, "predicted cosine"),
            Let(SQUARE, expansions.square_of_rate(), "square of the rate (2-17)", "1/s^2"),
        ]
        found: list[Statement] = []
        for start, stop, elements in self.runs:
            lets = outward(elements, self.frame).lets
            self.scratch.describe(lets)
            found.append(Loop(Order.OUTWARD, start, stop, tuple(here.lines([*before, *lets]))))
        at = {axis: local(f"at_{axis}", f"place of the node along {axis}", "m") for axis in self.nodes}
        falls = self._falls()
        found += [Assign(at[axis], sp.Integer(0)) for axis in self.nodes]
        found += [Assign(v.entry(0), falls[axis]) for axis, v in self.nodes.items()]
        for start, stop, elements in self.runs:
            body: list[Assign] = []
            steps = self._place_steps(elements)
            for axis, variable in self.nodes.items():
                unknown = (at[axis] - self._offset(axis, "q")) / self._gain("q")
                value = self._gain("a") * unknown + self._offset(axis, "a")
                body.append(Assign(at[axis], at[axis] + here.value(steps[axis])))
                body.append(Assign(variable.at(1), sp.expand(value) + falls[axis]))
            found.append(Loop(Order.OUTWARD, start, stop, tuple(body)))
        return found

    def _place_steps(self, elements: tuple[Any, ...]) -> dict[str, sp.Expr]:
        """Return how far a station's elements reach, by lever arms."""
        from tmm_gen.derive.station.frame import primitive

        out = outward(elements, self.frame)
        carried = [c for c in self.frame.coordinates if not c.integrated]
        steps = dict.fromkeys(self.nodes, sp.Integer(0))
        for line in walk(elements, self.frame.coordinates, frozenset({"q"}), None):
            for symbol, value in line.values.items():  # type: ignore[union-attr]
                for c in carried:
                    if symbol == place(c, "q"):
                        steps[c.name] += out.values.written(primitive(value - symbol))
        return steps

    def _falls(self) -> dict[str, sp.Expr]:
        falls = dict.fromkeys(self.nodes, sp.Integer(0))
        falls[list(self.nodes)[-1]] = self.at_node(0).value(self.layout.row.fall)
        return falls

    def after_answer(self) -> list[Assign]:
        """Keep how far each node's acceleration has changed."""
        return [Assign(self._moved(axis).at(), self.scratch.ref(f"change_{axis}")) for axis in self.nodes]

    def after_update(self) -> list[Statement]:
        """Update places: their unknown is what makes their acceleration that of the node."""
        n, falls, index = self.layout.stations, self._falls(), self.stage.index
        statements: list[Statement] = []
        for axis, variable in self.nodes.items():
            state = self.layout.places[axis]
            acceleration = variable.at(1) + self._moved(axis).at() - falls[axis]
            unknown = local(f"unknown_{axis}", f"unknown of the node's place along {axis}")
            value = (acceleration - self._offset(axis, "a")) / self._gain("a")
            stages = {stage(k, index): self._gain(k) * unknown + self._offset(axis, k) for k in KINDS}
            at = {STEP: self.layout.step.ref, **history_values(state, lambda v: v.at()), **stages}
            new = {k: sp.expand(sp.sympify(self.stage.scheme.update[k]).subs(at)) for k in KINDS}
            body = (Assign(unknown, sp.expand(value)), *update_assignments(state, new, lambda v: v.at(), ""))
            statements.append(Loop(Order.OUTWARD, 0, n, body))
        return statements

    def _gain(self, kind: Kind) -> sp.Expr:
        return self.stage.motion.gain[kind].xreplace({STEP: self.layout.step.ref})

    def _offset(self, axis: str, kind: Kind) -> sp.Expr:
        values = history_values(self.layout.places[axis], lambda v: v.at())
        return self.stage.motion.offset[kind].subs({STEP: self.layout.step.ref, **values})

    def _moved(self, axis: str) -> Variable:
        doc = f"change of the node's acceleration along {axis}"
        return Variable(f"moved_{axis}", Role.WORK, self.layout.stations, doc, "m/s^2")


class TaylorWalks(ThesisWalks):
    """Places and lever arms follow the angle to first order."""

    follows = True


def start_places(layout: Layout) -> Section:
    """Return places, velocities and accelerations of the nodes that belong to the initial angles."""
    at_state = AtState(layout)
    carried = [c for c in layout.row.coordinates if not c.integrated]
    names: dict[tuple[str, str], Ref] = {
        (c.name, k): at_state.scratch.ref(place(c, k).name) for c in carried for k in KINDS
    }
    statements: list[Statement] = [Assign(name, sp.Integer(0)) for name in names.values()]
    kept = [
        Assign(variable.at(), names[c.name, p.kind] if p.lag == 0 else sp.Integer(0))
        for c in carried
        for p, variable in layout.places[c.name].items()
    ]
    for start, stop, elements in layout.row.runs():
        lines = walk(elements, layout.row.coordinates, frozenset(KINDS), None)
        body = [*at_state.at_station(None).lines(lines), *kept]
        statements.append(Loop(Order.OUTWARD, start, stop, tuple(body)))
    return Section("places of the nodes", tuple(statements))
