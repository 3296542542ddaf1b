"""Elements of the torsional chain: spring-damper, inertia, load, damper to ground."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.elements.declaration import Element, torsion_port

STIFFNESS = sp.Symbol("k", positive=True)
DAMPING = sp.Symbol("c", nonnegative=True)
RATIO = sp.Symbol("N", real=True, nonzero=True)
INERTIA = sp.Symbol("I", positive=True)
GROUND_DAMPING = sp.Symbol("b", nonnegative=True)
LOAD = sp.Symbol("T", real=True)

_IN, _OUT = torsion_port("in"), torsion_port("out")
_theta_in, _theta_out = _IN.motions[0], _OUT.motions[0]
(_tau_in,), (_tau_out,) = _IN.forces, _OUT.forces

JOINT = Element(
    name="joint",
    source="Gholampour (2018), eqs. 2-61, 2-62",
    inboard=_IN,
    outboard=_OUT,
    equations=(
        STIFFNESS * (_theta_out.q - _theta_in.q) + DAMPING * (_theta_out.v - _theta_in.v) - _tau_in,
        _tau_out - _tau_in,
    ),
    parameters=(STIFFNESS, DAMPING),
    energies={
        "elastic": STIFFNESS * (_theta_out.q - _theta_in.q) ** 2 / 2,
        "heat": DAMPING * (_theta_out.v - _theta_in.v) ** 2,
    },
)
"""Massless torsion spring with a viscous damper beside it."""

_twist, _twisting = _theta_out.q - _theta_in.q / RATIO, _theta_out.v - _theta_in.v / RATIO

GEARED_JOINT = Element(
    name="geared_joint",
    source="virtual work of a spring that is twisted by theta_out - theta_in / N",
    inboard=_IN,
    outboard=_OUT,
    equations=(_tau_out - STIFFNESS * _twist - DAMPING * _twisting, _tau_in - _tau_out / RATIO),
    parameters=(STIFFNESS, DAMPING, RATIO),
    energies={"elastic": STIFFNESS * _twist**2 / 2, "heat": DAMPING * _twisting**2},
)
"""The same behind a rigid gear, or teeth that give way: N turns of the inner side per turn of the outer one."""

LINK = Element(
    name="link",
    source="Gholampour (2018), eqs. 2-67, 2-68",
    inboard=_IN,
    outboard=_OUT,
    equations=(_theta_out.q - _theta_in.q, _tau_out - _tau_in - INERTIA * _theta_in.a),
    parameters=(INERTIA,),
    energies={"kinetic": INERTIA * _theta_in.v**2 / 2},
)
"""Rigid inertia."""

TORQUE = Element(
    name="torque",
    source="Gholampour (2018), eq. 2-75",
    inboard=_IN,
    outboard=_OUT,
    equations=(_theta_out.q - _theta_in.q, _tau_out - _tau_in + LOAD),
    inputs=(LOAD,),
)
"""External torque on a station: the inner torque jumps by ``-T``."""

GROUND_DAMPER = Element(
    name="ground_damper",
    source="viscous friction of the hub's bearing",
    inboard=_IN,
    outboard=_OUT,
    equations=(_theta_out.q - _theta_in.q, _tau_out - _tau_in - GROUND_DAMPING * _theta_in.v),
    parameters=(GROUND_DAMPING,),
    energies={"heat": GROUND_DAMPING * _theta_in.v**2},
)
"""Viscous damper between a station and ground."""
