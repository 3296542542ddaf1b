"""What a sweep does at one station (joint, then link), derived from the elements' equations.

The joint's blocks are read off its transfer matrix and named: its impedance ``K = k P_q + c P_v`` and the torque
``w`` its already known motion causes. With these names the derived recursions are the ones a person would write.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import sympy as sp

from tmm_gen.derive.elements.torsion import (
    DAMPING,
    GROUND_DAMPER,
    JOINT,
    LINK,
    LOAD,
    STIFFNESS,
    TORQUE,
)
from tmm_gen.derive.sweep.product import product_step
from tmm_gen.derive.sweep.riccati import riccati_step
from tmm_gen.derive.transfer import DiscreteMotion, TransferMatrix, transfer_matrix

GAINS = {kind: sp.Symbol(f"P_{kind}", real=True) for kind in ("q", "v", "a")}
INNER = {kind: sp.Symbol(f"known_{kind}_inner", real=True) for kind in ("q", "v", "a")}
OUTER = {kind: sp.Symbol(f"known_{kind}_outer", real=True) for kind in ("q", "v", "a")}
IMPEDANCE, BIAS = sp.symbols("S e", real=True)
JOINT_IMPEDANCE, KNOWN_TORQUE = sp.symbols("K w", real=True)
PIVOT_INVERSE = sp.Symbol("Y", real=True)
INNER_UNKNOWN = sp.Symbol("u_inner", real=True)


@dataclass(frozen=True)
class JointLaw:
    """The joint's two quantities in every sweep.

    Parameters
    ----------
    impedance : sympy.Expr
        Torque per unit of unknown twist, ``K``.
    known_torque : sympy.Expr
        Torque of the known part of the motion, ``w``.
    """

    impedance: sp.Expr
    known_torque: sp.Expr


@dataclass(frozen=True)
class RiccatiStation:
    """The Riccati recursion over link and joint, all in the named symbols of this module.

    Parameters
    ----------
    link_impedance, link_bias : sympy.Expr
        ``S, e`` inboard of the link.
    pivot : sympy.Expr
        The scalar pivot of the joint, ``K - S``.
    transmission : sympy.Expr
        Factor of ``S`` in the inboard ``S``, of ``e`` in the inboard ``e`` and of the inboard in the outboard unknown.
    reflection : sympy.Expr
        Factor of ``w`` in the inboard ``e``.
    admittance : sympy.Expr
        Factor of ``e - w`` in the outboard unknown.
    """

    link_impedance: sp.Expr
    link_bias: sp.Expr
    pivot: sp.Expr
    transmission: sp.Expr
    reflection: sp.Expr
    admittance: sp.Expr


@cache
def joint_law() -> JointLaw:
    """Read ``K`` and ``w`` off the joint's transfer matrix."""
    matrix = transfer_matrix(JOINT, [DiscreteMotion(GAINS, INNER)], [DiscreteMotion(GAINS, OUTER)])
    impedance = sp.expand(sp.cancel(1 / matrix.U12[0, 0]))
    torque = sp.expand(sp.cancel(-matrix.u1[0] * impedance))
    return JointLaw(
        impedance, sum(torque.coeff(p) and p * sp.factor(torque.coeff(p)) for p in (STIFFNESS, DAMPING))
    )


@cache
def riccati_station() -> RiccatiStation:
    """Derive the recursion over one station."""
    link = riccati_step(_link_matrix(), sp.Matrix([[IMPEDANCE]]), sp.Matrix([[BIAS]]))
    joint = riccati_step(_joint_matrix(), sp.Matrix([[IMPEDANCE]]), sp.Matrix([[BIAS]]))
    pivot = JOINT_IMPEDANCE - IMPEDANCE
    bias = sp.expand(_over_pivot(joint.bias[0], pivot))
    offset = sp.expand(_over_pivot(joint.offset[0], pivot))
    admittance = offset.coeff(BIAS)
    if sp.expand(offset - admittance * (BIAS - KNOWN_TORQUE)) != 0:
        raise ArithmeticError("the outboard unknown should depend on e - w")
    transmission = bias.coeff(BIAS)
    for same in (joint.gain[0], joint.impedance[0] / IMPEDANCE):
        if sp.expand(_over_pivot(same, pivot) - transmission) != 0:
            raise ArithmeticError("a joint should pass on motion and torque alike (Maxwell's reciprocity)")
    return RiccatiStation(
        link_impedance=link.impedance[0],
        link_bias=link.bias[0],
        pivot=pivot,
        transmission=transmission,
        reflection=bias.coeff(KNOWN_TORQUE),
        admittance=admittance,
    )


@dataclass(frozen=True)
class HubLaw:
    """A free hub: ``unknown = (e + T - known) / pivot`` with ``S, e`` given outboard of it."""

    pivot: sp.Expr
    known: sp.Expr


@cache
def hub_law() -> HubLaw:
    """Derive the motion of the hub from its own elements and a free inner end."""
    moving = [DiscreteMotion(GAINS, INNER)]
    impedance, bias = sp.Matrix([[IMPEDANCE]]), sp.Matrix([[BIAS]])
    for element in (LINK, GROUND_DAMPER, TORQUE):
        step = riccati_step(transfer_matrix(element, moving, moving), impedance, bias)
        impedance, bias = step.impedance, step.bias
    return HubLaw(pivot=sp.expand(-impedance[0]), known=sp.expand(BIAS + LOAD - bias[0]))


@dataclass(frozen=True)
class ProductStation:
    """The plain product over one station, by the joint's compliance ``C = 1/K``.

    Parameters
    ----------
    unknown, known : sympy.Expr
        Outboard unknown (gain and known part) behind the joint, from ``kg, fg`` and ``k0, f0`` before it.
    torque, known_torque : sympy.Expr
        Outboard torque behind the link, from ``kg, k0`` at the link and ``fg, f0`` before it.
    """

    unknown: sp.Expr
    known: sp.Expr
    torque: sp.Expr
    known_torque: sp.Expr


UNKNOWN_GAIN, TORQUE_GAIN, UNKNOWN_KNOWN, TORQUE_KNOWN = sp.symbols("kg fg k0 f0", real=True)
COMPLIANCE = sp.Symbol("C", positive=True)


@cache
def product_station() -> ProductStation:
    """Derive one station of the plain product."""
    columns = [sp.Matrix([[s]]) for s in (UNKNOWN_GAIN, TORQUE_GAIN, UNKNOWN_KNOWN, TORQUE_KNOWN)]
    joint = product_step(_joint_matrix(), *columns)
    link = product_step(_link_matrix(), *columns)
    by_compliance = {JOINT_IMPEDANCE: 1 / COMPLIANCE}
    return ProductStation(
        unknown=sp.expand(joint.motion_gain[0].subs(by_compliance)),
        known=sp.factor(sp.expand(joint.motion_known[0].subs(by_compliance)) - UNKNOWN_KNOWN) + UNKNOWN_KNOWN,
        torque=sp.expand(link.force_gain[0]),
        known_torque=sp.expand(link.force_known[0]),
    )


def _joint_matrix() -> TransferMatrix:
    """Return the joint's blocks with its impedance and known torque as names."""
    one, zero = sp.eye(1), sp.zeros(1, 1)
    return TransferMatrix(
        one,
        sp.Matrix([[1 / JOINT_IMPEDANCE]]),
        zero,
        one,
        sp.Matrix([[-KNOWN_TORQUE / JOINT_IMPEDANCE]]),
        zero,
    )


def _link_matrix() -> TransferMatrix:
    moving = [DiscreteMotion(GAINS, OUTER)]
    return transfer_matrix(LINK, moving, moving)


def _over_pivot(expression: sp.Expr, pivot: sp.Expr) -> sp.Expr:
    """Write a fraction with the pivot as denominator by means of the inverse pivot ``Y``."""
    numerator, denominator = sp.fraction(sp.cancel(expression))
    factor = sp.cancel(denominator / pivot)
    if not factor.is_number:
        raise ArithmeticError(f"{expression} does not have the pivot {pivot} as its denominator")
    return sp.expand(numerator / factor) * PIVOT_INVERSE
