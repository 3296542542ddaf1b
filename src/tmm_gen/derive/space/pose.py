"""Where sections are in the world, and how fast: a walk outward, for outputs and for loads in world axes alone."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.space.declaration import (
    ANGLE,
    AXES,
    OMEGA,
    VELOCITY,
    Passage,
    hinge,
    offset,
    turned,
    vector,
)
from tmm_gen.derive.space.outward import COSINE, SINE, body_of
from tmm_gen.derive.space.pattern import Pattern
from tmm_gen.derive.space.sheet import Sheet
from tmm_gen.derive.station.lets import Let, Line, Update

PLACE = vector("place")
"""Of the section's origin in the world, m."""
FACING = sp.Matrix(3, 3, lambda i, j: sp.Symbol(f"facing_{AXES[i]}{AXES[j]}", real=True))
"""Components in the section's axes by those in the world's."""
QUATERNION = sp.Matrix(sp.symbols("quaternion_w quaternion_x quaternion_y quaternion_z", real=True))
"""Of the section's axes in the world."""
FIXED = sp.Matrix(sp.symbols("fixed_w fixed_x fixed_y fixed_z", real=True))
"""Of the constant turn before the hinge."""
HALF_SINE, HALF_COSINE = sp.symbols("half_sine half_cosine", real=True)
_CIRCLE = {sp.sin(ANGLE): SINE, sp.cos(ANGLE): COSINE}


def pose_lines(pattern: Pattern) -> tuple[Line, ...]:
    """Return the walk over a station that carries its place and its axes."""
    return (*_circle(), *facing_lines(pattern, place=True))


def facing_lines(pattern: Pattern, *, place: bool = False) -> tuple[Line, ...]:
    """Return the walk over a station that carries its axes, and its place if asked for; sines are there already."""
    sheet = Sheet()
    at, facing = (pattern.base_place, sp.eye(3)) if pattern.rooted else (PLACE, FACING)
    for passage in _passages(pattern):
        if place:
            at = sheet.vector("next_place", at + facing.T * passage.arm, "place", "m")
        turned_axes = passage.turn.xreplace(_CIRCLE) * facing
        facing = sp.Matrix(
            3, 3, lambda i, j, m=turned_axes: sheet.named(f"next_facing_{AXES[i]}{AXES[j]}", m[i, j])
        )
    update = {s: v for s, v in zip(FACING, facing, strict=True) if s != v}
    if place:
        update |= {s: v for s, v in zip(PLACE, at, strict=True) if s != v}
    return (*sheet.lets, Update(update))


def velocity_lines(pattern: Pattern) -> tuple[Line, ...]:
    """Return the walk over a station that carries velocity and angular velocity, in the section's axes."""
    sheet = Sheet()
    velocity, omega = (pattern.base_velocity, sp.zeros(3, 1)) if pattern.rooted else (VELOCITY, OMEGA)
    for passage in _passages(pattern):
        here = {
            **_CIRCLE,
            **dict(zip(VELOCITY, velocity, strict=True)),
            **dict(zip(OMEGA, omega, strict=True)),
        }
        velocity = sheet.vector("next_velocity", passage.velocity.xreplace(here), "velocity", "m/s")
        omega = sheet.vector("next_omega", passage.omega.xreplace(here), "angular velocity", "rad/s")
    carried = zip((*VELOCITY, *OMEGA), (*velocity, *omega), strict=True)
    return (*_circle(), *sheet.lets, Update({s: v for s, v in carried if s != v}))


def quaternion_lines(pattern: Pattern) -> tuple[Line, ...]:
    """Return the walk over a station that carries its axes as a quaternion, which never jumps.

    Half a hinge's angle turns it; the constant turn stands as the quaternion :data:`FIXED`.
    """
    sheet = Sheet()
    found = sp.Matrix([1, 0, 0, 0]) if pattern.rooted else QUATERNION
    if pattern.symbols["turn"] != sp.eye(3):
        found = _named_quaternion(sheet, quaternion_product(found, FIXED))
    half = sp.zeros(4, 1)
    half[0], half[1 + pattern.axis] = HALF_COSINE, HALF_SINE
    found = _named_quaternion(sheet, quaternion_product(found, half))
    circle = [
        Let(HALF_SINE, sp.sin(ANGLE / 2), "sine of half the joint's angle"),
        Let(HALF_COSINE, sp.cos(ANGLE / 2), "its cosine"),
    ]
    return (*circle, *sheet.lets, Update(dict(zip(QUATERNION, found, strict=True))))


def quaternion_product(one: sp.Matrix, other: sp.Matrix) -> sp.Matrix:
    """Return the quaternion of two turns, the second seen from the axes that the first has turned."""
    w, v = one[0], sp.Matrix(one[1:])
    x, u = other[0], sp.Matrix(other[1:])
    return sp.Matrix([w * x - v.dot(u), *(w * u + x * v + v.cross(u))])


def quaternion_axes(quaternion: sp.Matrix) -> sp.Matrix:
    """Return the matrix whose columns are the turned axes, for a quaternion of length one."""
    w, v = quaternion[0], sp.Matrix(quaternion[1:])
    skew = sp.Matrix([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    return (w**2 - v.dot(v)) * sp.eye(3) + 2 * v * v.T + 2 * w * skew


def _named_quaternion(sheet: Sheet, values: sp.Matrix) -> sp.Matrix:
    return sp.Matrix(
        [sheet.named(f"next_quaternion_{p}", value) for p, value in zip("wxyz", values, strict=True)]
    )


def kinetic_energy(pattern: Pattern) -> sp.Expr:
    """Return a body's kinetic energy by its section's velocity and angular velocity."""
    return body_of(pattern).kinetic_energy if pattern.massive else sp.Integer(0)


def _passages(pattern: Pattern) -> list[Passage]:
    symbols = pattern.symbols
    found = [offset(symbols["offset"])] if any(pattern.offset) else []
    found += [turned(symbols["turn"])] if symbols["turn"] != sp.eye(3) else []
    return [*found, hinge(pattern.axis)]


def _circle() -> list[Let]:
    return [Let(SINE, sp.sin(ANGLE), "sine of the joint's angle"), Let(COSINE, sp.cos(ANGLE), "its cosine")]
