"""The planar arm's step as tangents need it: its slope taken at predicted forces, its factors kept."""

from __future__ import annotations

from dataclasses import dataclass, field

import sympy as sp

from tmm_gen.derive import planar_chain as chain
from tmm_gen.derive import planar_tangent as derived
from tmm_gen.derive import torsion_chain
from tmm_gen.derive.integrators.declaration import KINDS
from tmm_gen.derive.integrators.relations import AffineMotion
from tmm_gen.program.planar.loads import PlanarLoads
from tmm_gen.program.planar.scratch import lever, node, predicted, solved, swing
from tmm_gen.program.planar.step import PlanarStep
from tmm_gen.program.sensitivities.planar_walk import AXES, inner_loads, through_link, tip_forces
from tmm_gen.program.sensitivities.point import Point
from tmm_gen.program.statements import Assign, Loop, Order, Section
from tmm_gen.program.variables import Ref, Role, Variable, local

Place = tuple[int, int]
"""Stage, from 1, and iteration, from 0."""


@dataclass(frozen=True)
class SweepPoint:
    """What one sweep keeps, by what it is for.

    Parameters
    ----------
    answers : dict from str to sympy.Expr
        Of a joint: "x", "y", "from_inner", "inverse" pivot.
    columns, swings : dict from "x", "y" to sympy.Expr
        Change of the inner force, and of the outer end's acceleration, per unknown of the link.
    levers : dict from "sine", "cosine" to sympy.Expr
    tangent : LinkTangent
        Slopes of the link's law.
    hub : sympy.Expr
        Inverse pivot of the hub.
    point : Point
        Where all of it is kept.
    """

    answers: dict[str, sp.Expr]
    columns: dict[str, sp.Expr]
    swings: dict[str, sp.Expr]
    tangent: derived.LinkTangent
    hub: sp.Expr
    point: Point


@dataclass(frozen=True)
class TangentableStep(PlanarStep):
    """A step whose factors depend on predicted motion alone, not on what the sweep itself has found.

    It is as accurate as the other and costs twelve operations per link more; its exact derivative needs no
    derivatives of factors.
    """

    def _sweep(self, index: int, iteration: int, motion: AffineMotion) -> list[Section]:
        outward, geometry, *rest = super()._sweep(index, iteration, motion)
        return [outward, geometry, self._predicted_forces(self.loads[index - 1]), *rest]

    def _loads_of_slope(self) -> dict[sp.Symbol, sp.Expr]:
        n = self.layout.stations
        return {chain.LOAD_X: _load("x", n).at(), chain.LOAD_Y: _load("y", n).at()}

    def _predicted_forces(self, loads: PlanarLoads) -> Section:
        n = self.layout.stations
        nodes = {axis: node(axis, n) for axis in AXES}
        force = {axis: local(f"predicted_force_{axis}", unit="N") for axis in AXES}
        demands = tip_forces(self.layout, nodes, predicted("a", n).entry(n), loads)
        found, moved = through_link(self._symbols(), nodes, force)
        body = (
            *inner_loads(loads, force),
            *(Assign(_load(axis, n).at(), found[axis]) for axis in AXES),
            *moved,
        )
        return Section(
            "forces as predicted, and the loads they put on the lever arms",
            (
                *loads.statements(),
                *(Assign(force[axis], demands[f"force_{axis}"]) for axis in AXES),
                Loop(Order.INWARD, 0, n, body),
            ),
        )


@dataclass(frozen=True)
class LinearisedStep(TangentableStep):
    """The same step, which also keeps its point of linearisation and its factors.

    Parameters
    ----------
    kept : dict from Place to SweepPoint
        Filled while sections are built.
    """

    kept: dict[Place, SweepPoint] = field(default_factory=dict)

    def _keep_of_link(self, column_x: Ref, column_y: Ref, inverse: Ref) -> list[Assign]:
        n = self.layout.stations
        return [
            Assign(_column("x", n).at(), column_x),
            Assign(_column("y", n).at(), column_y),
            Assign(_inverse(n).at(), inverse),
        ]

    def _sweep(self, index: int, iteration: int, motion: AffineMotion) -> list[Section]:
        sections = super()._sweep(index, iteration, motion)
        loads = self.loads[index - 1]
        walked = (*self._solved_nodes(), *self._solved_forces(motion, loads))
        point = self._point(index, iteration, motion)
        self.kept[index, iteration] = point
        n = self.layout.stations
        at_stations = tuple(a for a in point.point.assignments() if a.target.variable.length is not None)
        once = tuple(a for a in point.point.assignments() if a.target.variable.length is None)
        keep = (*walked, *once, Loop(Order.INWARD, 0, n, at_stations))
        return [*sections, Section("what tangents need: motion and forces as solved, slopes, factors", keep)]

    def _solved_nodes(self) -> tuple[Assign | Loop, ...]:
        n = self.layout.stations
        change = {axis: local(f"solved_change_{axis}", unit="m/s^2") for axis in AXES}
        body = [
            statement
            for axis in AXES
            for statement in (
                Assign(change[axis], change[axis] + swing(axis, n).at() * solved(n).at()),
                Assign(_solved_node(axis, n).at(1), node(axis, n).at(1) + change[axis]),
            )
        ]
        return (
            *(Assign(change[axis], sp.Integer(0)) for axis in AXES),
            *(Assign(_solved_node(axis, n).entry(0), node(axis, n).entry(0)) for axis in AXES),
            Loop(Order.OUTWARD, 0, n, tuple(body)),
        )

    def _solved_forces(self, motion: AffineMotion, loads: PlanarLoads) -> tuple[Assign | Loop, ...]:
        n = self.layout.stations
        nodes = {axis: _solved_node(axis, n) for axis in AXES}
        force = {axis: local(f"solved_force_{axis}", unit="N") for axis in AXES}
        turning = predicted("a", n).entry(n) + self._gain(motion, "a") * solved(n).entry(n - 1)
        demands = tip_forces(self.layout, nodes, turning, loads)
        found, moved = through_link(self._symbols(), nodes, force)
        body = (
            *inner_loads(loads, force),
            *(Assign(_solved_load(axis, n).at(), found[axis]) for axis in AXES),
            *moved,
        )
        return (
            *(Assign(force[axis], demands[f"force_{axis}"]) for axis in AXES),
            Loop(Order.INWARD, 0, n, body),
        )

    def _point(self, index: int, iteration: int, motion: AffineMotion) -> SweepPoint:
        n = self.layout.stations
        sweeps = len(self.scheme.stages) * self.iterations
        point = Point(n, sweeps, (index - 1) * self.iterations + iteration + 1)
        symbols = {
            **self._symbols(),
            **{torsion_chain.GAINS[k]: self._gain(motion, k) for k in KINDS},
            derived.SOLVED: solved(n).at(),
            derived.PREDICTED_LOAD_X: _load("x", n).at(),
            derived.PREDICTED_LOAD_Y: _load("y", n).at(),
            chain.LOAD_X: _solved_load("x", n).at(),
            chain.LOAD_Y: _solved_load("y", n).at(),
        }
        for which in ("sine", "cosine"):
            point.at_station(
                f"lever_{which}", lever(which, n).at(), f"length times {which} of the predicted angle", "m"
            )
        answers = {
            name: value if value.is_number else point.at_station(f"answer_{name}", value, _ANSWERS[name])
            for name, value in self._kept_answers(self.impedances[index - 1]).items()
            if name != "own"
        }
        answers["inverse"] = point.at_station("inverse_pivot", _inverse(n).at(), "inverse of a joint's pivot")
        law = derived.link_tangent()

        def slopes(of: derived.Slopes, name: str, what: str) -> derived.Slopes:
            kept = (
                point.at_station(f"{name}_by_{by}", value.xreplace(symbols), f"{what} per {by}", "SI")
                for by, value in (("angle", of.angle), ("rate", of.rate), ("acceleration", of.acceleration))
            )
            return derived.Slopes(*kept)

        ends = {axis: f"acceleration of the outer end along {axis}" for axis in AXES}
        tangent = derived.LinkTangent(
            predicted_x=slopes(law.predicted_x, "predicted_x", f"predicted {ends['x']}"),
            predicted_y=slopes(law.predicted_y, "predicted_y", f"predicted {ends['y']}"),
            solved_x=slopes(law.solved_x, "solved_x", ends["x"]),
            solved_y=slopes(law.solved_y, "solved_y", ends["y"]),
            torque=slopes(law.torque, "torque", "torque at the inner end"),
            load_x=point.at_station("torque_by_load_x", law.load_x.xreplace(symbols), ""),
            load_y=point.at_station("torque_by_load_y", law.load_y.xreplace(symbols), ""),
            predicted_load_x=point.at_station(
                "torque_by_predicted_x",
                law.predicted_load_x.xreplace(symbols),
                "torque per predicted load along x",
                "m",
            ),
            predicted_load_y=point.at_station(
                "torque_by_predicted_y",
                law.predicted_load_y.xreplace(symbols),
                "torque per predicted load along y",
                "m",
            ),
        )
        return SweepPoint(
            answers=answers,
            columns={
                axis: point.at_station(
                    f"force_{axis}_per_unknown",
                    _column(axis, n).at(),
                    f"force along {axis} per unknown of the link",
                    "SI",
                )
                for axis in AXES
            },
            swings={
                axis: point.at_station(
                    f"swing_{axis}",
                    swing(axis, n).at(),
                    f"acceleration of the outer end along {axis} per unknown",
                    "m",
                )
                for axis in AXES
            },
            tangent=tangent,
            hub=point.scalar("hub_inverse_pivot", 1 / local("hub_pivot"), "inverse of the hub's pivot", "SI")
            if self.base == "motor"
            else sp.Integer(0),
            point=point,
        )


_ANSWERS = {
    "x": "answer to the joint's acceleration along x",
    "y": "answer to the joint's acceleration along y",
    "from_inner": "answer to the inner link's unknown",
}


def _load(axis: str, n: int) -> Variable:
    return Variable(
        f"predicted_load_{axis}", Role.WORK, n, f"load on each lever arm along {axis} as predicted", "N"
    )


def _solved_load(axis: str, n: int) -> Variable:
    return Variable(
        f"solved_load_{axis}", Role.WORK, n, f"load on each lever arm along {axis} as solved", "N"
    )


def _solved_node(axis: str, n: int) -> Variable:
    return Variable(
        f"solved_acceleration_{axis}",
        Role.WORK,
        n + 1,
        f"acceleration of the nodes along {axis} as solved",
        "m/s^2",
    )


def _column(axis: str, n: int) -> Variable:
    return Variable(f"column_{axis}", Role.WORK, n, f"force along {axis} per unknown of the link", "SI")


def _inverse(n: int) -> Variable:
    return Variable("inverse_of_pivot", Role.WORK, n, "inverse of each joint's pivot")
