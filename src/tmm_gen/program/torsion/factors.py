"""The part of the sweep that depends on the step and the parameters alone: pivots and transmissions."""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive import torsion_chain as chain
from tmm_gen.derive.elements.torsion import DAMPING, GROUND_DAMPING, INERTIA, STIFFNESS
from tmm_gen.derive.integrators.declaration import STEP
from tmm_gen.derive.integrators.relations import AffineMotion, UnsuitableUnknownError
from tmm_gen.program.statements import Assign, Loop, Order, Require, Section
from tmm_gen.program.torsion.layout import ChainLayout
from tmm_gen.program.variables import Ref, Role, Variable, local

ZERO, ONE = sp.Integer(0), sp.Integer(1)

Gains = tuple[sp.Expr, sp.Expr, sp.Expr]


@dataclass(frozen=True)
class Factors:
    """Factors of one sweep, at the station ``j`` of the enclosing loop.

    Parameters
    ----------
    section : Section
        Statements of prepare that compute them.
    coefficients : tuple of Variable
        The model's variables they are kept in.
    transmission, reflection, admittance : sympy.Expr
        See :class:`tmm_gen.derive.torsion_chain.RiccatiStation` (Riccati sweep).
    unknown_gain, force_gain, tip_compliance : sympy.Expr or None
        Gains of the product, and minus the inverse of its last force gain (product sweep).
    hub_admittance : sympy.Expr or None
        Inverse pivot of a free hub.
    """

    section: Section
    coefficients: tuple[Variable, ...]
    transmission: sp.Expr = ZERO
    reflection: sp.Expr = ONE
    admittance: sp.Expr = ZERO
    joint_compliance: sp.Expr = ZERO
    unknown_gain: Variable | None = None
    hub_admittance: sp.Expr | None = None
    tip_compliance: sp.Expr | None = None


def parameter_values(layout: ChainLayout) -> dict[sp.Symbol, sp.Expr]:
    """Map the elements' parameters to this chain's variables at station ``j``."""
    return {
        STEP: layout.step.ref,
        STIFFNESS: layout.stiffness.at(),
        DAMPING: layout.damping.at() if layout.damping else sp.Integer(0),
        INERTIA: layout.inertia.at(),
    }


def hub_values(layout: ChainLayout) -> dict[sp.Symbol, sp.Expr]:
    """Map the parameters of the hub's elements to this chain's variables."""
    assert layout.hub_inertia is not None
    return {
        STEP: layout.step.ref,
        INERTIA: layout.hub_inertia.ref,
        GROUND_DAMPING: layout.hub_damping.ref if layout.hub_damping else sp.Integer(0),
    }


def gains_of(motion: AffineMotion) -> Gains:
    """Return ``P_q, P_v, P_a``: two stages with equal gains share their factors."""
    return motion.gain["q"], motion.gain["v"], motion.gain["a"]


def riccati_factors(layout: ChainLayout, gains: Gains, suffix: str) -> Factors:
    """Build the factors of a Riccati sweep.

    Parameters
    ----------
    gains : tuple of sympy.Expr
        Of the stage's motion.
    suffix : str
        Distinguishes variables where an integrator needs several sets.
    """
    n = layout.stations
    law = chain.riccati_station()
    values = {**parameter_values(layout), **dict(zip(chain.GAINS.values(), gains, strict=True))}
    joint = bind(chain.joint_law().impedance, values, layout)
    impedance, pivot = local("impedance"), local("pivot")
    before: list[Assign] = [Assign(impedance, sp.Integer(0))]
    body: list[Assign | Require] = []
    named: sp.Expr = joint
    if not joint.is_number and not isinstance(joint, Ref):
        named = local("joint_impedance")
        (body if _per_station(joint) else before).append(Assign(named, joint))
    admittance = Variable(f"admittance{suffix}", Role.COEFFICIENT, n, "inverse pivot of each joint")
    transmission = Variable(
        f"transmission{suffix}", Role.COEFFICIENT, n, "share of torque and motion each joint passes on"
    )
    reflection = Variable(
        f"reflection{suffix}", Role.COEFFICIENT, n, "share of its own known torque each joint passes on"
    )
    symbols = {chain.IMPEDANCE: impedance, chain.JOINT_IMPEDANCE: named, chain.PIVOT_INVERSE: admittance.at()}
    body += [
        Assign(impedance, bind(law.link_impedance, values, layout).subs(chain.IMPEDANCE, impedance)),
        Assign(pivot, law.pivot.subs(symbols)),
        Require(pivot),
        Assign(admittance.at(), 1 / pivot),
    ]
    kept = [admittance]
    passes: dict[Variable, sp.Expr] = {}
    for variable, expression in ((transmission, law.transmission), (reflection, law.reflection)):
        value = _without_joint_impedance(expression, law.pivot) if joint == 0 else None
        if value is not None and value.is_number:
            passes[variable] = value  # an explicit stage without dampers: joints do not answer to the unknown
            continue
        body.append(Assign(variable.at(), expression.subs(symbols)))
        passes[variable] = variable.at()
        kept.append(variable)
    body.append(Assign(impedance, impedance * passes[transmission]))
    after: list[Assign | Require] = []
    hub_admittance = None
    if layout.hub_inertia is not None:
        statements, variable = _hub(layout, gains, impedance, suffix)
        after, hub_admittance = statements, variable.ref
        kept.append(variable)
    return Factors(
        section=Section(
            "Riccati factors, swept from tip to base",
            (*before, Loop(Order.INWARD, 0, n, tuple(body)), *after),
        ),
        coefficients=tuple(kept),
        transmission=passes[transmission],
        reflection=passes[reflection],
        admittance=admittance.at(),
        hub_admittance=hub_admittance,
    )


def product_factors(layout: ChainLayout, gains: Gains, suffix: str) -> Factors:
    """Build the factors of the plain product: how each station answers to the base unknown."""
    n = layout.stations
    law = chain.product_station()
    values = {**parameter_values(layout), **dict(zip(chain.GAINS.values(), gains, strict=True))}
    joint = bind(chain.joint_law().impedance, values, layout)
    if joint == 0:
        raise UnsuitableUnknownError(
            "an explicit integrator has no joint impedance to multiply by; use sweep = 'riccati'"
        )
    length = n if _per_station(joint) else None
    compliance = Variable(f"compliance{suffix}", Role.COEFFICIENT, length, "inverse joint impedance")
    unknown_gain = Variable(
        f"unknown_gain{suffix}", Role.COEFFICIENT, n, "unknown of each station per base unknown"
    )
    tip = Variable(
        f"tip_compliance{suffix}", Role.COEFFICIENT, doc="base unknown per torque left over at the tip"
    )
    force, motion = local("force_gain"), local("motion_gain")
    named = {chain.UNKNOWN_GAIN: motion, chain.TORQUE_GAIN: force, chain.COMPLIANCE: compliance.at()}
    first: tuple[sp.Expr, sp.Expr] = (sp.Integer(0), sp.Integer(1))
    if layout.hub_inertia is not None:
        hub = chain.hub_law().pivot.subs(chain.IMPEDANCE, 0)
        first = (sp.Integer(1), bind(hub, hub_values(layout), layout, gains))
    inverse = Assign(compliance.at(), 1 / joint)
    body = (
        *((inverse,) if length else ()),
        Assign(motion, law.unknown.subs(named)),
        Assign(force, bind(law.torque, values, layout).subs(named)),
        Assign(unknown_gain.at(), motion),
    )
    return Factors(
        section=Section(
            "Plain product of transfer matrices, base to tip",
            (
                *(() if length else (inverse,)),
                Assign(motion, first[0]),
                Assign(force, first[1]),
                Loop(Order.OUTWARD, 0, n, body),
                Assign(tip.ref, 1 / force),
            ),
        ),
        coefficients=(compliance, unknown_gain, tip),
        unknown_gain=unknown_gain,
        joint_compliance=compliance.at(),
        tip_compliance=tip.ref,
    )


def bind(
    expression: sp.Expr, values: dict[sp.Symbol, sp.Expr], layout: ChainLayout, gains: Gains | None = None
) -> sp.Expr:
    """Put this chain's variables for the symbols of a derivation."""
    if gains is not None:
        expression = expression.subs(dict(zip(chain.GAINS.values(), gains, strict=True)))
    return expression.subs(values).subs(STEP, layout.step.ref)


def _hub(
    layout: ChainLayout, gains: Gains, impedance: Ref, suffix: str
) -> tuple[list[Assign | Require], Variable]:
    """Return statements for the pivot of a free hub."""
    variable = Variable(f"hub_admittance{suffix}", Role.COEFFICIENT, doc="inverse pivot of the hub")
    pivot = local("hub_pivot")
    value = bind(chain.hub_law().pivot.subs(chain.IMPEDANCE, impedance), hub_values(layout), layout, gains)
    return [Assign(pivot, value), Require(pivot), Assign(variable.ref, 1 / pivot)], variable


def _per_station(expression: sp.Expr) -> bool:
    return any(isinstance(s, Ref) and s.offset is not None for s in expression.free_symbols)


def _without_joint_impedance(expression: sp.Expr, pivot: sp.Expr) -> sp.Expr:
    """Return a factor of the sweep where the joint's impedance vanishes."""
    return sp.cancel(expression.subs(chain.PIVOT_INVERSE, 1 / pivot).subs(chain.JOINT_IMPEDANCE, 0))
