"""Elements of the planar arm with large rotations: rigid link, torsion joint, hub.

Forces and torques are those the inner side exerts on the outer one, so that motions and forces are conjugate. (The
thesis counts ``V`` and ``M`` the other way round; nothing else differs from its eqs. 2-3 to 2-12.)
"""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.elements.declaration import Element, Motion, Port, motion
from tmm_gen.derive.partial import partial

LENGTH = sp.Symbol("l", positive=True)
MASS = sp.Symbol("m", nonnegative=True)
INERTIA = sp.Symbol("I", nonnegative=True)
CENTER = sp.Symbol("kappa", nonnegative=True)
STIFFNESS = sp.Symbol("k", positive=True)
DAMPING = sp.Symbol("c", nonnegative=True)
TIP_MASS = sp.Symbol("m_tip", nonnegative=True)
TIP_INERTIA = sp.Symbol("I_tip", nonnegative=True)


def planar_port(side: str) -> Port:
    """Return the state ``[x, y, theta | F_x, F_y, M]``."""
    motions = tuple(motion(name, side) for name in ("x", "y", "theta"))
    return Port(motions, tuple(sp.Symbol(f"{force}_{side}", real=True) for force in ("F_x", "F_y", "M")))


def point_acceleration(
    inner: Motion, inner_y: Motion, angle: Motion, distance: sp.Expr
) -> tuple[sp.Expr, sp.Expr]:
    """Return the acceleration of a point of a link, by differentiating its position twice.

    Parameters
    ----------
    inner, inner_y : Motion
        Of the link's inboard end.
    angle : Motion
        Of the link.
    distance : sympy.Expr
        From the inboard end, m.
    """
    rotating = (distance * sp.cos(angle.q), distance * sp.sin(angle.q))
    ax, ay = (_by_time(_by_time(part, angle), angle) for part in rotating)
    return inner.a + ax, inner_y.a + ay


def _by_time(value: sp.Expr, angle: Motion) -> sp.Expr:
    """Differentiate by time what moves by an angle and its rate."""
    return partial(value, angle.q) * angle.v + partial(value, angle.v) * angle.a


_IN, _OUT = planar_port("in"), planar_port("out")
_x_in, _y_in, _th_in = _IN.motions
_x_out, _y_out, _th_out = _OUT.motions
_fx_in, _fy_in, _m_in = _IN.forces
_fx_out, _fy_out, _m_out = _OUT.forces
_cos, _sin = sp.cos(_th_in.q), sp.sin(_th_in.q)
_ac_x, _ac_y = point_acceleration(_x_in, _y_in, _th_in, CENTER * LENGTH)
_a_out_x, _a_out_y = point_acceleration(_x_in, _y_in, _th_in, LENGTH)

LINK = Element(
    name="planar_link",
    source="Gholampour (2018), eqs. 2-3 to 2-9",
    inboard=_IN,
    outboard=_OUT,
    equations=(
        # kinematics of the outer end
        _x_out.a - _a_out_x,
        _y_out.a - _a_out_y,
        _th_out.q - _th_in.q,
        # Newton: what enters at the inner end either accelerates the link or leaves at the outer end
        _fx_in - _fx_out - MASS * _ac_x,
        _fy_in - _fy_out - MASS * _ac_y,
        # Euler about the centre of mass
        _m_in
        - _m_out
        - CENTER * LENGTH * (_cos * _fy_in - _sin * _fx_in)
        - (1 - CENTER) * LENGTH * (_cos * _fy_out - _sin * _fx_out)
        - INERTIA * _th_in.a,
    ),
    parameters=(LENGTH, MASS, INERTIA, CENTER),
)
"""Rigid link of length l, mass m, centroidal inertia I, centre of mass at ``kappa*l``.

Gravity needs no term of its own: it is the acceleration of the base seen from a falling frame.
"""

JOINT = Element(
    name="planar_joint",
    source="Gholampour (2018), eq. 2-32, with a damper beside the spring",
    inboard=_IN,
    outboard=_OUT,
    equations=(
        _x_out.a - _x_in.a,
        _y_out.a - _y_in.a,
        _fx_out - _fx_in,
        _fy_out - _fy_in,
        _m_out - _m_in,
        STIFFNESS * (_th_in.q - _th_out.q) + DAMPING * (_th_in.v - _th_out.v) - _m_out,
    ),
    parameters=(STIFFNESS, DAMPING),
)
"""Pin with a torsion spring and a viscous damper."""

TIP = Element(
    name="tip_body",
    source="Newton and Euler for a body fixed to the outer end of the last link",
    inboard=_IN,
    outboard=_OUT,
    equations=(
        _x_out.a - _x_in.a,
        _y_out.a - _y_in.a,
        _th_out.q - _th_in.q,
        _fx_in - _fx_out - TIP_MASS * _x_in.a,
        _fy_in - _fy_out - TIP_MASS * _y_in.a,
        _m_in - _m_out - TIP_INERTIA * _th_in.a,
    ),
    parameters=(TIP_MASS, TIP_INERTIA),
)
"""Tip mass and inertia."""
