"""The tangent of a planar arm's step: one sweep per sweep of the step, with the factors the step has kept."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields

import sympy as sp

from tmm_gen.derive import planar_chain as chain
from tmm_gen.derive import torsion_chain
from tmm_gen.derive.elements import torsion
from tmm_gen.derive.integrators.declaration import KINDS
from tmm_gen.derive.integrators.relations import AffineMotion
from tmm_gen.derive.planar_tangent import Slopes
from tmm_gen.program.passes.hoist import Hoister
from tmm_gen.program.passes.prune import prune
from tmm_gen.program.passes.rewrite import map_values
from tmm_gen.program.planar.loads import PlanarLoads
from tmm_gen.program.planar.scratch import BASE, predicted, swing
from tmm_gen.program.planar.step import PlanarStep
from tmm_gen.program.sensitivities.chain import LINEARISE_DOC, TANGENT_DOC
from tmm_gen.program.sensitivities.planar_step import LinearisedStep, Place, SweepPoint, TangentableStep
from tmm_gen.program.sensitivities.planar_walk import AXES, inner_loads, through_link, tip_forces
from tmm_gen.program.sensitivities.twins import as_tangent, changes_of
from tmm_gen.program.statements import Assign, Loop, Order, Routine, Section, Sensitivities
from tmm_gen.program.variables import Role, Variable, local

_FORCE = {axis: local(f"force_{axis}", unit="N") for axis in AXES}
_PREDICTED = {axis: local(f"predicted_force_{axis}", unit="N") for axis in AXES}
_TORQUE = local("torque", unit="N m")


@dataclass(frozen=True)
class PlanarTangent(PlanarStep):
    """The step's own prediction and update, on changes; sweeps whose factors are known.

    Parameters
    ----------
    kept : dict from Place to SweepPoint
        What each sweep of the step has kept.
    """

    kept: Mapping[Place, SweepPoint]

    def _sweep(self, index: int, iteration: int, motion: AffineMotion) -> list[Section]:
        point = self.kept[index, iteration]
        loads, impedance = self.loads[index - 1], self.impedances[index - 1]
        return [
            self._nodes(point),
            self._inward_changes(point, impedance, loads),
            self._base_change(point, motion, loads),
            self._outward_changes(point, impedance),
        ]

    def _nodes(self, point: SweepPoint) -> Section:
        n = self.layout.stations
        law = point.tangent
        slopes: dict[str, tuple[str, Slopes]] = {
            "predicted_node_x": ("x", law.predicted_x),
            "predicted_node_y": ("y", law.predicted_y),
            "solved_node_x": ("x", law.solved_x),
            "solved_node_y": ("y", law.solved_y),
        }
        carried = {name: local(name, unit="m/s^2") for name in slopes}
        body: list[Assign] = []
        for name, (axis, by) in slopes.items():
            moved = (
                by.angle * predicted("q", n).at(1)
                + by.rate * predicted("v", n).at(1)
                + by.acceleration * predicted("a", n).at(1)
            )
            body += [
                Assign(carried[name], carried[name] + moved),
                Assign(_node(name.split("_")[0], axis, n).at(1), carried[name]),
            ]
        return Section(
            "accelerations of the nodes, as predicted and as solved but for the unknowns' own changes",
            (
                *(Assign(carried[name], sp.Integer(0)) for name in slopes),
                *(
                    Assign(_node(name.split("_")[0], axis, n).entry(BASE), sp.Integer(0))
                    for name, (axis, _) in slopes.items()
                ),
                Loop(Order.OUTWARD, 0, n, tuple(body)),
            ),
        )

    def _inward_changes(self, point: SweepPoint, impedance: sp.Expr, loads: PlanarLoads) -> Section:
        n = self.layout.stations
        law, joint = point.tangent, chain.joint_sweep()
        solved_nodes = {axis: _node("solved", axis, n) for axis in AXES}
        predicted_nodes = {axis: _node("predicted", axis, n) for axis in AXES}
        turning = predicted("a", n).entry(n)
        demands = tip_forces(self.layout, solved_nodes, turning, loads)
        as_predicted = tip_forces(self.layout, predicted_nodes, turning, loads)
        symbols = self._symbols()
        load, moved = through_link(symbols, solved_nodes, _FORCE)
        predicted_load, predicted_moved = through_link(symbols, predicted_nodes, _PREDICTED)
        named = {axis: local(f"load_{axis}", unit="N") for axis in AXES}
        predicted_named = {axis: local(f"predicted_load_{axis}", unit="N") for axis in AXES}
        torque = (
            _TORQUE
            + law.torque.angle * predicted("q", n).at(1)
            + law.torque.rate * predicted("v", n).at(1)
            + law.torque.acceleration * predicted("a", n).at(1)
            + law.load_x * named["x"]
            + law.load_y * named["y"]
            + law.predicted_load_x * predicted_named["x"]
            + law.predicted_load_y * predicted_named["y"]
        )
        ends = {
            chain.INNER_ANGLE: predicted("q", n).at(0),
            chain.OUTER_ANGLE: predicted("q", n).at(1),
            chain.INNER_RATE: predicted("v", n).at(0),
            chain.OUTER_RATE: predicted("v", n).at(1),
        }
        known, own = local("joint_torque", unit="N m"), local("own_answer")
        body: list[Assign] = [*inner_loads(loads, _FORCE), *inner_loads(loads, _PREDICTED)]
        if "torque" in loads.inner:
            body.append(Assign(_TORQUE, _TORQUE - loads.array("torque").at()))
        body += [Assign(named[axis], load[axis]) for axis in AXES]
        body += [Assign(predicted_named[axis], predicted_load[axis]) for axis in AXES]
        body += [
            Assign(_TORQUE, torque),
            *moved,
            *predicted_moved,
            Assign(known, joint.known_torque.xreplace({**symbols, **ends})),
            Assign(own, point.answers["inverse"] * (known - _TORQUE)),
            Assign(self._kept_answers(impedance)["own"], own),
            *(Assign(_FORCE[axis], _FORCE[axis] + point.columns[axis] * own) for axis in AXES),
            Assign(_TORQUE, known - impedance * own),
        ]
        return Section(
            "sweep inward with the factors of the step",
            (
                *loads.statements(),
                *(Assign(_FORCE[axis], demands[f"force_{axis}"]) for axis in AXES),
                *(Assign(_PREDICTED[axis], as_predicted[f"force_{axis}"]) for axis in AXES),
                Assign(_TORQUE, demands["torque"]),
                Loop(Order.INWARD, 0, n, tuple(body)),
            ),
        )

    def _base_change(self, point: SweepPoint, motion: AffineMotion, loads: PlanarLoads) -> Section:
        if self.base != "motor":
            return self._at_base(motion, loads)
        n = self.layout.stations
        law = torsion_chain.hub_law()
        assert self.layout.hub_inertia is not None
        hub = {
            torsion.INERTIA: self.layout.hub_inertia.ref,
            torsion.GROUND_DAMPING: self.layout.hub_damping.ref if self.layout.hub_damping else sp.Integer(0),
            **{torsion_chain.INNER[k]: predicted(k, n).entry(BASE) for k in KINDS},
        }
        unknown, hub_unknown = (
            local("unknown", "increment of the unknown"),
            local("hub_unknown", "increment of the hub's unknown"),
        )
        value = (loads.base - _TORQUE - law.known.xreplace(hub)) * point.hub
        return Section("the hub", (Assign(unknown, value), Assign(hub_unknown, unknown)))

    def _outward_changes(self, point: SweepPoint, impedance: sp.Expr) -> Section:
        n = self.layout.stations
        own = self._kept_answers(impedance)
        known = {own[name]: point.answers[name] for name in ("x", "y", "from_inner")}
        known |= {swing(axis, n).at(): point.swings[axis] for axis in AXES}
        outward = Routine("", "", (self._outward(impedance),))
        return map_values(outward, lambda value: value.xreplace(known)).sections[0]


def planar_sensitivities(
    step: TangentableStep,
    after: tuple[Section, ...],
    state: tuple[Variable, ...],
    inputs: tuple[Variable, ...],
    hoister: Hoister,
) -> Sensitivities:
    """Return the sensitivities of a planar arm's main step.

    Parameters
    ----------
    step : TangentableStep
        Builds the step itself.
    after : tuple of Section
        What the step does last, linear too.
    state, inputs : tuple of Variable
        Of the program.
    hoister : Hoister
        Of the program: what is bound early moves to prepare.
    """
    own = {f.name: getattr(step, f.name) for f in fields(step)}
    linearised = LinearisedStep(**own)
    linearise = Routine("linearise", LINEARISE_DOC, (*linearised.sections(), *after))
    tangent = Routine("tangent", TANGENT_DOC, PlanarTangent(**own, kept=linearised.kept).sections() + after)
    tangent = prune(as_tangent(hoister.hoist(tangent)), frozenset(changes_of(state)))
    needed = frozenset(v for v in tangent.read() if v.role is Role.POINT)
    point = [v for kept in linearised.kept.values() for v in kept.point.variables if v in needed]
    return Sensitivities(
        point=tuple(point),
        state=changes_of(state),
        inputs=changes_of(inputs),
        linearise=prune(hoister.hoist(linearise), frozenset(state) | needed),
        tangent=tangent,
    )


def _node(which: str, axis: str, n: int) -> Variable:
    return Variable(
        f"{which}_acceleration_{axis}",
        Role.WORK,
        n + 1,
        f"acceleration of the nodes along {axis}, {which}",
        "m/s^2",
    )
