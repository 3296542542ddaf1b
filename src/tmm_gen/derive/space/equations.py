"""Exact equations of elements in space, from their places and energies.

Axes turn with the section, so that the derivative of a vector is that of its components plus ``omega x`` it, and the
proper acceleration is ``accel = d velocity / dt + omega x velocity`` in a frame that falls with gravity. Velocities
themselves cancel. Forces follow from the power of what has no mass, and from Kirchhoff's equations for what has.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import sympy as sp

from tmm_gen.derive.space.declaration import (
    ACCEL,
    ALPHA,
    ANGLE,
    OMEGA,
    RATE,
    VELOCITY,
    Body,
    Passage,
    hinge,
)


@dataclass(frozen=True)
class PassageEquations:
    """Motion at the outer side, and what carries forces to the inner one.

    Parameters
    ----------
    omega : sympy.Matrix
        Angular velocity.
    carried, swung, pushed : sympy.Matrix
        What angular acceleration, rate and acceleration of the hinge make of the angular acceleration, which is
        ``carried + swung * rate + pushed * acceleration``.
    turn, arm : sympy.Matrix
        As of the element.
    relative : sympy.Matrix
        Velocity of the outer origin against the inner one, in the outer axes; the proper acceleration is
        ``turn * accel + d relative / dt + omega x relative``.
    forces : sympy.Matrix, shape (6, 6)
        Force and moment at the inner side by those at the outer one.
    """

    omega: sp.Matrix
    carried: sp.Matrix
    swung: sp.Matrix
    pushed: sp.Matrix
    turn: sp.Matrix
    arm: sp.Matrix
    relative: sp.Matrix
    forces: sp.Matrix


@dataclass(frozen=True)
class BodyEquations:
    """Force and moment that a body's motion takes.

    Parameters
    ----------
    momentum, spin : sympy.Matrix
        Momentum and angular momentum about the origin, of a body whose origin rests.
    force, moment : sympy.Matrix
        ``force = mass * accel + d momentum / dt + omega x momentum``, and likewise the moment with the spin; here what
        is linear in accelerations, without the cross products.
    """

    momentum: sp.Matrix
    spin: sp.Matrix
    force: sp.Matrix
    moment: sp.Matrix


@cache
def hinge_equations(axis: int) -> PassageEquations:
    """Return the equations of a joint about one of its frame's axes: three of them serve every arm."""
    return passage_equations(hinge(axis))


def passage_equations(passage: Passage) -> PassageEquations:
    """Derive the equations of a massless element."""
    velocity, omega = passage.velocity, passage.omega
    relative = (velocity - passage.turn * VELOCITY).applyfunc(sp.expand)
    power = sp.Matrix.vstack(velocity, omega).jacobian([*VELOCITY, *OMEGA])
    return PassageEquations(
        omega=omega,
        carried=omega.jacobian(OMEGA) * ALPHA,
        swung=omega.diff(ANGLE),
        pushed=omega.diff(RATE),
        turn=passage.turn,
        arm=passage.arm,
        relative=relative,
        forces=power.T,
    )


def body_equations(body: Body) -> BodyEquations:
    """Derive the equations of a rigid body."""
    momentum, spin = (
        sp.Matrix([sp.diff(body.kinetic_energy, s) for s in symbols]) for symbols in (VELOCITY, OMEGA)
    )
    still = dict.fromkeys(VELOCITY, 0)
    falling = dict(zip(VELOCITY, ACCEL, strict=True))
    turning = dict(zip(OMEGA, ALPHA, strict=True))

    def by_accelerations(value: sp.Matrix) -> sp.Matrix:
        return value.xreplace({**falling, **turning}).applyfunc(sp.expand)

    return BodyEquations(
        momentum=momentum.xreplace(still).applyfunc(sp.expand),
        spin=spin.xreplace(still).applyfunc(sp.expand),
        force=by_accelerations(momentum),
        moment=by_accelerations(spin),
    )
