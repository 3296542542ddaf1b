"""What an element in space is: where it puts the next section, or the kinetic energy it holds. The rest is derived.

A section of an arm has a frame. Its motion is said in that frame's own axes: the velocity of its origin, the angular
velocity, the angular acceleration, and the *proper* acceleration of the origin, which is the true one less gravity. In
such axes a position or an orientation occurs nowhere.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

AXES = "xyz"


def vector(name: str) -> sp.Matrix:
    """Return a vector of symbols."""
    return sp.Matrix([sp.Symbol(f"{name}_{axis}", real=True) for axis in AXES])


VELOCITY = vector("velocity")
OMEGA = vector("omega")
"""Angular velocity."""
ALPHA = vector("alpha")
"""Angular acceleration."""
ACCEL = vector("accel")
"""Proper acceleration of the frame's origin."""
BASE_ACCEL = vector("base_accel")
BASE_PLACE, BASE_VELOCITY = vector("base_place"), vector("base_velocity")
"""The same of a base at rest: gravity with its sign turned."""

ANGLE, RATE, ACCELERATION = sp.symbols("hinge_angle hinge_rate hinge_acceleration", real=True)
"""Of the hinge's own coordinate."""

OFFSET = vector("offset")
MASS = sp.Symbol("mass", real=True)
FIRST_MOMENT = vector("first_moment")
"""Mass times the centre of mass."""
PAIRS = ("xx", "yy", "zz", "xy", "xz", "yz")
_PLACES = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
INERTIA = tuple(sp.Symbol(f"inertia_{pair}", real=True) for pair in PAIRS)
"""Of the inertia matrix about the frame's origin."""
TURN = sp.Matrix(3, 3, lambda i, j: sp.Symbol(f"turn_{AXES[i]}{AXES[j]}", real=True))
"""Axes of the outer side by columns, seen from the inner side."""


def symmetric(entries: tuple[sp.Expr, ...]) -> sp.Matrix:
    """Return a symmetric matrix from its entries xx, yy, zz, xy, xz, yz."""
    matrix = sp.zeros(3, 3)
    for (i, j), entry in zip(_PLACES, entries, strict=True):
        matrix[i, j] = matrix[j, i] = entry
    return matrix


@dataclass(frozen=True)
class Passage:
    """A massless element between two sections, by where it puts the outer one.

    Parameters
    ----------
    name : str
        Identifier.
    turn : sympy.Matrix
        Components in the outer axes by those in the inner ones; may depend on the hinge's angle.
    arm : sympy.Matrix
        Place of the outer origin from the inner one, in the inner axes.
    """

    name: str
    turn: sp.Matrix
    arm: sp.Matrix

    @property
    def omega(self) -> sp.Matrix:
        """Angular velocity at the outer side, in its axes."""
        turning = (self.turn.diff(ANGLE) * RATE * self.turn.T).applyfunc(sp.trigsimp)
        spin = sp.Matrix([turning[1, 2], turning[2, 0], turning[0, 1]])
        return self.turn * OMEGA + spin

    @property
    def velocity(self) -> sp.Matrix:
        """Velocity of the outer origin, in its axes."""
        return self.turn * (VELOCITY + OMEGA.cross(self.arm))


@dataclass(frozen=True)
class Body:
    """A rigid body fixed to a section.

    Parameters
    ----------
    kinetic_energy : sympy.Expr
        By the section's velocity and angular velocity, J.
    """

    name: str
    kinetic_energy: sp.Expr


def hinge(axis: int) -> Passage:
    """Return a joint that turns about one of its frame's axes."""
    s, c = sp.sin(ANGLE), sp.cos(ANGLE)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    turn = sp.eye(3)
    turn[i, i] = turn[j, j] = c
    turn[i, j], turn[j, i] = s, -s
    return Passage("hinge", turn, sp.zeros(3, 1))


def offset(arm: sp.Matrix = OFFSET) -> Passage:
    """Return a rigid way from a frame's origin to another point, axes kept."""
    return Passage("offset", sp.eye(3), arm)


def turned(axes: sp.Matrix = TURN) -> Passage:
    """Return a constant change of axes; the outer ones by columns, seen from the inner side."""
    return Passage("turned", axes.T, sp.zeros(3, 1))


def rigid_body(
    mass: sp.Expr = MASS, first_moment: sp.Matrix = FIRST_MOMENT, inertia: tuple[sp.Expr, ...] = INERTIA
) -> Body:
    """Return a body by its mass, first moment and inertia about the frame's origin."""
    energy = (
        mass * VELOCITY.dot(VELOCITY) / 2
        + VELOCITY.dot(OMEGA.cross(first_moment))
        + (OMEGA.T * symmetric(inertia) * OMEGA)[0] / 2
    )
    return Body("body", energy)


def about_center(mass: sp.Expr, center: sp.Matrix, inertia: sp.Matrix) -> sp.Expr:
    """Return the kinetic energy of a body whose inertia is said about its centre of mass."""
    there = VELOCITY + OMEGA.cross(center)
    return mass * there.dot(there) / 2 + (OMEGA.T * inertia * OMEGA)[0] / 2
