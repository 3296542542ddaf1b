"""Energies of a planar arm: those its state holds, and that which a step turns to heat."""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp

from tmm_gen.derive import planar_chain as chain
from tmm_gen.derive import planar_energy as energy
from tmm_gen.derive.elements import planar as element
from tmm_gen.derive.elements import torsion
from tmm_gen.derive.integrators.declaration import STEP, Kind, Past
from tmm_gen.program.planar.layout import PlanarLayout
from tmm_gen.program.statements import Assign, Loop, Order, Section, Statement
from tmm_gen.program.variables import Ref, Variable, local

_V_X, _V_Y = local("velocity_x", "velocity of a link's inner end", "m/s"), local("velocity_y", unit="m/s")
_HEIGHT = local("height", "height of a link's inner end", "m")


def energy_statements(layout: PlanarLayout, of: str, target: Ref) -> list[Statement]:
    """Return the statements that put an energy of the whole arm into an output."""
    if of == "kinetic_energy":
        return _kinetic(layout, target)
    if of == "elastic_energy":
        return _over_joints(layout, [(target, energy.joint_energy().elastic)])
    if of == "gravitational_energy":
        return _gravitational(layout, target)
    heat = layout.dissipated.ref if layout.dissipated else sp.Integer(0)
    return [Assign(target, heat)]


def heat_before(layout: PlanarLayout) -> tuple[Section, ...]:
    """Return the share of the step's heat that the motion before the step contributes."""
    return _heat(layout, energy.POWER_BEFORE, energy.SLOPE_BEFORE)


def heat_after(layout: PlanarLayout) -> tuple[Section, ...]:
    """Return the share of the step's heat that the motion after the step contributes."""
    return _heat(layout, energy.POWER_AFTER, energy.SLOPE_AFTER)


def _heat(layout: PlanarLayout, power: sp.Symbol, slope: sp.Symbol) -> tuple[Section, ...]:
    if layout.dissipated is None:
        return ()
    law, rule = energy.joint_energy(), energy.energy_of_step().subs(STEP, layout.step.ref)
    share = sp.diff(rule, power) * power + sp.diff(rule, slope) * slope
    named = {
        power: local("heating", "power turned to heat", "W"),
        slope: local("heating_slope", unit="W/s"),
    }
    sums = [(named[power], law.power), (named[slope], law.slope)] if layout.damping else []
    statements = _over_joints(layout, sums) if sums else [Assign(v, sp.Integer(0)) for v in named.values()]
    if layout.hub_damping:
        at_hub = {
            torsion.GROUND_DAMPING: layout.hub_damping.ref,
            chain.OUTER_RATE: _hub(layout, "v"),
            energy.OUTER_ACCELERATION: _hub(layout, "a"),
        }
        for symbol, value in ((power, law.hub_power), (slope, law.hub_slope)):
            statements.append(Assign(named[symbol], named[symbol] + value.subs(at_hub)))
    heat = layout.dissipated.ref
    statements.append(Assign(heat, heat + share.subs(named)))
    when = "before" if power == energy.POWER_BEFORE else "after"
    return (Section(f"energy turned to heat: share of the motion {when} the step", tuple(statements)),)


def _kinetic(layout: PlanarLayout, target: Ref) -> list[Statement]:
    law = energy.link_energy()
    symbols = {**_at_link(layout), energy.V_X: _V_X, energy.V_Y: _V_Y}
    sine, cosine = local("lever_s", unit="m"), local("lever_c", unit="m")
    named = {**symbols, chain.LEVER_SINE: sine, chain.LEVER_COSINE: cosine}
    angle = layout.state[Past("q", 0)].at()
    hub: sp.Expr = sp.Integer(0)
    if layout.hub_inertia:
        hub = layout.hub_inertia.ref * _hub(layout, "v") ** 2 / 2
    body = (
        Assign(sine, layout.length.at() * sp.sin(angle)),
        Assign(cosine, layout.length.at() * sp.cos(angle)),
        Assign(target, target + law.kinetic.subs(named)),
        Assign(_V_X, law.outer_x.subs(named)),
        Assign(_V_Y, law.outer_y.subs(named)),
    )
    last = {
        **_tip(layout),
        energy.V_X: _V_X,
        energy.V_Y: _V_Y,
        chain.RATE: layout.state[Past("v", 0)].entry(layout.stations - 1),
    }
    tip = law.tip_kinetic.subs(last)
    return [
        Assign(target, hub),
        Assign(_V_X, sp.Integer(0)),
        Assign(_V_Y, sp.Integer(0)),
        Loop(Order.OUTWARD, 0, layout.stations, body),
        *([Assign(target, target + tip)] if tip != 0 else []),
    ]


def _gravitational(layout: PlanarLayout, target: Ref) -> list[Statement]:
    if layout.gravity is None:
        return [Assign(target, sp.Integer(0))]
    law = energy.link_energy()
    sine = local("lever_s", unit="m")
    named = {
        **_at_link(layout),
        chain.LEVER_SINE: sine,
        energy.HEIGHT: _HEIGHT,
        energy.GRAVITY: layout.gravity.ref,
    }
    body = (
        Assign(sine, layout.length.at() * sp.sin(layout.state[Past("q", 0)].at())),
        Assign(target, target + law.gravitational.subs(named)),
        Assign(_HEIGHT, law.outer_height.subs(named)),
    )
    tip = law.tip_gravitational.subs({**named, **_tip(layout)})
    return [
        Assign(target, sp.Integer(0)),
        Assign(_HEIGHT, sp.Integer(0)),
        Loop(Order.OUTWARD, 0, layout.stations, body),
        *([Assign(target, target + tip)] if tip != 0 else []),
    ]


def _over_joints(layout: PlanarLayout, sums: list[tuple[Ref, sp.Expr]]) -> list[Statement]:
    """Sum expressions over all joints; joint 1 stands between the base and link 1."""

    def at(inner: Mapping[Kind, sp.Expr], joint: int | None) -> dict[sp.Symbol, sp.Expr]:
        def pick(variable: Variable) -> Ref:
            return variable.at() if joint is None else variable.entry(joint)

        outer: dict[Kind, sp.Expr] = {k: pick(layout.state[Past(k, 0)]) for k in inner}
        return {
            chain.INNER_ANGLE: inner["q"],
            chain.OUTER_ANGLE: outer["q"],
            chain.INNER_RATE: inner["v"],
            chain.OUTER_RATE: outer["v"],
            energy.INNER_ACCELERATION: inner["a"],
            energy.OUTER_ACCELERATION: outer["a"],
            element.STIFFNESS: pick(layout.stiffness),
            element.DAMPING: pick(layout.damping) if layout.damping else sp.Integer(0),
        }

    kinds: tuple[Kind, ...] = ("q", "v", "a")
    first = at({k: _hub(layout, k) for k in kinds}, 0)
    others = at({k: layout.state[Past(k, 0)].at(-1) for k in kinds}, None)
    statements: list[Statement] = [Assign(target, value.subs(first)) for target, value in sums]
    if layout.stations > 1:
        body = tuple(Assign(target, target + value.subs(others)) for target, value in sums)
        statements.append(Loop(Order.OUTWARD, 1, layout.stations, body))
    return statements


def _at_link(layout: PlanarLayout) -> dict[sp.Symbol, sp.Expr]:
    return {
        element.MASS: layout.mass.at(),
        element.INERTIA: layout.inertia.at(),
        element.CENTER: layout.center.at(),
        chain.RATE: layout.state[Past("v", 0)].at(),
    }


def _tip(layout: PlanarLayout) -> dict[sp.Symbol, sp.Expr]:
    return {
        element.TIP_MASS: layout.tip_mass.ref if layout.tip_mass else sp.Integer(0),
        element.TIP_INERTIA: layout.tip_inertia.ref if layout.tip_inertia else sp.Integer(0),
    }


def _hub(layout: PlanarLayout, kind: Kind) -> sp.Expr:
    return layout.hub[Past(kind, 0)].ref if layout.hub else sp.Integer(0)
