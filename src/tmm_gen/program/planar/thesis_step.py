"""The thesis's own planar step and its first-order Taylor sibling, kept so that what they cost can be measured.

Both predict sines and cosines from the last instant (2-14, 2-15), linearise the square of the rate by 2-17 and
integrate the places of the nodes on their own (2-13): accelerations of nodes come from their places. ``frozen``
takes the predicted sines for the truth (2-26), so that no place answers to an unknown. ``taylor`` lets places and
lever arms follow the angle to first order.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive import expansions
from tmm_gen.derive import planar_chain as chain
from tmm_gen.derive.integrators.declaration import KINDS, STEP, Past, past, stage
from tmm_gen.derive.integrators.relations import AffineMotion, affine_motion
from tmm_gen.program.motion import history_values, update_assignments
from tmm_gen.program.planar.layout import PlanarLayout
from tmm_gen.program.planar.scratch import joint_torque, predicted
from tmm_gen.program.planar.scratch import lever as lever_of
from tmm_gen.program.planar.scratch import node as node_of
from tmm_gen.program.planar.scratch import swing as swing_of
from tmm_gen.program.planar.step import PlanarStep
from tmm_gen.program.statements import Assign, Loop, Order, Section, Statement
from tmm_gen.program.variables import Ref, Role, Variable, local

_SINE, _COSINE = local("sine", "predicted sine"), local("cosine", "predicted cosine")
_END = {axis: local(f"end_{axis}", f"acceleration of the outer end along {axis}", "m/s^2") for axis in "xy"}
_OWN = {axis: local(f"own_{axis}", f"its change per unknown along {axis}", "m") for axis in "xy"}


@dataclass(frozen=True)
class ThesisStep(PlanarStep):
    """The step of eqs. 2-13 to 2-31 for an integrator of one stage.

    Parameters
    ----------
    follows : bool
        Whether places and lever arms follow the angle to first order ("taylor") or not at all ("frozen").
    """

    follows: bool = False

    @property
    def _motion(self) -> AffineMotion:
        return affine_motion(self.scheme, 1, self.unknown)

    def _sweep(self, index: int, iteration: int, motion: AffineMotion) -> list[Section]:
        outward, geometry, inward, base, back = super()._sweep(index, iteration, motion)
        del outward, geometry
        return [self._nodes(motion), self._answers(motion), inward, base, back]

    def _nodes(self, motion: AffineMotion) -> Section:
        """Return places by predicted sines, and accelerations of nodes by the integrator applied to places."""
        n = self.layout.stations
        h = self.layout.step.ref
        old = {
            expansions.ANGLE: self.sources[past("q")],
            expansions.RATE: self.sources[past("v")],
            expansions.ACCELERATION: self.sources[past("a")],
            expansions.SPAN: sp.sympify(self.scheme.stages[0].instant) * h,
        }
        sine, cosine = (e.xreplace(old) for e in expansions.predicted_trigonometry())
        length = self.layout.length.at()
        levers = (
            Assign(_SINE, sine),
            Assign(_COSINE, cosine),
            Assign(lever_of("sine", n).at(), length * _SINE),
            Assign(lever_of("cosine", n).at(), length * _COSINE),
        )
        falling = self.layout.gravity.ref if self.layout.gravity else sp.Integer(0)
        place = {axis: local(f"at_{axis}", f"place of the node along {axis}", "m") for axis in "xy"}
        before = [Assign(place[axis], sp.Integer(0)) for axis in "xy"]
        before.append(Assign(node_of("x", n).entry(0), sp.Integer(0)))
        before.append(Assign(node_of("y", n).entry(0), falling))
        body: list[Assign] = []
        for axis, which in (("x", "cosine"), ("y", "sine")):
            unknown = (place[axis] - self._offset(motion, axis, "q")) / self._gain(motion, "q")
            value = self._gain(motion, "a") * unknown + self._offset(motion, axis, "a")
            body.append(Assign(place[axis], place[axis] + lever_of(which, n).at()))
            body.append(Assign(node_of(axis, n).at(1), sp.expand(value) + (falling if axis == "y" else 0)))
        return Section(
            "places of the nodes by predicted sines, their accelerations by the integrator",
            (Loop(Order.OUTWARD, 0, n, levers), *before, Loop(Order.OUTWARD, 0, n, tuple(body))),
        )

    def _answers(self, motion: AffineMotion) -> Section:
        n = self.layout.stations
        lever_sine, lever_cosine = lever_of("sine", n).at(), lever_of("cosine", n).at()
        joint = chain.joint_sweep()
        ends = {
            chain.INNER_ANGLE: predicted("q", n).at(0),
            chain.OUTER_ANGLE: predicted("q", n).at(1),
            chain.INNER_RATE: predicted("v", n).at(0),
            chain.OUTER_RATE: predicted("v", n).at(1),
        }
        # the place of an outer end follows its own link by l (-s, c) P_q du, its acceleration by P_a / P_q of that
        follow = self._gain(motion, "a") if self.follows else sp.Integer(0)
        body = (
            Assign(swing_of("x", n).at(), -follow * lever_sine),
            Assign(swing_of("y", n).at(), follow * lever_cosine),
            Assign(joint_torque(n).at(), joint.known_torque.xreplace({**super()._symbols(), **ends})),
        )
        return Section(
            "answers of places, and the predicted joint torques", (Loop(Order.OUTWARD, 0, n, body),)
        )

    def _symbols(self) -> dict[sp.Symbol, sp.Expr]:
        symbols = super()._symbols()
        return {
            **symbols,
            chain.OUTER_A_X: _END["x"],
            chain.OUTER_A_Y: _END["y"],
            chain.OWN_X: _OWN["x"],
            chain.OWN_Y: _OWN["y"],
        }

    def _before_link(self, motion: AffineMotion) -> list[Assign]:
        """Return the swing of the carried mass: rate squared by 2-17, sines as predicted or to first order."""
        n = self.layout.stations
        law, symbols = chain.link_law(), super()._symbols()
        old_rate, old_acceleration = self.sources[past("v")], self.sources[past("a")]
        named = {
            expansions.NEW_RATE: predicted("v", n).at(1),
            expansions.RATE: old_rate,
            expansions.ACCELERATION: old_acceleration,
            expansions.SPAN: sp.sympify(self.scheme.stages[0].instant) * self.layout.step.ref,
        }
        square = local("square", "square of the rate (2-17)", "1/s^2")
        squared = {chain.RATE**2: square}
        turn = self._gain(motion, "q") if self.follows else sp.Integer(0)
        tangential, turning = local("tangential"), local("turning")
        slope = sp.diff(expansions.square_of_rate(), expansions.NEW_RATE).xreplace(named)
        gains = {chain.TANGENTIAL: tangential, chain.TURNING: turning}
        sweep = chain.link_sweep()
        return [
            Assign(square, expansions.square_of_rate().xreplace(named)),
            Assign(_END["x"], law.outer_x.xreplace(squared).xreplace(symbols)),
            Assign(_END["y"], law.outer_y.xreplace(squared).xreplace(symbols)),
            Assign(tangential, self._gain(motion, "a") - turn * square),
            Assign(turning, turn * old_acceleration + slope * self._gain(motion, "v")),
            Assign(_OWN["x"], sweep.gain_x.xreplace({**symbols, **gains})),
            Assign(_OWN["y"], sweep.gain_y.xreplace({**symbols, **gains})),
        ]

    def _torque_gain(self, motion: AffineMotion) -> sp.Expr:
        return self._gain(motion, "q") if self.follows else sp.Integer(0)

    def _after_unknown(self, changes: dict[str, Ref]) -> list[Assign]:
        n = self.layout.stations
        return [Assign(_moved(axis, n).at(), changes[axis]) for axis in "xy"]

    def _after_update(self, index: int, motion: AffineMotion) -> list[Statement]:
        """Update places: their unknown is what makes their acceleration that of the node."""
        n = self.layout.stations
        falling = self.layout.gravity.ref if self.layout.gravity else sp.Integer(0)
        statements: list[Statement] = []
        for axis in "xy":
            state = self.layout.places[axis]
            acceleration = node_of(axis, n).at(1) + _moved(axis, n).at() - (falling if axis == "y" else 0)
            unknown = local(f"unknown_{axis}", f"unknown of the node's place along {axis}")
            value = (acceleration - self._offset(motion, axis, "a")) / self._gain(motion, "a")
            stages = {
                stage(k, index): self._gain(motion, k) * unknown + self._offset(motion, axis, k)
                for k in KINDS
            }
            at = {STEP: self.layout.step.ref, **history_values(state, lambda v: v.at()), **stages}
            new = {k: sp.expand(sp.sympify(self.scheme.update[k]).subs(at)) for k in KINDS}
            body = (Assign(unknown, sp.expand(value)), *update_assignments(state, new, lambda v: v.at(), ""))
            statements.append(Loop(Order.OUTWARD, 0, n, body))
        return statements

    def _offset(self, motion: AffineMotion, axis: str, kind: str) -> sp.Expr:
        values = history_values(self.layout.places[axis], lambda v: v.at())
        return motion.offset[kind].subs({STEP: self.layout.step.ref, **values})  # type: ignore[index]


def start_places(layout: PlanarLayout) -> Section:
    """Return places, velocities and accelerations of the nodes that belong to the initial angles."""
    n = layout.stations
    angle, rate, acceleration = (layout.state[Past(k, 0)].at() for k in KINDS)
    length = layout.length.at()
    law = chain.link_law()
    names = {(axis, k): local(f"start_{axis}_{k}") for axis in "xy" for k in KINDS}
    swing = {
        chain.LEVER_SINE: length * sp.sin(angle),
        chain.LEVER_COSINE: length * sp.cos(angle),
        chain.RATE: rate,
        chain.ACCELERATION: acceleration,
        chain.A_X: names["x", "a"],
        chain.A_Y: names["y", "a"],
    }
    body = [
        Assign(names["x", "q"], names["x", "q"] + length * sp.cos(angle)),
        Assign(names["y", "q"], names["y", "q"] + length * sp.sin(angle)),
        Assign(names["x", "v"], names["x", "v"] - length * rate * sp.sin(angle)),
        Assign(names["y", "v"], names["y", "v"] + length * rate * sp.cos(angle)),
        Assign(names["x", "a"], law.outer_x.xreplace(swing)),
        Assign(names["y", "a"], law.outer_y.xreplace(swing)),
    ]
    for axis in "xy":
        for p, variable in layout.places[axis].items():
            body.append(Assign(variable.at(), names[axis, p.kind] if p.lag == 0 else sp.Integer(0)))
    zeros = tuple(Assign(name, sp.Integer(0)) for name in names.values())
    return Section("places of the nodes", (*zeros, Loop(Order.OUTWARD, 0, n, tuple(body))))


def _moved(axis: str, n: int) -> Variable:
    return Variable(f"moved_{axis}", Role.WORK, n, f"change of the node's acceleration along {axis}", "m/s^2")
