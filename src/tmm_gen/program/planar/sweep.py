"""One Riccati sweep of a planar arm: walk outward, sweep inward, solve the base, sweep outward.

The exact equations are linearised about the predicted angle, rate and acceleration of each link; what it takes at each
link is derived in :mod:`tmm_gen.derive.planar_chain`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive import planar_chain as chain
from tmm_gen.derive import torsion_chain
from tmm_gen.derive.elements import planar as element
from tmm_gen.derive.elements import torsion
from tmm_gen.derive.integrators.declaration import KINDS, STEP, Kind, Scheme
from tmm_gen.derive.integrators.relations import AffineMotion, Unknown
from tmm_gen.program.planar.layout import PlanarLayout
from tmm_gen.program.planar.loads import PlanarLoads
from tmm_gen.program.planar.scratch import (
    BASE,
    CHANGE_X,
    CHANGE_Y,
    FORCE,
    HUB_UNKNOWN,
    IMPEDANCE,
    INNER_IMPEDANCE,
    UNKNOWN,
    answer,
    joint_torque,
    lever,
    node,
    predicted,
    solved,
    swing,
)
from tmm_gen.program.statements import Assign, Loop, Order, Require, Section
from tmm_gen.program.variables import Ref, local


@dataclass(frozen=True)
class PlanarSweep:
    """Builds the sections of one sweep of one scheme's step.

    Parameters
    ----------
    layout : PlanarLayout
        The arm's variables.
    shared : mapping from sympy.Symbol to sympy.Expr
        Combinations of parameters prepared once: carried mass, inner mass, inertia about the pin.
    impedances : sequence of sympy.Expr
        Joint impedance ``K`` of each stage.
    loads : sequence of PlanarLoads
        Inputs, one for each instant at which they are read: each stage, and the end of the step where a prescribed
        base needs it.
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

    def _gain(self, motion: AffineMotion, kind: Kind) -> sp.Expr:
        return motion.gain[kind].xreplace({STEP: self.layout.step.ref})

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
            **{chain.S[i, k]: IMPEDANCE[i][k] for i in range(3) for k in range(3)},
            **{chain.E[i]: FORCE[i] for i in range(3)},
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
            Assign(joint_torque(n).at(), joint.known_torque.xreplace({**symbols, **ends})),
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
                body.append(Assign(FORCE[i], FORCE[i] - loads.array(component).at()))
        at_bias = {chain.F_X: FORCE[0], chain.F_Y: FORCE[1], chain.TORQUE: FORCE[2]}
        laws = chain.link_law()
        body += self._before_link(motion)
        body += [Assign(column[i], law.outer[i].xreplace(named)) for i in range(3)]
        body += [
            Assign(load_x, laws.load_x.xreplace({**symbols, **at_bias})),
            Assign(load_y, laws.load_y.xreplace({**symbols, **at_bias})),
        ]
        slopes = {**named, **self._loads_of_slope()}
        body += [
            Assign(INNER_IMPEDANCE[i][k], law.impedance[i, k].xreplace(slopes))
            for i in (2, 0, 1)
            for k in range(3)
        ]
        body += [Assign(FORCE[i], law.bias[i].xreplace(named)) for i in (2, 0, 1)]
        # the joint: one scalar pivot
        pivot, inverse = local("pivot"), local("inverse_pivot")
        turned = {
            chain.JOINT_IMPEDANCE: impedance,
            chain.JOINT_TORQUE: joint_torque(n).at(),
            **{chain.S[i, k]: INNER_IMPEDANCE[i][k] for i in range(3) for k in range(3)},
            **{chain.E[i]: FORCE[i] for i in range(3)},
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
            *self._keep_of_link(INNER_IMPEDANCE[0][2], INNER_IMPEDANCE[1][2], inverse),
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
                Assign(IMPEDANCE[i][0], INNER_IMPEDANCE[i][0] - INNER_IMPEDANCE[i][2] * kept["x"]),
                Assign(IMPEDANCE[i][1], INNER_IMPEDANCE[i][1] - INNER_IMPEDANCE[i][2] * kept["y"]),
                Assign(IMPEDANCE[i][2], INNER_IMPEDANCE[i][2] * kept["from_inner"]),
                Assign(FORCE[i], FORCE[i] + INNER_IMPEDANCE[i][2] * kept["own"]),
            ]
        body += [
            Assign(IMPEDANCE[2][0], impedance * kept["x"]),
            Assign(IMPEDANCE[2][1], impedance * kept["y"]),
            Assign(IMPEDANCE[2][2], INNER_IMPEDANCE[2][2] * kept["from_inner"]),
            Assign(FORCE[2], joint_torque(n).at() - impedance * kept["own"]),
        ]
        return Section(
            "sweep inward: force beyond each joint as an affine function of the motion at it",
            (*loads.statements(), *self._tip(motion, loads), Loop(Order.INWARD, 0, n, tuple(body))),
        )

    def _kept_answers(self, impedance: sp.Expr) -> dict[str, sp.Expr]:
        """Return what the inward sweep keeps for the outward one; a joint without impedance hands on nothing."""
        n = self.layout.stations
        kept: dict[str, sp.Expr] = {name: answer(name, n).at() for name in ("own", "x", "y", "from_inner")}
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
                assigns.append(Assign(IMPEDANCE[i][k], slope))
        for i, (force, component) in enumerate(zip(forces, ("force_x", "force_y", "torque"), strict=True)):
            assigns.append(Assign(FORCE[i], force.xreplace(at_tip) - loads.tip[component]))
        return assigns

    def _at_base(self, motion: AffineMotion, loads: PlanarLoads) -> Section:
        n = self.layout.stations
        if self.base != "motor":
            does = "does not move" if self.base == "clamp" else "moves as prescribed"
            return Section(f"the base {does}", (Assign(UNKNOWN, sp.Integer(0)),))
        law = torsion_chain.hub_law()
        assert self.layout.hub_inertia is not None
        hub = {
            torsion.INERTIA: self.layout.hub_inertia.ref,
            torsion.GROUND_DAMPING: self.layout.hub_damping.ref if self.layout.hub_damping else sp.Integer(0),
            # the chain counts the torque on the inner side, the arm that on the outer one
            torsion_chain.IMPEDANCE: -IMPEDANCE[2][2],
            **{torsion_chain.GAINS[k]: self._gain(motion, k) for k in KINDS},
            **{torsion_chain.INNER[k]: predicted(k, n).entry(BASE) for k in KINDS},
        }
        pivot = local("hub_pivot")
        known = law.known.xreplace(hub)
        statements = (
            Assign(pivot, law.pivot.xreplace(hub)),
            Require(pivot),
            Assign(UNKNOWN, (loads.base - FORCE[2] - known) / pivot),
        )
        return Section("the hub", (*statements, Assign(HUB_UNKNOWN, UNKNOWN)))

    def _outward(self, impedance: sp.Expr) -> Section:
        n = self.layout.stations
        kept = self._kept_answers(impedance)
        unknown = kept["from_inner"] * UNKNOWN + kept["own"] - kept["x"] * CHANGE_X - kept["y"] * CHANGE_Y
        body = (
            Assign(UNKNOWN, unknown),
            Assign(CHANGE_X, CHANGE_X + swing("x", n).at() * UNKNOWN),
            Assign(CHANGE_Y, CHANGE_Y + swing("y", n).at() * UNKNOWN),
            Assign(solved(n).at(), UNKNOWN),
            *self._after_unknown({"x": CHANGE_X, "y": CHANGE_Y}),
        )
        return Section(
            "sweep outward: the increment of each link's unknown",
            (
                Assign(CHANGE_X, sp.Integer(0)),
                Assign(CHANGE_Y, sp.Integer(0)),
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
