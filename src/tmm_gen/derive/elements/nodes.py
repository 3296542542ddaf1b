"""Elements of the planar arm as its sweep sees them: massless rods, with point masses at the nodes between them.

A rigid link of mass ``m`` whose centre lies at ``kappa*l`` is a massless rod with the point masses ``m kappa`` at its
outer end and ``m (1 - kappa)`` at its inner end, and the residual inertia ``I - m kappa (1 - kappa) l^2``, which may be
negative (theorem of parallel axes). Masses of neighbours at the same node add up.

Forces and torques are those the inner side exerts on the outer one, as in :mod:`tmm_gen.derive.elements.planar`.
"""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp

from tmm_gen.derive.elements.declaration import Element
from tmm_gen.derive.elements.planar import (
    DAMPING,
    JOINT,
    LENGTH,
    MASS,
    STIFFNESS,
    planar_port,
)

CARRIED_MASS = sp.Symbol("m_o", nonnegative=True)
PIN_INERTIA = sp.Symbol("J_pin", nonnegative=True)
POINT_MASS = sp.Symbol("M", nonnegative=True)
BODY_INERTIA = sp.Symbol("J", real=True)
FRICTION = sp.Symbol("b", nonnegative=True)
LOAD_X, LOAD_Y, LOAD_TORQUE = sp.symbols("P_x P_y T", real=True)
GRAVITY = sp.Symbol("g", nonnegative=True)

_IN, _OUT = planar_port("in"), planar_port("out")
_x_in, _y_in, _th_in = _IN.motions
_x_out, _y_out, _th_out = _OUT.motions
_fx_in, _fy_in, _m_in = _IN.forces
_fx_out, _fy_out, _m_out = _OUT.forces
_half = sp.Rational(1, 2)

_SAME_PLACE = (_x_out.q - _x_in.q, _y_out.q - _y_in.q)
_SAME_ANGLE = (_th_out.q - _th_in.q,)
_SAME_FORCE = (_fx_out - _fx_in, _fy_out - _fy_in)


def _element(
    name: str,
    source: str,
    equations: tuple[sp.Expr, ...],
    *,
    parameters: tuple[sp.Symbol, ...] = (),
    inputs: tuple[sp.Symbol, ...] = (),
    energies: Mapping[str, sp.Expr] | None = None,
) -> Element:
    return Element(name, source, _IN, _OUT, equations, parameters, inputs, energies or {})


PIN = _element(
    "pin",
    JOINT.source,
    (*_SAME_PLACE, *_SAME_FORCE, *JOINT.equations[4:]),
    parameters=(STIFFNESS, DAMPING),
    energies={
        "elastic": _half * STIFFNESS * (_th_out.q - _th_in.q) ** 2,
        "heat": DAMPING * (_th_out.v - _th_in.v) ** 2,
    },
)
"""Pin with a torsion spring and a viscous damper: passes on place and force, turns as its spring gives way."""

REST = sp.Symbol("theta_0", real=True)
ARMATURE = sp.Symbol("J_a", nonnegative=True)
DRIVE = sp.Symbol("T_d", real=True)

DRIVEN_PIN = _element(
    "driven_pin",
    "Lagrange for a pin with a spring that is slack at an angle, and a motor whose rotor turns with the pin alone",
    (
        *_SAME_PLACE,
        *_SAME_FORCE,
        _m_out - _m_in,
        STIFFNESS * (_th_in.q - _th_out.q + REST)
        + DAMPING * (_th_in.v - _th_out.v)
        + ARMATURE * (_th_in.a - _th_out.a)
        + DRIVE
        - _m_out,
    ),
    parameters=(STIFFNESS, DAMPING, REST, ARMATURE),
    inputs=(DRIVE,),
    energies={
        "kinetic": _half * ARMATURE * (_th_out.v - _th_in.v) ** 2,
        "elastic": _half * STIFFNESS * (_th_out.q - _th_in.q - REST) ** 2,
        "heat": DAMPING * (_th_out.v - _th_in.v) ** 2,
    },
)
"""Pin with a motor: the inertia of its rotor, as it is at the pin, and its torque act between both sides."""

ROD = _element(
    "rod",
    "Gholampour (2018), eqs. 2-3 to 2-9 without mass",
    (
        _x_out.q - _x_in.q - LENGTH * sp.cos(_th_in.q),
        _y_out.q - _y_in.q - LENGTH * sp.sin(_th_in.q),
        *_SAME_ANGLE,
        *_SAME_FORCE,
        _m_in
        - _m_out
        - LENGTH * (sp.cos(_th_in.q) * _fy_out - sp.sin(_th_in.q) * _fx_out)
        - BODY_INERTIA * _th_in.a,
    ),
    parameters=(LENGTH, BODY_INERTIA),
    energies={"kinetic": _half * BODY_INERTIA * _th_in.v**2},
)
"""Rigid massless rod with the inertia ``J`` that point masses at its ends leave over."""

MASS_AT_NODE = _element(
    "point_mass",
    "Newton",
    (
        *_SAME_PLACE,
        *_SAME_ANGLE,
        _fx_in - _fx_out - POINT_MASS * _x_in.a,
        _fy_in - _fy_out - POINT_MASS * _y_in.a,
        _m_in - _m_out,
    ),
    parameters=(POINT_MASS,),
    energies={
        "kinetic": _half * POINT_MASS * (_x_in.v**2 + _y_in.v**2),
        "gravitational": POINT_MASS * GRAVITY * _y_in.q,
    },
)
"""Point mass at a node. Gravity needs no force: it is the acceleration of the base seen from a falling frame."""

BODY = _element(
    "body",
    "Euler",
    (*_SAME_PLACE, *_SAME_ANGLE, *_SAME_FORCE, _m_in - _m_out - BODY_INERTIA * _th_in.a),
    parameters=(BODY_INERTIA,),
    energies={"kinetic": _half * BODY_INERTIA * _th_in.v**2},
)
"""Inertia that turns: a hub, or a body at the tip besides its mass."""

BEARING = _element(
    "bearing",
    "viscous friction",
    (*_SAME_PLACE, *_SAME_ANGLE, *_SAME_FORCE, _m_in - _m_out - FRICTION * _th_in.v),
    parameters=(FRICTION,),
    energies={"heat": FRICTION * _th_in.v**2},
)
"""Viscous damper between a hub and ground."""

LOAD = _element(
    "load",
    "balance of a massless node",
    (
        *_SAME_PLACE,
        *_SAME_ANGLE,
        _fx_in + LOAD_X - _fx_out,
        _fy_in + LOAD_Y - _fy_out,
        _m_in + LOAD_TORQUE - _m_out,
    ),
    inputs=(LOAD_X, LOAD_Y, LOAD_TORQUE),
)
"""External force and torque at a node."""

RIGID_LINK = _element(
    "link",
    "Gholampour (2018), eqs. 2-3 to 2-9, torques about the inner end",
    (
        *ROD.equations[:3],
        _fx_in - _fx_out - MASS * _x_in.a - CARRIED_MASS * (_x_out.a - _x_in.a),
        _fy_in - _fy_out - MASS * _y_in.a - CARRIED_MASS * (_y_out.a - _y_in.a),
        _m_in
        - _m_out
        - LENGTH
        * (
            sp.cos(_th_in.q) * (_fy_out + CARRIED_MASS * _y_in.a)
            - sp.sin(_th_in.q) * (_fx_out + CARRIED_MASS * _x_in.a)
        )
        - PIN_INERTIA * _th_in.a,
    ),
    parameters=(LENGTH, MASS, CARRIED_MASS, PIN_INERTIA),
)
"""A link by its mass, the share ``kappa m`` of it that swings with the outer end, and the inertia about its inner end.

For the linearisations that are the thesis's own, whose links are no rods between nodes.
"""
