"""One step of a chain: for each stage predict, sweep inward, solve the base, sweep outward; then update."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive import torsion_chain as chain
from tmm_gen.derive.integrators.declaration import KINDS, STEP, Kind, Past, Scheme, stage
from tmm_gen.derive.integrators.relations import UNKNOWN, AffineMotion, Unknown, affine_motion
from tmm_gen.program.fields import MOTION_NAMES
from tmm_gen.program.inputs import prescribed_end
from tmm_gen.program.motion import (
    history_values,
    kept_stage_values,
    stage_variable,
    update_assignments,
)
from tmm_gen.program.statements import Assign, Loop, Order, Section, Statement
from tmm_gen.program.torsion.factors import Factors, bind, hub_values, parameter_values
from tmm_gen.program.torsion.layout import ChainLayout
from tmm_gen.program.torsion.loads import Loads
from tmm_gen.program.variables import Ref, Role, Variable, local

_BASE = 0
"""Index of the base among nodes; link j's outboard node is j + 1."""


@dataclass(frozen=True)
class StepBuilder:
    """Builds the sections of one scheme's step.

    Parameters
    ----------
    layout : ChainLayout
        The chain's variables.
    loads : sequence of Loads
        Where inputs act, one for each instant at which they are read: each stage, and the end of the step where a
        prescribed base needs it.
    base : str
        "clamp", "motor" or "prescribed".
    scheme : Scheme
        What to step with.
    unknown : str
        What the sweep solves for.
    factors : sequence of Factors
        One for each stage.
    links, hub : mapping from Past to Variable
        Where history is read from and new values go to.
    """

    layout: ChainLayout
    loads: tuple[Loads, ...]
    base: str
    scheme: Scheme
    unknown: Unknown
    factors: tuple[Factors, ...]
    sources: Mapping[Past, Variable]
    hub_sources: Mapping[sp.Symbol, sp.Expr]

    def sections(self) -> tuple[Section, ...]:
        """Return the whole step."""
        stages = len(self.scheme.stages)
        motions = [_short_offsets(affine_motion(self.scheme, i + 1, self.unknown)) for i in range(stages)]
        kept = kept_stage_values(
            self.scheme, {(i, k): m.offset[k] for i, m in enumerate(motions) for k in KINDS}
        )
        sections: list[Section] = []
        each = zip(motions, self.factors, self.loads[:stages], strict=True)
        for index, (motion, factors, loads) in enumerate(each, start=1):
            title = f"Stage {index} of {stages}: " if stages > 1 else ""
            last = index == stages
            sections += [
                Section(title + "motion known before the sweep", tuple(self._predict(motion, loads))),
                *self._sweep(title, motion, factors, loads),
                self._outward_end(title, index, motion, kept, last),
            ]
        return tuple(s for s in sections if s.statements)

    # -- prediction ---------------------------------------------------------------------------------------------

    def _predict(self, motion: AffineMotion, loads: Loads) -> list[Statement]:
        at_links = self._link_values()
        at_hub = self._hub_values()
        body = []
        base: list[Assign] = []
        for kind in ("v", "q", "a"):  # rates first: displacements may be written by them
            offset = motion.offset[kind]
            if offset == 0:
                continue
            known = _known(kind, self.layout.stations)
            body.append(
                Assign(
                    known.at(1),
                    offset.subs({**at_links, _KNOWN_RATE: _known("v", self.layout.stations).at(1)}),
                )
            )
            at_base = sp.Integer(0)
            if self.base == "prescribed" and kind != "a":
                at_base = self._prescribed_known(motion, loads, kind)
            elif self.base == "motor":
                at_base = offset.subs({**at_hub, _KNOWN_RATE: _known("v", self.layout.stations).entry(_BASE)})
            base.append(Assign(known.entry(_BASE), at_base))
        if not body:
            return []
        return [*base, Loop(Order.OUTWARD, 0, self.layout.stations, tuple(body))]

    def _link_values(self) -> dict[sp.Symbol, sp.Expr]:
        n = self.layout.stations
        stages = {
            stage(kind, i): stage_variable(kind, i, "", n).at()
            for kind in KINDS
            for i in range(1, len(self.scheme.stages))
        }
        return {STEP: self.layout.step.ref, **history_values(self.sources, lambda v: v.at()), **stages}

    def _hub_values(self) -> dict[sp.Symbol, sp.Expr]:
        stages = {
            stage(kind, i): stage_variable(kind, i, "hub_", None).ref
            for kind in KINDS
            for i in range(1, len(self.scheme.stages))
        }
        return {STEP: self.layout.step.ref, **self.hub_sources, **stages}

    # -- sweeps -------------------------------------------------------------------------------------------------

    def _known_at(self, motion: AffineMotion, node: int | None, offset: int = 0) -> dict[str, sp.Expr]:
        """Return the known parts of ``q, v, a`` at a node of the loop (``node`` None) or a fixed one."""
        n = self.layout.stations
        found: dict[str, sp.Expr] = {}
        for kind in KINDS:
            variable = _known(kind, n)
            ref = variable.at(offset) if node is None else variable.entry(node)
            found[kind] = ref if motion.offset[kind] != 0 else sp.Integer(0)
        return found

    def _joint_torque(self, motion: AffineMotion) -> Section:
        inner, outer = self._known_at(motion, None, 0), self._known_at(motion, None, 1)
        symbols = {chain.INNER[k]: inner[k] for k in KINDS} | {chain.OUTER[k]: outer[k] for k in KINDS}
        value = bind(chain.joint_law().known_torque.subs(symbols), parameter_values(self.layout), self.layout)
        n = self.layout.stations
        return Section(
            "torque of each joint at the known motion",
            (Loop(Order.OUTWARD, 0, n, (Assign(_torque(n).at(), value),)),),
        )

    def _sweep(self, title: str, motion: AffineMotion, factors: Factors, loads: Loads) -> list[Section]:
        torque = self._joint_torque(motion)
        build = self._riccati if factors.unknown_gain is None else self._product
        return [
            Section(title + torque.title, torque.statements),
            *(Section(title + s.title, s.statements) for s in build(motion, factors, loads)),
        ]

    def _riccati(self, motion: AffineMotion, factors: Factors, loads: Loads) -> list[Section]:
        n = self.layout.stations
        law = chain.riccati_station()
        bias, correction, torque = local("bias", "torque beyond this station"), _correction(n), _torque(n)
        unknown, solved = local("unknown"), _unknown(n)
        outer = self._known_at(motion, None, 1)
        link_bias = bind(
            law.link_bias.subs({chain.BIAS: bias, **{chain.OUTER[k]: outer[k] for k in KINDS}}),
            parameter_values(self.layout),
            self.layout,
        )
        body: list[Assign] = []
        if loads.inner:
            body.append(Assign(bias, bias + loads.array.at()))
        if link_bias != bias:
            body.append(Assign(bias, link_bias))
        body += [
            Assign(correction.at(), factors.admittance * (bias - torque.at())),
            Assign(bias, factors.transmission * bias + factors.reflection * torque.at()),
        ]
        inward = Section(
            "sweep inward: torque beyond each joint as if its inner side did not move",
            (*loads.statements(), Assign(bias, loads.tip), Loop(Order.INWARD, 0, n, tuple(body))),
        )
        base = Section("the base", (Assign(unknown, self._base_unknown(motion, factors, loads, bias)),))
        outward = Section(
            "sweep outward: the unknown of each station",
            (
                Loop(
                    Order.OUTWARD,
                    0,
                    n,
                    (
                        Assign(unknown, factors.transmission * unknown + correction.at()),
                        Assign(solved.at(), unknown),
                    ),
                ),
            ),
        )
        base = Section(base.title, (*base.statements, *self._keep_hub_unknown(unknown)))
        return [inward, base, outward]

    def _product(self, motion: AffineMotion, factors: Factors, loads: Loads) -> list[Section]:
        n = self.layout.stations
        law = chain.product_station()
        assert factors.unknown_gain is not None
        assert factors.tip_compliance is not None
        known, torque, base = local("known_unknown"), local("known_torque"), local("unknown")
        partial, solved = _correction(n), _unknown(n)
        outer = self._known_at(motion, None, 1)
        symbols = {
            chain.UNKNOWN_KNOWN: known,
            chain.TORQUE_KNOWN: torque,
            chain.KNOWN_TORQUE: _torque(n).at(),
            chain.COMPLIANCE: factors.joint_compliance,
            **{chain.OUTER[k]: outer[k] for k in KINDS},
        }
        gains = dict(zip(chain.GAINS.values(), (motion.gain[k] for k in ("q", "v", "a")), strict=True))
        force = bind(law.known_torque.subs(gains).subs(symbols), parameter_values(self.layout), self.layout)
        if loads.inner:
            force -= loads.array.at()
        first_unknown: sp.Expr = sp.Integer(0)
        first_torque: sp.Expr = sp.Integer(0)
        if self.base == "motor":
            first_torque = self._hub_known(motion) - loads.base
        elif self.base == "prescribed":
            first_unknown = self._prescribed_unknown(motion, loads)
        outward = Section(
            "product outward: state of each station if the base unknown were zero",
            (
                *loads.statements(),
                Assign(known, first_unknown),
                Assign(torque, first_torque),
                Loop(
                    Order.OUTWARD,
                    0,
                    n,
                    (
                        Assign(known, law.known.subs(symbols)),
                        Assign(partial.at(), known),
                        Assign(torque, force),
                    ),
                ),
                Assign(base, factors.tip_compliance * (loads.tip - torque)),
                *(self._keep_hub_unknown(base) if self.base == "motor" else ()),
                Loop(
                    Order.OUTWARD,
                    0,
                    n,
                    (Assign(solved.at(), factors.unknown_gain.at() * base + partial.at()),),
                ),
            ),
        )
        return [outward]

    # -- base ---------------------------------------------------------------------------------------------------

    def _hub_known(self, motion: AffineMotion) -> sp.Expr:
        known = self._known_at(motion, _BASE)
        law = chain.hub_law().known.subs({chain.INNER[k]: known[k] for k in KINDS})
        return bind(law, hub_values(self.layout), self.layout)

    def _base_unknown(self, motion: AffineMotion, factors: Factors, loads: Loads, bias: sp.Expr) -> sp.Expr:
        if self.base == "clamp":
            return sp.Integer(0)
        if self.base == "prescribed":
            return self._prescribed_unknown(motion, loads)
        assert factors.hub_admittance is not None
        return factors.hub_admittance * (bias + loads.base - self._hub_known(motion))

    def _prescribed_unknown(self, motion: AffineMotion, loads: Loads) -> sp.Expr:
        """Return a prescribed base's unknown: its motion is known, unless the angle itself is the unknown."""
        return loads.motion["q"] if motion.offset["q"] == 0 else sp.Integer(0)

    def _prescribed_known(self, motion: AffineMotion, loads: Loads, kind: Kind) -> sp.Expr:
        """Return what a prescribed base's unknown leaves of its motion."""
        gain = motion.gain[kind].subs(STEP, self.layout.step.ref)
        return loads.motion[kind] - gain * self._prescribed_unknown(motion, loads)

    def _keep_hub_unknown(self, unknown: Ref) -> list[Assign]:
        return [Assign(_HUB_UNKNOWN, unknown)] if self.base == "motor" else []

    # -- after the sweep ----------------------------------------------------------------------------------------

    def _outward_end(
        self, title: str, index: int, motion: AffineMotion, kept: frozenset[tuple[Kind, int]], last: bool
    ) -> Section:
        n = self.layout.stations
        links = self._stage_values(motion, _unknown(n).at(), self._known_at(motion, None, 1))
        hub = self._stage_values(motion, _HUB_UNKNOWN, self._known_at(motion, _BASE))
        hubbed = self.base == "motor"
        if not last:
            body = [Assign(stage_variable(k, i, "", n).at(), links[k]) for k, i in sorted(kept) if i == index]
            own = [
                Assign(stage_variable(k, i, "hub_", None).ref, hub[k]) for k, i in sorted(kept) if i == index
            ]
            loop = (Loop(Order.OUTWARD, 0, n, tuple(body)),) if body else ()
            return Section(title + "motion at this stage", (*(own if hubbed else ()), *loop))
        new_links = self._new_values(index, links, self._link_values())
        statements: list[Statement] = []
        if hubbed:
            new_hub = self._new_values(index, hub, self._hub_values())
            statements += update_assignments(self.layout.hub, new_hub, lambda v: v.ref, "")
        statements += prescribed_end(self.layout.hub, self.loads[-1].motion)
        body = update_assignments(self.layout.state, new_links, lambda v: v.at(), "")
        statements.append(Loop(Order.OUTWARD, 0, n, tuple(body)))
        return Section(title + "motion at the end of the step", tuple(statements))

    def _stage_values(
        self, motion: AffineMotion, unknown: Ref, known: Mapping[str, sp.Expr]
    ) -> dict[Kind, sp.Expr]:
        return {k: motion.gain[k].subs(STEP, self.layout.step.ref) * unknown + known[k] for k in KINDS}

    def _new_values(
        self, index: int, values: Mapping[Kind, sp.Expr], at: Mapping[sp.Symbol, sp.Expr]
    ) -> dict[Kind, sp.Expr]:
        own = {stage(k, index): values[k] for k in KINDS}
        return {k: sp.sympify(self.scheme.update[k]).subs({**own, **at}) for k in KINDS}


_KNOWN_RATE = sp.Symbol("known_rate", real=True)
_HUB_UNKNOWN = local("hub_unknown", "unknown of the hub")


def _short_offsets(motion: AffineMotion) -> AffineMotion:
    """Write the known displacement by the known rate where that takes fewer terms (Runge-Kutta stages)."""
    rate = motion.offset["v"]
    if motion.gain["v"] == 0 or rate == 0:
        return motion
    ratio = sp.cancel(motion.gain["q"] / motion.gain["v"])
    rest = sp.expand(motion.offset["q"] - ratio * rate)
    if len(sp.Add.make_args(rest)) + 1 >= len(sp.Add.make_args(motion.offset["q"])):
        return motion
    return AffineMotion(motion.gain, {**motion.offset, "q": rest + ratio * _KNOWN_RATE})


def _known(kind: Kind | str, n: int) -> Variable:
    name, unit = MOTION_NAMES[kind]  # type: ignore[index]
    return Variable(
        f"known_{name}",
        Role.WORK,
        n + 1,
        f"{name} of each node without the unknown's share, base first",
        unit,
    )


def _torque(n: int) -> Variable:
    return Variable("joint_torque", Role.WORK, n, "torque of each joint at the known motion", "N m")


def _correction(n: int) -> Variable:
    return Variable("correction", Role.WORK, n, "unknown of each station if its inner neighbour's were zero")


def _unknown(n: int) -> Variable:
    return Variable("solved", Role.WORK, n, "unknown of each station")


__all__ = ["UNKNOWN", "StepBuilder"]
