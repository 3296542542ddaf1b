"""The equations of elements in space, derived a second time from their declarations alone: by the chain rule."""

from __future__ import annotations

from dataclasses import replace

import pytest
import sympy as sp

from tmm_gen.derive.space.declaration import (
    ACCEL,
    ACCELERATION,
    ALPHA,
    ANGLE,
    OMEGA,
    RATE,
    TURN,
    VELOCITY,
    Body,
    Passage,
    hinge,
    offset,
    rigid_body,
    turned,
    vector,
)
from tmm_gen.derive.space.equations import BodyEquations, body_equations, passage_equations
from tmm_gen.derive.space.inward import through_accelerations
from tmm_gen.derive.space.outward import COSINE, SINE
from tmm_gen.derive.space.pattern import Pattern
from tmm_gen.derive.space.pose import (
    FACING,
    FIXED,
    HALF_COSINE,
    HALF_SINE,
    QUATERNION,
    facing_lines,
    quaternion_axes,
    quaternion_lines,
)
from tmm_gen.derive.station.lets import Let, Line, Update

SLANTED = sp.Matrix([[2, -2, 1], [1, 2, 2], [-2, -1, 2]]) / 3
"""A turn of rational entries about an axis that is none of the frame's."""
PASSAGES = [hinge(0), hinge(1), hinge(2), offset(), turned(SLANTED)]
FORCE, MOMENT = vector("force"), vector("moment")


def along(value: sp.Matrix, at: dict[sp.Symbol, sp.Expr]) -> sp.Matrix:
    """Return the time derivative of components whose symbols have given rates."""
    return sum((value.diff(symbol) * rate for symbol, rate in at.items()), sp.zeros(*value.shape))


def rates() -> dict[sp.Symbol, sp.Expr]:
    """Return the rates of all that motion is written by: axes turn, so that components change besides vectors."""
    turning = ACCEL - OMEGA.cross(VELOCITY)
    return {
        ANGLE: RATE,
        RATE: ACCELERATION,
        **{OMEGA[k]: ALPHA[k] for k in range(3)},
        **{VELOCITY[k]: turning[k] for k in range(3)},
    }


def zero(value: sp.Matrix) -> bool:
    return all(
        sp.expand(sp.expand(entry).subs(sp.cos(ANGLE) ** 2, 1 - sp.sin(ANGLE) ** 2)) == 0 for entry in value
    )


def misfit(passage: Passage, by: Passage) -> list[sp.Matrix]:
    """Return what the equations of one element lack of the chain rule on the declaration of another."""
    equations = passage_equations(passage)
    alpha = along(by.omega, rates())
    accel = along(by.velocity, rates()) + by.omega.cross(by.velocity)
    relative = equations.relative
    swept = relative.jacobian(OMEGA) * ALPHA
    return [
        equations.omega - by.omega,
        equations.carried + equations.swung * RATE + equations.pushed * ACCELERATION - alpha,
        equations.turn * ACCEL + swept + equations.omega.cross(relative) - accel,
    ]


@pytest.mark.parametrize("passage", PASSAGES, ids=lambda p: p.name)
def test_motion_across_an_element(passage: Passage) -> None:
    """The proper acceleration of the outer side, found from its velocity; the velocity itself is nowhere left."""
    assert all(zero(lacking) for lacking in misfit(passage, passage))
    assert not passage_equations(passage).relative.free_symbols & set(VELOCITY)


def test_wrong_signs_show() -> None:
    """A declaration with one sign wrong does not meet the equations of the right one."""
    back = hinge(2)
    back = replace(back, turn=back.turn.T)
    aside = offset(sp.Matrix([*vector("offset")[:2], -vector("offset")[2]]))
    for right, wrong in ((hinge(2), back), (offset(), aside), (turned(SLANTED), turned(SLANTED.T))):
        assert not all(zero(lacking) for lacking in misfit(wrong, right))


@pytest.mark.parametrize("passage", PASSAGES, ids=lambda p: p.name)
def test_forces_pass_as_power_does(passage: Passage) -> None:
    """What an element has no mass to keep goes through: its joint at rest, the powers at both sides are one."""
    equations = passage_equations(passage)
    outer = sp.Matrix.vstack(FORCE, MOMENT)
    inner = equations.forces * outer
    still = {RATE: 0}
    motion = sp.Matrix.vstack(passage.velocity, passage.omega).xreplace(still)
    power = (outer.T * motion - inner.T * sp.Matrix.vstack(VELOCITY, OMEGA)).applyfunc(sp.expand)
    assert zero(power)
    assert equations.forces == through_accelerations(equations).T


def test_body_takes_what_kirchhoff_says() -> None:
    """With all terms of velocities, which cancel."""
    body = rigid_body()
    assert kirchhoff(body, body_equations(body)) == (sp.zeros(3, 1), sp.zeros(3, 1))
    # the first moment's sign
    other = rigid_body(first_moment=-vector("first_moment"))
    assert kirchhoff(other, body_equations(body)) != (sp.zeros(3, 1), sp.zeros(3, 1))


def kirchhoff(body: Body, equations: BodyEquations) -> tuple[sp.Matrix, sp.Matrix]:
    """Return what force and moment lack of Kirchhoff's equations on a body's energy.

    ``F = d(dT/dv)/dt + omega x dT/dv`` and ``M = d(dT/domega)/dt + omega x dT/domega + v x dT/dv``.
    """
    by_velocity, by_omega = (
        sp.Matrix([body.kinetic_energy.diff(s) for s in symbols]) for symbols in (VELOCITY, OMEGA)
    )
    force = along(by_velocity, rates()) + OMEGA.cross(by_velocity)
    moment = along(by_omega, rates()) + OMEGA.cross(by_omega) + VELOCITY.cross(by_velocity)
    found_force = equations.force + OMEGA.cross(equations.momentum)
    found_moment = equations.moment + OMEGA.cross(equations.spin)
    return (found_force - force).applyfunc(sp.expand), (found_moment - moment).applyfunc(sp.expand)


def pattern(axis: int, turn: tuple[tuple[int | None, ...], ...]) -> Pattern:
    return Pattern(axis, (False,) * 3, turn, False, (False,) * 3, (False,) * 6)


ANY = ((None,) * 3,) * 3
NONE = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
START = sp.Matrix([5, -1, 3, 1]) / 6
"""A quaternion of length one."""
MIDDLE = sp.Matrix([1, 2, -4, 2]) / 5
HALF = {HALF_SINE: sp.Rational(3, 5), HALF_COSINE: sp.Rational(4, 5)}


@pytest.mark.parametrize("turn", [NONE, ANY], ids=["none", "any"])
@pytest.mark.parametrize("axis", range(3))
def test_quaternions_are_the_axes(axis: int, turn: tuple[tuple[int | None, ...], ...]) -> None:
    """The walk that carries a quaternion and the one that carries axes come to the same, in exact numbers."""
    given = {
        **dict(zip(QUATERNION, START, strict=True)),
        **dict(zip(FIXED, MIDDLE, strict=True)),
        **dict(zip(FACING, quaternion_axes(START).T, strict=True)),
        **dict(zip(TURN, quaternion_axes(MIDDLE), strict=True)),
        **HALF,
        SINE: 2 * HALF[HALF_SINE] * HALF[HALF_COSINE],
        COSINE: HALF[HALF_COSINE] ** 2 - HALF[HALF_SINE] ** 2,
    }
    walked = pattern(axis, turn)
    quaternion = sp.Matrix([carried(quaternion_lines(walked), given)[s] for s in QUATERNION])
    facing = sp.Matrix(3, 3, [carried(facing_lines(walked), given).get(s, given[s]) for s in FACING])
    assert quaternion.dot(quaternion) == 1
    assert facing == quaternion_axes(quaternion).T
    assert facing != quaternion_axes(START).T


def carried(lines: tuple[Line, ...], given: dict[sp.Symbol, sp.Expr]) -> dict[sp.Symbol, sp.Expr]:
    """Return what a station hands on, its lines worked out one by one; values given go before those computed."""
    values = dict(given)
    handed: dict[sp.Symbol, sp.Expr] = {}
    for line in lines:
        if isinstance(line, Let):
            values.setdefault(line.symbol, sp.sympify(line.value).xreplace(values))
        elif isinstance(line, Update):
            handed = {s: sp.sympify(v).xreplace(values) for s, v in line.values.items()}
    return handed
