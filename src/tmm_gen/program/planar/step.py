"""One step of a planar arm: per stage, predict, move outward, sweep inward, solve the base, sweep outward.

This is the linearisation called ``newton``: the exact equations linearised about the predicted angle, rate and
acceleration of each link. Each further iteration linearises about the result of the one before.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive import planar_chain as chain
from tmm_gen.derive import torsion_chain
from tmm_gen.derive.elements import planar as element
from tmm_gen.derive.elements import torsion
from tmm_gen.derive.integrators.declaration import KINDS, STEP, Kind, Past, Scheme, past, stage
from tmm_gen.derive.integrators.relations import AffineMotion, Unknown, affine_motion
from tmm_gen.program.fields import MOTION_NAMES
from tmm_gen.program.motion import history_values, kept_stage_values, stage_variable, update_assignments
from tmm_gen.program.planar.layout import PlanarLayout
from tmm_gen.program.planar.loads import PlanarLoads
from tmm_gen.program.statements import Assign, Loop, Order, Require, Section, Statement
from tmm_gen.program.variables import Ref, Role, Variable, local

BASE = 0
"""Index of the base among nodes; link j lies between nodes j and j + 1."""

_S = [[local(f"impedance_{i}{k}") for k in "xyu"] for i in "xyu"]
_E = [
    local("force_x", "force beyond this joint", "N"),
    local("force_y", unit="N"),
    local("torque", unit="N m"),
]
_INNER = [[local(f"link_{i}{k}") for k in "xyu"] for i in "xyu"]
_UNKNOWN = local("unknown", "increment of the unknown")
_D_AX, _D_AY = local("change_x", unit="m/s^2"), local("change_y", unit="m/s^2")
_HUB_UNKNOWN = local("hub_unknown", "increment of the hub's unknown")


@dataclass(frozen=True)
class PlanarStep:
    """Builds the sections of one scheme's step.

    Parameters
    ----------
    layout : PlanarLayout
        The arm's variables.
    shared : mapping from sympy.Symbol to sympy.Expr
        Combinations of parameters prepared once: carried mass, inner mass, inertia about the pin.
    impedances : sequence of sympy.Expr
        Joint impedance ``K`` of each stage.
    loads : sequence of PlanarLoads
        Inputs, one for each stage.
    base : str
        "clamp", "motor" or "prescribed".
    sources, hub_sources : mapping from sympy.Symbol to sympy.Expr
        Where history is read from.
    iterations : int
        Sweeps per stage.
    """

    layout: PlanarLayout
    shared: Mapping[sp.Symbol, sp.Expr]
    impedances: tuple[sp.Expr, ...]
    loads: tuple[PlanarLoads, ...]
    base: str
    scheme: Scheme
    unknown: Unknown
    sources: Mapping[sp.Symbol, sp.Expr]
    hub_sources: Mapping[sp.Symbol, sp.Expr]
    iterations: int

    def sections(self) -> tuple[Section, ...]:
        """Return the whole step."""
        count = len(self.scheme.stages)
        motions = [affine_motion(self.scheme, i + 1, self.unknown) for i in range(count)]
        predictions = [predicted_motion(motion, i) for i, motion in enumerate(motions)]
        kept = kept_stage_values(
            self.scheme, {(i, k): p[k] for i, p in enumerate(predictions) for k in KINDS}
        )
        sections: list[Section] = []
        for index, (motion, prediction) in enumerate(zip(motions, predictions, strict=True), start=1):
            title = f"Stage {index} of {count}: " if count > 1 else ""
            sections.append(Section(title + "predicted motion", tuple(self._predict(prediction))))
            for iteration in range(self.iterations):
                again = f"iteration {iteration + 1}: " if self.iterations > 1 else ""
                sections += [
                    Section(title + again + s.title, s.statements)
                    for s in self._sweep(index, iteration, motion)
                ]
                if iteration + 1 < self.iterations:
                    sections.append(
                        Section(title + again + "improved prediction", tuple(self._improve(motion)))
                    )
            sections.append(self._finish(title, index, motion, kept, last=index == count))
        return tuple(s for s in sections if s.statements)

    # -- prediction ----------------------------------------------------------------------------------------

    def _predict(self, prediction: Mapping[Kind, sp.Expr]) -> list[Statement]:
        n = self.layout.stations
        at_links, at_hub = self._values("", n), self._values("hub_", None)
        body, base = [], []
        for kind in KINDS:
            variable = predicted(kind, n)
            body.append(Assign(variable.at(1), prediction[kind].xreplace(at_links)))
            value = sp.Integer(0) if self.base == "clamp" else prediction[kind].xreplace(at_hub)
            base.append(Assign(variable.entry(BASE), value))
        return [*base, Loop(Order.OUTWARD, 0, n, tuple(body))]

    def _improve(self, motion: AffineMotion) -> list[Statement]:
        n = self.layout.stations
        body, base = [], []
        for kind in KINDS:
            gain = self._gain(motion, kind)
            ref, entry = predicted(kind, n).at(1), predicted(kind, n).entry(BASE)
            body.append(Assign(ref, ref + gain * solved(n).at()))
            base.append(Assign(entry, entry + gain * _HUB_UNKNOWN))
        moved = base if self.base != "clamp" else []
        return [*moved, Loop(Order.OUTWARD, 0, n, tuple(a for a in body if a.value != a.target))]

    def _values(self, prefix: str, length: int | None) -> dict[sp.Symbol, sp.Expr]:
        earlier = range(1, len(self.scheme.stages))
        stages = {stage(k, i): stage_variable(k, i, prefix, length).at() for k in KINDS for i in earlier}
        return {STEP: self.layout.step.ref, **(self.hub_sources if prefix else self.sources), **stages}

    def _gain(self, motion: AffineMotion, kind: Kind) -> sp.Expr:
        return motion.gain[kind].xreplace({STEP: self.layout.step.ref})

    # -- sweep ---------------------------------------------------------------------------------------------

    def _sweep(self, index: int, iteration: int, motion: AffineMotion) -> list[Section]:
        loads, impedance = self.loads[index - 1], self.impedances[index - 1]
        return [
            self._outward_motion(),
            self._geometry(motion),
            self._inward(motion, impedance, loads),
            self._at_base(motion, loads),
            self._outward(impedance),
        ]

    def _symbols(self) -> dict[sp.Symbol, sp.Expr]:
        """Map the derivation's symbols to this arm's variables at link j."""
        n = self.layout.stations
        return {
            **self.shared,
            STEP: self.layout.step.ref,
            element.LENGTH: self.layout.length.at(),
            element.MASS: self.layout.mass.at(),
            element.STIFFNESS: self.layout.stiffness.at(),
            element.DAMPING: self.layout.damping.at() if self.layout.damping else sp.Integer(0),
            chain.LEVER_SINE: lever("sine", n).at(),
            chain.LEVER_COSINE: lever("cosine", n).at(),
            chain.RATE: predicted("v", n).at(1),
            chain.ACCELERATION: predicted("a", n).at(1),
            chain.A_X: node("x", n).at(0),
            chain.A_Y: node("y", n).at(0),
            chain.OUTER_A_X: node("x", n).at(1),
            chain.OUTER_A_Y: node("y", n).at(1),
            chain.GAIN_X: swing("x", n).at(),
            chain.GAIN_Y: swing("y", n).at(),
            chain.OWN_X: swing("x", n).at(),
            chain.OWN_Y: swing("y", n).at(),
            **{chain.S[i, k]: _S[i][k] for i in range(3) for k in range(3)},
            **{chain.E[i]: _E[i] for i in range(3)},
        }

    def _outward_motion(self) -> Section:
        n = self.layout.stations
        law, symbols = chain.link_law(), self._symbols()
        angle = predicted("q", n).at(1)
        levers = (
            Assign(lever("sine", n).at(), law.lever_sine.xreplace({**symbols, chain.SINE: sp.sin(angle)})),
            Assign(
                lever("cosine", n).at(), law.lever_cosine.xreplace({**symbols, chain.COSINE: sp.cos(angle)})
            ),
        )
        ax, ay = local("node_x", unit="m/s^2"), local("node_y", unit="m/s^2")
        carried = {**symbols, chain.A_X: ax, chain.A_Y: ay}
        square = local("square", "square of the rate", "1/s^2")
        body = (
            Assign(square, predicted("v", n).at(1) ** 2),
            Assign(ax, law.outer_x.xreplace(carried).xreplace({predicted("v", n).at(1) ** 2: square})),
            Assign(ay, law.outer_y.xreplace(carried).xreplace({predicted("v", n).at(1) ** 2: square})),
            Assign(node("x", n).at(1), ax),
            Assign(node("y", n).at(1), ay),
        )
        falling = self.layout.gravity.ref if self.layout.gravity else sp.Integer(0)
        return Section(
            "accelerations of the nodes"
            + (", seen from a falling frame: gravity is the base's own" if self.layout.gravity else ""),
            (
                Loop(Order.OUTWARD, 0, n, levers),
                Assign(ax, sp.Integer(0)),
                Assign(ay, falling),
                Assign(node("x", n).entry(BASE), ax),
                Assign(node("y", n).entry(BASE), ay),
                Loop(Order.OUTWARD, 0, n, body),
            ),
        )

    def _geometry(self, motion: AffineMotion) -> Section:
        n = self.layout.stations
        law, joint = chain.link_sweep(), chain.joint_sweep()
        gains = {torsion_chain.GAINS[k]: self._gain(motion, k) for k in KINDS}
        symbols = {**self._symbols(), **gains}
        across, along = law.tangential.xreplace(symbols), law.turning.xreplace(symbols)
        tangential = across if across.is_number else local("tangential")
        turning = along if along.is_number else local("turning")
        swung = {**symbols, chain.TANGENTIAL: tangential, chain.TURNING: turning}
        ends = {
            chain.INNER_ANGLE: predicted("q", n).at(0),
            chain.OUTER_ANGLE: predicted("q", n).at(1),
            chain.INNER_RATE: predicted("v", n).at(0),
            chain.OUTER_RATE: predicted("v", n).at(1),
        }
        body = (
            *(
                Assign(name, value)
                for name, value in ((tangential, across), (turning, along))
                if name != value
            ),
            Assign(swing("x", n).at(), law.gain_x.xreplace(swung)),
            Assign(swing("y", n).at(), law.gain_y.xreplace(swung)),
            Assign(_joint_torque(n).at(), joint.known_torque.xreplace({**symbols, **ends})),
        )
        return Section(
            "how each link's outer end answers to its unknown, and the predicted joint torques",
            (Loop(Order.OUTWARD, 0, n, body),),
        )

    def _inward(self, motion: AffineMotion, impedance: sp.Expr, loads: PlanarLoads) -> Section:
        n = self.layout.stations
        law, joint = chain.link_sweep(), chain.joint_sweep()
        gains = {torsion_chain.GAINS[k]: self._gain(motion, k) for k in KINDS}
        gains[torsion_chain.GAINS["q"]] = self._torque_gain(motion)
        symbols = {**self._symbols(), **gains}
        load_x, load_y = local("load_x", unit="N"), local("load_y", unit="N")
        column = [local(f"outer_{k}") for k in "xyu"]
        named = {**symbols, chain.LOAD_X: load_x, chain.LOAD_Y: load_y}
        named |= dict(zip(chain.OUTER_COLUMN, column, strict=True))
        body: list[Assign | Require] = []
        for i, component in enumerate(("force_x", "force_y", "torque")):
            if component in loads.inner:
                body.append(Assign(_E[i], _E[i] - loads.array(component).at()))
        at_bias = {chain.F_X: _E[0], chain.F_Y: _E[1], chain.TORQUE: _E[2]}
        laws = chain.link_law()
        body += self._before_link(motion)
        body += [Assign(column[i], law.outer[i].xreplace(named)) for i in range(3)]
        body += [
            Assign(load_x, laws.load_x.xreplace({**symbols, **at_bias})),
            Assign(load_y, laws.load_y.xreplace({**symbols, **at_bias})),
        ]
        slopes = {**named, **self._loads_of_slope()}
        body += [
            Assign(_INNER[i][k], law.impedance[i, k].xreplace(slopes)) for i in (2, 0, 1) for k in range(3)
        ]
        body += [Assign(_E[i], law.bias[i].xreplace(named)) for i in (2, 0, 1)]
        # the joint: one scalar pivot
        pivot, inverse = local("pivot"), local("inverse_pivot")
        turned = {
            chain.JOINT_IMPEDANCE: impedance,
            chain.JOINT_TORQUE: _joint_torque(n).at(),
            **{chain.S[i, k]: _INNER[i][k] for i in range(3) for k in range(3)},
            **{chain.E[i]: _E[i] for i in range(3)},
        }
        kept = self._kept_answers(impedance)
        answers = {
            "x": -joint.unknown.coeff(chain.D_A_X),
            "y": -joint.unknown.coeff(chain.D_A_Y),
            "from_inner": joint.unknown.coeff(chain.INNER_UNKNOWN),
        }
        own = joint.unknown.xreplace(
            dict.fromkeys((chain.D_A_X, chain.D_A_Y, chain.INNER_UNKNOWN), sp.Integer(0))
        )
        body += [
            Assign(pivot, joint.pivot.xreplace(turned)),
            Require(pivot),
            Assign(inverse, 1 / pivot),
            *self._keep_of_link(_INNER[0][2], _INNER[1][2], inverse),
            Assign(kept["own"], inverse * own.xreplace(turned)),
            *(
                Assign(kept[name], inverse * value.xreplace(turned))
                for name, value in answers.items()
                if kept[name]
            ),
        ]
        # put the link's unknown back into its forces: M = K (u_inner - u) + w, F_i = S_i k + e_i
        for i in range(2):
            body += [
                Assign(_S[i][0], _INNER[i][0] - _INNER[i][2] * kept["x"]),
                Assign(_S[i][1], _INNER[i][1] - _INNER[i][2] * kept["y"]),
                Assign(_S[i][2], _INNER[i][2] * kept["from_inner"]),
                Assign(_E[i], _E[i] + _INNER[i][2] * kept["own"]),
            ]
        body += [
            Assign(_S[2][0], impedance * kept["x"]),
            Assign(_S[2][1], impedance * kept["y"]),
            Assign(_S[2][2], _INNER[2][2] * kept["from_inner"]),
            Assign(_E[2], _joint_torque(n).at() - impedance * kept["own"]),
        ]
        return Section(
            "sweep inward: force beyond each joint as an affine function of the motion at it",
            (*loads.statements(), *self._tip(motion, loads), Loop(Order.INWARD, 0, n, tuple(body))),
        )

    def _kept_answers(self, impedance: sp.Expr) -> dict[str, sp.Expr]:
        """Return what the inward sweep keeps for the outward one; a joint without impedance hands on nothing."""
        n = self.layout.stations
        kept: dict[str, sp.Expr] = {name: _kept(name, n).at() for name in ("own", "x", "y", "from_inner")}
        return kept if impedance != 0 else {**kept, "from_inner": sp.Integer(0)}

    def _tip(self, motion: AffineMotion, loads: PlanarLoads) -> list[Assign]:
        n = self.layout.stations
        law = chain.tip_law()
        masses = {
            element.TIP_MASS: self.layout.tip_mass.ref if self.layout.tip_mass else sp.Integer(0),
            element.TIP_INERTIA: self.layout.tip_inertia.ref if self.layout.tip_inertia else sp.Integer(0),
        }
        at_tip = {
            chain.A_X: node("x", n).entry(n),
            chain.A_Y: node("y", n).entry(n),
            chain.ACCELERATION: predicted("a", n).entry(n),
        }
        forces = [f.xreplace(masses) for f in (law.force_x, law.force_y, law.torque)]
        variables = (chain.A_X, chain.A_Y, chain.ACCELERATION)
        assigns = []
        for i, force in enumerate(forces):
            for k, variable in enumerate(variables):
                slope = sp.diff(force, variable) * (self._gain(motion, "a") if k == 2 else 1)
                assigns.append(Assign(_S[i][k], slope))
        for i, (force, component) in enumerate(zip(forces, ("force_x", "force_y", "torque"), strict=True)):
            assigns.append(Assign(_E[i], force.xreplace(at_tip) - loads.tip[component]))
        return assigns

    def _at_base(self, motion: AffineMotion, loads: PlanarLoads) -> Section:
        n = self.layout.stations
        if self.base == "clamp":
            return Section("the base does not move", (Assign(_UNKNOWN, sp.Integer(0)),))
        statements: list[Statement] = []
        if self.base == "prescribed":
            gain = self._gain(motion, "q")
            value = (loads.angle - predicted("q", n).entry(BASE)) / gain if gain != 0 else sp.Integer(0)
            statements.append(Assign(_UNKNOWN, value))
        else:
            law = torsion_chain.hub_law()
            assert self.layout.hub_inertia is not None
            hub = {
                torsion.INERTIA: self.layout.hub_inertia.ref,
                torsion.GROUND_DAMPING: self.layout.hub_damping.ref
                if self.layout.hub_damping
                else sp.Integer(0),
                # the chain counts the torque on the inner side, the arm that on the outer one
                torsion_chain.IMPEDANCE: -_S[2][2],
                **{torsion_chain.GAINS[k]: self._gain(motion, k) for k in KINDS},
                **{torsion_chain.INNER[k]: predicted(k, n).entry(BASE) for k in KINDS},
            }
            pivot = local("hub_pivot")
            known = law.known.xreplace(hub)
            statements += [
                Assign(pivot, law.pivot.xreplace(hub)),
                Require(pivot),
                Assign(_UNKNOWN, (loads.base - _E[2] - known) / pivot),
            ]
        return Section("the hub", (*statements, Assign(_HUB_UNKNOWN, _UNKNOWN)))

    def _outward(self, impedance: sp.Expr) -> Section:
        n = self.layout.stations
        kept = self._kept_answers(impedance)
        unknown = kept["from_inner"] * _UNKNOWN + kept["own"] - kept["x"] * _D_AX - kept["y"] * _D_AY
        body = (
            Assign(_UNKNOWN, unknown),
            Assign(_D_AX, _D_AX + swing("x", n).at() * _UNKNOWN),
            Assign(_D_AY, _D_AY + swing("y", n).at() * _UNKNOWN),
            Assign(solved(n).at(), _UNKNOWN),
            *self._after_unknown({"x": _D_AX, "y": _D_AY}),
        )
        return Section(
            "sweep outward: the increment of each link's unknown",
            (
                Assign(_D_AX, sp.Integer(0)),
                Assign(_D_AY, sp.Integer(0)),
                Loop(Order.OUTWARD, 0, n, body),
            ),
        )

    # -- what other linearisations do otherwise ------------------------------------------------------------

    def _before_link(self, motion: AffineMotion) -> list[Assign]:
        """Return what a link's inward recursion needs besides geometry."""
        return []

    def _loads_of_slope(self) -> dict[sp.Symbol, sp.Expr]:
        """Return the loads at which the slope of "force times lever arm" is taken, where they are others."""
        return {}

    def _keep_of_link(self, column_x: Ref, column_y: Ref, inverse: Ref) -> list[Assign]:
        """Return what else to keep of a link's factors: its column of forces and its inverse pivot."""
        return []

    def _torque_gain(self, motion: AffineMotion) -> sp.Expr:
        """Return how the lever arms' angle follows the unknown."""
        return self._gain(motion, "q")

    def _after_unknown(self, changes: dict[str, Ref]) -> list[Assign]:
        """Return what else the outward sweep keeps of each node."""
        return []

    def _after_update(self, index: int, motion: AffineMotion) -> list[Statement]:
        """Return updates of other states than angles; they read the history before it ages."""
        return []

    # -- after the sweep -----------------------------------------------------------------------------------

    def _finish(
        self, title: str, index: int, motion: AffineMotion, kept: frozenset[tuple[Kind, int]], *, last: bool
    ) -> Section:
        n = self.layout.stations
        links = {k: predicted(k, n).at(1) + self._gain(motion, k) * solved(n).at() for k in KINDS}
        hub = {k: predicted(k, n).entry(BASE) + self._gain(motion, k) * _HUB_UNKNOWN for k in KINDS}
        hubbed = self.base != "clamp"
        statements: list[Statement] = []
        if not last:
            mine = sorted((k, i) for k, i in kept if i == index)
            if hubbed:
                statements += [Assign(stage_variable(k, i, "hub_", None).ref, hub[k]) for k, i in mine]
            if mine:
                body = tuple(Assign(stage_variable(k, i, "", n).at(), links[k]) for k, i in mine)
                statements.append(Loop(Order.OUTWARD, 0, n, body))
            return Section(title + "motion at this stage", tuple(statements))
        if hubbed:
            new = self._new_values(index, hub, self._values("hub_", None))
            statements += update_assignments(self.layout.hub, new, lambda v: v.ref, "")
        new = self._new_values(index, links, self._values("", n))
        body = tuple(update_assignments(self.layout.state, new, lambda v: v.at(), ""))
        places = self._after_update(index, motion)
        statements.append(Loop(Order.OUTWARD, 0, n, body))
        return Section(title + "motion at the end of the step", (*places, *statements))

    def _new_values(
        self, index: int, values: Mapping[Kind, sp.Expr], at: Mapping[sp.Symbol, sp.Expr]
    ) -> dict[Kind, sp.Expr]:
        own = {stage(k, index): values[k] for k in KINDS}
        return {k: sp.expand(sp.sympify(self.scheme.update[k]).xreplace({**own, **at})) for k in KINDS}


def predicted_motion(motion: AffineMotion, index: int) -> dict[Kind, sp.Expr]:
    """Return the motion of a stage (from 0) if its acceleration were that of the instant solved before it."""
    latest = stage("a", index) if index else past("a")
    guess = (latest - motion.offset["a"]) / motion.gain["a"]
    return {k: sp.expand(motion.offset[k] + motion.gain[k] * guess) for k in KINDS}


def planar_history(layout: PlanarLayout) -> tuple[dict[sp.Symbol, sp.Expr], dict[sp.Symbol, sp.Expr]]:
    """Return where the history of links and hub is read from during a step."""
    return (
        history_values(layout.state, lambda v: v.at()),
        history_values(layout.hub, lambda v: v.ref),
    )


def predicted(kind: Kind, n: int) -> Variable:
    """Return the scratch array of predicted angles, rates or accelerations of nodes, base first."""
    name, unit = MOTION_NAMES[kind]
    return Variable(f"predicted_{name}", Role.WORK, n + 1, f"{name} of base and links as predicted", unit)


def solved(n: int) -> Variable:
    """Return the scratch array of increments."""
    return Variable("solved", Role.WORK, n, "increment of each link's unknown")


def lever(which: str, n: int) -> Variable:
    """Return the scratch array of a link's length times the sine or cosine of its predicted angle."""
    return Variable(f"lever_{which}", Role.WORK, n, f"length times {which} of the predicted angle", "m")


def node(axis: str, n: int) -> Variable:
    """Return the scratch array of the nodes' accelerations along an axis, base first."""
    return Variable(
        f"acceleration_{axis}", Role.WORK, n + 1, f"acceleration of the nodes along {axis}", "m/s^2"
    )


def swing(axis: str, n: int) -> Variable:
    """Return the scratch array of how a link's outer end answers to its unknown."""
    return Variable(
        f"swing_{axis}", Role.WORK, n, f"change of the outer end's acceleration along {axis} per unknown", "m"
    )


def _joint_torque(n: int) -> Variable:
    return Variable(
        "joint_torque", Role.WORK, n, "torque of each joint on its outer link as predicted", "N m"
    )


def _kept(name: str, n: int) -> Variable:
    words = {
        "own": "increment of the unknown if the inner side kept its motion",
        "x": "answer to the joint's acceleration along x",
        "y": "answer to the joint's acceleration along y",
        "from_inner": "answer to the inner link's unknown",
    }
    return Variable(f"answer_{name}", Role.WORK, n, words[name])


__all__ = ["Past", "PlanarStep", "Ref", "planar_history", "predicted", "predicted_motion", "solved"]
