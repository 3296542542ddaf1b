"""A base that floats: its motion by a turn counted from where a step begins.

The turn within a step is said by three numbers: four times the tangent of a quarter of the angle, along the axis. The
quaternion of the base is that at the step's start times ``(1 - turn^2/16, turn/2)``, over ``1 + turn^2/16``. All that
follows of it are fractions, which have no singular point but a whole turn in one step, so that an integrator keeps its
order in these coordinates. So it does where it looks back over several steps, whose turns are counted anew from where
each step begins.
"""

from __future__ import annotations

from functools import cache

import sympy as sp

from tmm_gen.derive.space.declaration import ACCEL, ALPHA, AXES, OMEGA, vector
from tmm_gen.derive.space.outward import body_force
from tmm_gen.derive.space.pattern import Pattern
from tmm_gen.derive.space.pose import quaternion_axes, quaternion_product
from tmm_gen.derive.space.sheet import Sheet
from tmm_gen.derive.station.lets import Let, Line, Update

START = sp.Matrix(sp.symbols("start_w start_x start_y start_z", real=True))
"""Quaternion of the base at the start of the step, of length one."""
TURN, TURN_RATE, TURN_ACCELERATION = (vector(f"base_turn{kind}") for kind in ("", "_rate", "_acceleration"))
"""What has turned it since then, and the derivatives by time."""
PUSH = vector("base_push")
"""Acceleration of its origin, in world axes."""
GRAVITY = vector("gravity")
FACING = sp.Matrix(3, 3, lambda i, j: sp.Symbol(f"base_facing_{AXES[i]}{AXES[j]}", real=True))
"""Components in the base's axes by those in the world's."""
SPINNING = vector("base_spinning")
"""Angular acceleration, in its own axes."""
FOUND = sp.Matrix(sp.symbols("base_found_w base_found_x base_found_y base_found_z", real=True))
"""Quaternion of the base."""
_SLOWING = sp.Symbol("base_slowing", real=True)
_NEAR, _NEARING, _NEARED = sp.symbols("base_near base_nearing base_neared", real=True)
"""First part of the turn's quaternion before that is brought to length one, and its derivatives by time."""
_SHORT, _SHORTER = sp.symbols("base_shortness base_shortness_squared", real=True)
"""What brings it there, and the square of that."""
OWN_FORCE, OWN_MOMENT = vector("base_force"), vector("base_moment")
"""What its own body takes."""
_SCALE = sp.Symbol("base_scale", real=True)
NEW_QUATERNION = sp.Matrix(sp.symbols("base_new_w base_new_x base_new_y base_new_z", real=True))
NEW_OMEGA, NEW_ALPHA = vector("base_new_omega"), vector("base_new_alpha")
"""At the end of a step."""


def _defined() -> dict[sp.Symbol, sp.Expr]:
    """Return what the first part of the turn's quaternion and its derivatives are."""
    near = 1 - TURN.dot(TURN) / 16
    nearing = sum(near.diff(s) * rate for s, rate in zip(TURN, TURN_RATE, strict=True))
    rates = zip((*TURN, *TURN_RATE), (*TURN_RATE, *TURN_ACCELERATION), strict=True)
    return {_NEAR: near, _NEARING: nearing, _NEARED: sum(nearing.diff(s) * rate for s, rate in rates)}


@cache
def _kinematics() -> tuple[sp.Matrix, sp.Expr, sp.Matrix]:
    """Return the turn's quaternion, its length, and the angular velocity times the square of that length."""
    relative = sp.Matrix([_NEAR, *(TURN / 2)])
    changing = sp.Matrix([_NEARING, *(TURN_RATE / 2)])
    inverse = sp.Matrix([relative[0], *(-relative[1:, 0])])
    doubled = (2 * quaternion_product(inverse, changing)).applyfunc(sp.expand)
    length = 2 - _NEAR
    explicit = _defined()
    if sp.expand((length**2 - relative.dot(relative)).xreplace(explicit)) != 0:
        raise AssertionError("the length of the turn's quaternion is a square root")
    return relative, length, sp.Matrix(doubled[1:])


def _changing(value: sp.Matrix | sp.Expr) -> sp.Matrix | sp.Expr:
    """Return the derivative by time of what turn and its rate make."""
    rates = zip(
        (*TURN, *TURN_RATE, _NEAR, _NEARING), (*TURN_RATE, *TURN_ACCELERATION, _NEARING, _NEARED), strict=True
    )
    terms = [value.diff(symbol) * rate for symbol, rate in rates]
    return sum(terms[1:], terms[0])


def spinning(sheet: Sheet, accelerations: dict[sp.Symbol, sp.Expr]) -> tuple[sp.Matrix, sp.Matrix]:
    """Return angular velocity and angular acceleration of the base, in its own axes; names go on a sheet.

    They are quotients by the square of a length, whose derivatives are written by themselves.
    """
    _, length, twice = _kinematics()
    defined = _defined()
    sheet.named(_NEARING.name, sp.factor_terms(defined[_NEARING]), "its derivative by time")
    sheet.named(_NEARED.name, sp.factor_terms(defined[_NEARED].xreplace(accelerations)), "and the second")
    sheet.named(_SHORTER.name, _SHORT**2)
    omega = sheet.vector("base_spin", (_SHORTER * twice), "angular velocity", "rad/s")
    slowing = sheet.named(_SLOWING.name, sp.factor_terms(_changing(length**2)), "of that length's square")
    faster = _changing(twice).applyfunc(sp.expand).xreplace(accelerations)
    alpha = sheet.vector(
        "base_spinning", _SHORTER * (faster - slowing * omega), "angular acceleration", "rad/s^2"
    )
    return omega, alpha


def found_quaternion(sheet: Sheet) -> sp.Matrix:
    """Return the quaternion of the base; names go on a sheet."""
    relative, length, _ = _kinematics()
    sheet.named(_NEAR.name, sp.factor_terms(_defined()[_NEAR]), "first part of the turn's quaternion")
    sheet.named(_SHORT.name, 1 / length, "one over the length of that")
    values = quaternion_product(START, relative)
    return sp.Matrix(
        [
            sheet.named(s.name, _SHORT * value, "quaternion of the base")
            for s, value in zip(FOUND, values, strict=True)
        ]
    )


def motion_values(falls: tuple[bool, ...], *, still: bool) -> tuple[Sheet, sp.Matrix, sp.Matrix, sp.Matrix]:
    """Return names in order, and angular velocity, angular and proper acceleration of the base by them.

    Parameters
    ----------
    falls : tuple of bool, length 3
        Which components gravity has.
    still : bool
        Whether the accelerations of place and turn are zero.
    """
    sheet = Sheet()
    none = dict.fromkeys((*TURN_ACCELERATION, *PUSH), sp.Integer(0)) if still else {}
    quaternion = found_quaternion(sheet)
    omega, alpha = spinning(sheet, none)
    axes = quaternion_axes(quaternion).T
    facing = sp.Matrix(3, 3, lambda i, j: sheet.named(FACING[i, j].name, axes[i, j], "axes of the base"))
    weight = sp.Matrix([g if flag else 0 for g, flag in zip(GRAVITY, falls, strict=True)])
    accel = sheet.vector(
        "base_proper", facing * (PUSH.xreplace(none) - weight), "proper acceleration", "m/s^2"
    )
    return sheet, omega, alpha, accel


@cache
def outward_lines(pattern: Pattern, falls: tuple[bool, ...], *, still: bool) -> tuple[Line, ...]:
    """Return the exact motion of the base, and what its body takes.

    Parameters
    ----------
    pattern : Pattern
        Of the base's body.
    falls, still
        As of :func:`motion_values`.
    """
    sheet, omega, alpha, accel = motion_values(falls, still=still)
    own = body_force(sheet, pattern, omega, alpha, accel, (OWN_FORCE, OWN_MOMENT))
    carried = zip((*OMEGA, *ALPHA, *ACCEL), (*omega, *alpha, *accel), strict=True)
    return (*sheet.lets, *own, Update(dict(carried)))


def spin_slopes(omega: sp.Matrix, alpha: sp.Matrix, *, still: bool) -> tuple[sp.Matrix, sp.Matrix, sp.Matrix]:
    """Return slopes of the angular motion: velocity by turn, acceleration by turn and by its rate, (3, 3) each.

    Parameters
    ----------
    omega, alpha : sympy.Matrix
        Names of the angular velocity and acceleration.
    """
    none = dict.fromkeys(TURN_ACCELERATION, sp.Integer(0)) if still else {}
    _, length, twice = _kinematics()
    square = length**2
    faster = _changing(twice).applyfunc(sp.expand).xreplace(none)
    slowing = _changing(square)
    defined = {s: value.xreplace(none) for s, value in _defined().items()}

    def by(values: sp.Matrix | sp.Expr, symbols: sp.Matrix) -> sp.Matrix:
        """Return a Jacobian, by way of what has names too."""
        values = sp.Matrix([values])
        found = values.jacobian(symbols)
        for s, value in defined.items():
            found += values.diff(s) * sp.Matrix([value]).jacobian(symbols)
        return found

    # slopes of quotients, written by the quotients themselves
    spin = _SHORTER * (by(twice, TURN) - omega * by(square, TURN))
    by_turn = _SHORTER * (
        by(faster, TURN) - omega * by(slowing, TURN) - _SLOWING * spin - alpha * by(square, TURN)
    )
    spin_by_rate = _SHORTER * by(twice, TURN_RATE)
    by_rate = _SHORTER * (by(faster, TURN_RATE) - omega * by(slowing, TURN_RATE) - _SLOWING * spin_by_rate)
    return spin, by_turn, by_rate


@cache
def inner_turn_values() -> sp.Matrix:
    """Return the rate of the turn by the angular velocity, shape (3, 3), by the turn."""
    _, length, twice = _kinematics()
    defined = _defined()
    by_rate = twice.xreplace(defined).applyfunc(sp.expand).jacobian(TURN_RATE)
    square = length.xreplace(defined) ** 2
    return (by_rate.inv(method="ADJ") * square).applyfunc(lambda v: sp.expand(sp.cancel(v)))


def inner_turn(sheet: Sheet) -> sp.Matrix:
    """Return the rate of the turn by the angular velocity, shape (3, 3); names go on a sheet."""
    values = inner_turn_values()
    return sp.Matrix(3, 3, lambda i, j: sheet.named(f"base_unturned_{AXES[i]}{AXES[j]}", values[i, j]))


@cache
def end_lines() -> tuple[Line, ...]:
    """Return quaternion, angular velocity and angular acceleration where a step ends, at its turn.

    Of any step's end the quaternion has length one, so that rounding does not add up.
    """
    sheet = Sheet()
    quaternion = found_quaternion(sheet)
    omega, alpha = spinning(sheet, {})
    # one step of Newton's method for one over the root, near one
    scale = (3 - quaternion.dot(quaternion)) / 2
    lines: list[Line] = [*sheet.lets, Let(_SCALE, scale, "what takes rounding off its length")]
    ends = zip(
        (*NEW_QUATERNION, *NEW_OMEGA, *NEW_ALPHA), (*(_SCALE * quaternion), *omega, *alpha), strict=True
    )
    return (*lines, Update(dict(ends)))


AGO_QUATERNION = sp.Matrix(sp.symbols("ago_w ago_x ago_y ago_z", real=True))
AGO_OMEGA, AGO_ALPHA = vector("ago_omega"), vector("ago_alpha")
"""Motion of the base at an earlier instant."""
PAST_TURN, PAST_RATE, PAST_ACCELERATION = (
    vector(f"base_past{kind}") for kind in ("", "_rate", "_acceleration")
)
"""The same by a turn from where the step begins."""


@cache
def past_lines() -> tuple[Line, ...]:
    """Return how the base was turned at an earlier instant, counted from where the step begins."""
    sheet = Sheet()
    back = sp.Matrix([START[0], *(-START[1:, 0])])
    values = quaternion_product(back, AGO_QUATERNION)
    relative = [
        sheet.named(f"base_since_{p}", value, "turn since then")
        for p, value in zip("wxyz", values, strict=True)
    ]
    lines: list[Line] = [
        *sheet.lets,
        Update({s: 4 * v / (1 + relative[0]) for s, v in zip(PAST_TURN, relative[1:], strict=True)}),
    ]
    return (*lines, *turning_lines(PAST_TURN, AGO_OMEGA, AGO_ALPHA, PAST_RATE, PAST_ACCELERATION))


def turning_lines(
    turn: sp.Matrix, omega: sp.Matrix, alpha: sp.Matrix, rate: sp.Matrix, acceleration: sp.Matrix
) -> list[Line]:
    """Return how a turn changes, by angular velocity and acceleration.

    Parameters
    ----------
    turn, omega, alpha : sympy.Matrix
        Symbols of what is known, (3,) each.
    rate, acceleration : sympy.Matrix
        Symbols of the first and the second derivative of the turn, which are set.
    """
    then = dict(zip(TURN, turn, strict=True))
    sheet = Sheet()
    back_turn = inner_turn(sheet)
    lines: list[Line] = [Let(let.symbol, let.value.xreplace(then), let.doc, let.unit) for let in sheet.lets]
    lines.append(Update(dict(zip(rate, back_turn * omega, strict=True))))
    sheet = Sheet()
    dots = [
        sheet.named(f"base_turning_{word}", left.dot(right))
        for word, left, right in (("out", turn, rate), ("along", turn, omega), ("about", rate, omega))
    ]
    drift = _drifting(turn, rate, omega, dots)
    plain = sum((inner_turn_values().diff(s) * r for s, r in zip(TURN, rate, strict=True)), sp.zeros(3, 3))
    exact = (plain.xreplace(then) * omega).applyfunc(sp.expand)
    if (_drifting(turn, rate, omega, [let.value for let in sheet.lets]) - exact).applyfunc(
        sp.expand
    ) != sp.zeros(3, 1):
        raise AssertionError("a turn's rate by the angular velocity changes otherwise")
    lines += sheet.lets
    lines.append(Update(dict(zip(acceleration, back_turn * alpha + drift, strict=True))))
    return lines


def _drifting(turn: sp.Matrix, rate: sp.Matrix, omega: sp.Matrix, dots: list[sp.Expr]) -> sp.Matrix:
    """Return what changes the rate of a turn where the angular velocity stands, by three products of these, (3,)."""
    out, along, about = dots
    return rate.cross(omega) / 2 + (along * rate + about * turn - out * omega) / 8
