"""A base that floats, in the exact linearisation: six balances whose slopes are not symmetric.

What the base does is counted in its own axes: ``x = (moved, turned)`` along and about them, per unit of the unknown.
Then the slopes of the balances are the articulated inertia but for terms that fall with the step, so that they too
are solved without pivoting.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import sympy as sp

from tmm_gen.derive.space.base_balance import GIVES, LEFT, MOVED, TURNED
from tmm_gen.derive.space.base_motion import (
    FACING,
    OWN_FORCE,
    OWN_MOMENT,
    inner_turn,
    motion_values,
    spin_slopes,
)
from tmm_gen.derive.space.declaration import ACCEL, ALPHA, AXES, OMEGA
from tmm_gen.derive.space.equations import body_equations
from tmm_gen.derive.space.inward import BIAS
from tmm_gen.derive.space.newton import CHANGE, COLUMNS, ROWS, SLOPES
from tmm_gen.derive.space.outward import body_of
from tmm_gen.derive.space.pattern import Pattern
from tmm_gen.derive.space.sheet import Sheet
from tmm_gen.derive.station.lets import Let, Line, Pivot, Update

_WAYS = [f"{what}_{axis}" for what in ("moved", "turned") for axis in AXES]
_PUSH = sp.Matrix(9, 6, lambda i, j: sp.Symbol(f"base_push_{COLUMNS[i]}_by_{_WAYS[j]}", real=True))
"""Change of the base's motion per unit of what it does."""
_FACTORS = sp.Matrix(6, 6, lambda i, j: sp.Symbol(f"base_factor_{i + 1}{j + 1}", real=True))
"""Below the diagonal shares of one balance in another, above it what is left of slopes."""


@cache
def balance_lines(
    pattern: Pattern, falls: tuple[bool, ...], gains: tuple[sp.Expr, ...], *, still: bool
) -> tuple[Line, ...]:
    """Return the factors of what nothing holds, and what forces leave by them; pivots must be positive.

    Parameters
    ----------
    pattern : Pattern
        Of the base's body.
    falls, still
        As of the way out.
    gains : tuple of 3 sympy.Expr
        Angle, rate and acceleration per unknown.
    """
    push, lines = _push(falls, gains, still=still)
    sheet = Sheet()
    own = _own(pattern, falls, still=still)
    whole = sp.Matrix(
        6, 9, lambda i, j: sheet.named(f"base_{ROWS[i]}_by_{COLUMNS[j]}", own[i, j] + SLOPES[i, j])
    )
    slopes = whole * push
    s = sp.Matrix(6, 6, lambda i, j: sheet.named(f"base_{ROWS[i]}_by_{_WAYS[j]}", slopes[i, j]))
    lines += sheet.lets
    forces = [*OWN_FORCE, *OWN_MOMENT]
    for k in range(6):
        lines += [Pivot(s[k, k]), Let(GIVES[k], 1 / s[k, k], "motion of the base per force on it")]
        lines += [Let(_FACTORS[k, j], s[k, j], "slope of a balance") for j in range(k + 1, 6)]
        lines += [
            Let(_FACTORS[i, k], s[i, k] * GIVES[k], "of one balance in another") for i in range(k + 1, 6)
        ]
        sheet = Sheet()
        for i in range(k + 1, 6):
            for j in range(k + 1, 6):
                name = f"base_freed_{ROWS[i]}_by_{_WAYS[j]}_{k + 1}"
                s[i, j] = sheet.named(name, s[i, j] - _FACTORS[i, k] * _FACTORS[k, j])
        lines += sheet.lets
    for i in range(6):
        value = forces[i] + BIAS[i] - sum(_FACTORS[i, k] * LEFT[k] for k in range(i))
        lines.append(Let(LEFT[i], value, "what of the balance is left over", "N" if i < 3 else "N m"))
    return tuple(lines)


@cache
def answer_lines(falls: tuple[bool, ...], gains: tuple[sp.Expr, ...], *, still: bool) -> tuple[Line, ...]:
    """Return what the base does, and the change of its motion; arguments as of :func:`balance_lines`."""
    push, _ = _push(falls, gains, still=still)
    sheet = Sheet()
    does: list[sp.Expr] = [sp.Integer(0)] * 6
    for i in reversed(range(6)):
        others = sum(_FACTORS[i, k] * does[k] for k in range(i + 1, 6))
        does[i] = sheet.named(f"base_does_{_WAYS[i]}", -GIVES[i] * (LEFT[i] + others), "in its own axes")
    unturned = inner_turn(sheet)
    moved, turned = FACING.T * sp.Matrix(does[:3]), unturned * sp.Matrix(does[3:])
    lines: list[Line] = [*sheet.lets]
    for symbols, values, what, unit in (
        (MOVED, moved, "place", "m/s^2"),
        (TURNED, turned, "turn", "rad/s^2"),
    ):
        words = f"what the sweep finds the base's {what} to do"
        lines += [Let(symbol, value, words, unit) for symbol, value in zip(symbols, values, strict=True)]
    change = push * sp.Matrix(does)
    return (*lines, Update(dict(zip(CHANGE, change, strict=True))))


def _push(falls: tuple[bool, ...], gains: Sequence[sp.Expr], *, still: bool) -> tuple[sp.Matrix, list[Line]]:
    """Return the change of the base's motion per unit of what it does, by names, and the lines that set these."""
    by_angle, by_rate, by_acceleration = gains
    _, omega, alpha, accel = motion_values(falls, still=still)
    spin, by_turn, turning_rate = spin_slopes(omega, alpha, still=still)
    sheet = Sheet()
    unturned = inner_turn(sheet)

    def named(name: str, values: sp.Matrix) -> sp.Matrix:
        return sp.Matrix(3, 3, lambda i, j: sheet.named(f"base_{name}_{AXES[i]}{AXES[j]}", values[i, j]))

    one, none = sp.eye(3), sp.zeros(3, 3)
    # what the base turns by, an acceleration in its axes is turned back by
    turned_back = sp.Matrix.hstack(*(accel.cross(one[:, k]) for k in range(3)))
    spin = named("spin_by_turned", spin) * unturned
    alpha_slope = by_angle * (named("spinning_by_turned", by_turn) * unturned)
    alpha_slope += by_rate * (named("spinning_by_turning", turning_rate) * unturned)
    values = sp.Matrix.vstack(
        sp.Matrix.hstack(by_acceleration * one, by_angle * turned_back),
        sp.Matrix.hstack(none, by_acceleration * one + alpha_slope),
        sp.Matrix.hstack(none, by_rate * one + by_angle * spin),
    )
    push = sp.Matrix(9, 6, lambda i, j: _PUSH[i, j] if values[i, j] != 0 else 0)
    lets = [
        Let(_PUSH[i, j], values[i, j], "of the base's motion")
        for i in range(9)
        for j in range(6)
        if push[i, j] != 0
    ]
    return push, [*sheet.lets, *lets]


def _own(pattern: Pattern, falls: tuple[bool, ...], *, still: bool) -> sp.Matrix:
    """Return the slopes of the forces that the base's body takes."""
    _, omega, _, _ = motion_values(falls, still=still)
    body = body_equations(body_of(pattern))
    force = body.force + OMEGA.cross(body.momentum)
    moment = body.moment + OMEGA.cross(body.spin)
    slopes = sp.Matrix.vstack(force, moment).jacobian([*ACCEL, *ALPHA, *OMEGA])
    return slopes.xreplace(dict(zip(OMEGA, omega, strict=True))).applyfunc(sp.expand)
