"""Energies of the planar arm's elements, derived from their own equations, and how power is summed over a step."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import sympy as sp

from tmm_gen.derive.elements import torsion
from tmm_gen.derive.elements.planar import CENTER, INERTIA, JOINT, MASS, TIP_INERTIA, TIP_MASS
from tmm_gen.derive.integrators.declaration import STEP
from tmm_gen.derive.planar_chain import (
    INNER_ANGLE,
    INNER_RATE,
    LEVER_COSINE,
    LEVER_SINE,
    OUTER_ANGLE,
    OUTER_RATE,
    RATE,
)

V_X, V_Y, HEIGHT = sp.symbols("v_x v_y y", real=True)
"""Velocity and height of a link's inner end, m/s and m."""
GRAVITY = sp.Symbol("g", nonnegative=True)
INNER_ACCELERATION, OUTER_ACCELERATION = sp.symbols("al_i al_o", real=True)
POWER_BEFORE, POWER_AFTER, SLOPE_BEFORE, SLOPE_AFTER = sp.symbols("P_0 P_1 dP_0 dP_1", real=True)


@dataclass(frozen=True)
class LinkEnergy:
    """A link's motion and energies, by motion and height of its inner end and its lever arms.

    Parameters
    ----------
    outer_x, outer_y, outer_height : sympy.Expr
        Velocity and height of the outer end.
    kinetic, gravitational : sympy.Expr
        J.
    tip_kinetic, tip_gravitational : sympy.Expr
        Of the body at the tip, by velocity and height of the end it sits on, J.
    """

    outer_x: sp.Expr
    outer_y: sp.Expr
    outer_height: sp.Expr
    kinetic: sp.Expr
    gravitational: sp.Expr
    tip_kinetic: sp.Expr
    tip_gravitational: sp.Expr


@cache
def link_energy() -> LinkEnergy:
    """Differentiate the places of centre and outer end; a rigid body's energy follows from them (Koenig's theorem)."""
    t = sp.Symbol("t")
    theta, length = sp.Function("theta")(t), sp.Symbol("l", positive=True)
    place = (length * sp.cos(theta), length * sp.sin(theta))
    named = {
        sp.diff(theta, t): RATE,
        length * sp.sin(theta): LEVER_SINE,
        length * sp.cos(theta): LEVER_COSINE,
    }
    swing_x, swing_y = (sp.diff(part, t).subs(named) for part in place)
    rise = place[1].subs(named)
    center_x, center_y = V_X + CENTER * swing_x, V_Y + CENTER * swing_y
    half = sp.Rational(1, 2)
    return LinkEnergy(
        outer_x=V_X + swing_x,
        outer_y=V_Y + swing_y,
        outer_height=HEIGHT + rise,
        kinetic=half * (MASS * (center_x**2 + center_y**2) + INERTIA * RATE**2),
        gravitational=MASS * GRAVITY * (HEIGHT + CENTER * rise),
        tip_kinetic=half * (TIP_MASS * (V_X**2 + V_Y**2) + TIP_INERTIA * RATE**2),
        tip_gravitational=TIP_MASS * GRAVITY * HEIGHT,
    )


@dataclass(frozen=True)
class JointEnergy:
    """What a joint stores and turns to heat.

    Parameters
    ----------
    elastic : sympy.Expr
        J.
    power, slope : sympy.Expr
        Turned to heat, W, and its derivative by time, W/s.
    hub_power, hub_slope : sympy.Expr
        The same of the hub's bearing, by the outer rate and acceleration.
    """

    elastic: sp.Expr
    power: sp.Expr
    slope: sp.Expr
    hub_power: sp.Expr
    hub_slope: sp.Expr


@cache
def joint_energy() -> JointEnergy:
    """Integrate the spring's torque over the bend, and multiply the dampers' torques by the rates they turn at."""
    law = JOINT.equations[-1]
    inner, outer = JOINT.inboard.motions[2], JOINT.outboard.motions[2]
    (torque,) = sp.solve(law, JOINT.outboard.forces[2])
    still = torque.subs({inner.v: 0, outer.v: 0})
    bend = sp.Symbol("bend", real=True)
    elastic = sp.integrate(-still.subs({inner.q: 0, outer.q: bend}), (bend, 0, bend))
    damper = (torque - still).subs({inner.v: INNER_RATE, outer.v: OUTER_RATE})
    power = sp.factor(damper * (INNER_RATE - OUTER_RATE))
    ground = torsion.GROUND_DAMPER
    turned = ground.inboard.motions[0]
    (held,) = (sp.diff(e, turned.v) for e in ground.equations if e.has(turned.v))
    hub_power = -held * OUTER_RATE**2
    return JointEnergy(
        elastic=elastic.subs(bend, OUTER_ANGLE - INNER_ANGLE),
        power=power,
        slope=sp.factor(_by_time(power)),
        hub_power=hub_power,
        hub_slope=_by_time(hub_power),
    )


@cache
def energy_of_step() -> sp.Expr:
    """Return the integral over a step of the cubic through power and slope at both ends: fourth order."""
    tau = sp.Symbol("tau", real=True)
    coefficients = sp.symbols("c0:4")
    cubic = sum(c * tau**k for k, c in enumerate(coefficients))
    slope = sp.diff(cubic, tau)
    conditions = [
        cubic.subs(tau, 0) - POWER_BEFORE,
        slope.subs(tau, 0) - SLOPE_BEFORE,
        cubic.subs(tau, STEP) - POWER_AFTER,
        slope.subs(tau, STEP) - SLOPE_AFTER,
    ]
    found = sp.solve(conditions, coefficients, dict=True)[0]
    return sp.expand(sp.integrate(cubic.subs(found), (tau, 0, STEP)))


def _by_time(power: sp.Expr) -> sp.Expr:
    return sp.diff(power, INNER_RATE) * INNER_ACCELERATION + sp.diff(power, OUTER_RATE) * OUTER_ACCELERATION
