"""A base that floats, on the way in: six balances in which nothing holds it, solved by their factors.

``S x = -e`` with S symmetric and positive definite, as the inertial linearisation has it: factors ``L D L^T`` without
pivoting, whose pivots are inertias that the base has where what comes before it gives way.
"""

from __future__ import annotations

from functools import cache

import sympy as sp

from tmm_gen.derive.space.base_motion import (
    FACING,
    OWN_FORCE,
    OWN_MOMENT,
    PUSH,
    TURN_ACCELERATION,
    inner_turn,
)
from tmm_gen.derive.space.declaration import ACCEL, ALPHA, AXES, vector
from tmm_gen.derive.space.equations import body_equations
from tmm_gen.derive.space.inward import ARTICULATED, BIAS, CHANGE
from tmm_gen.derive.space.outward import body_of
from tmm_gen.derive.space.pattern import Pattern
from tmm_gen.derive.space.sheet import Sheet
from tmm_gen.derive.station.lets import Let, Line, Pivot, Update

MOVED = vector("base_moved")
TURNED = vector("base_turned")
"""Per unit of acceleration per unknown: what a sweep finds the base to do."""
KINDS = [f"{what}_{axis}" for what in ("force", "moment") for axis in AXES]
LEFT = [sp.Symbol(f"base_left_{kind}", real=True) for kind in KINDS]
CHANGES = [sp.Symbol(f"base_change_{kind}", real=True) for kind in KINDS]
"""Of the base's acceleration and angular acceleration, in its own axes."""
LACKS = [sp.Symbol(f"base_lacks_{kind}", real=True) for kind in KINDS]
"""What of each balance is left over at a known motion."""
GIVES = [sp.Symbol(f"base_give_{kind}", real=True) for kind in KINDS]
SHARES = {(i, k): sp.Symbol(f"base_share_{i + 1}{k + 1}", real=True) for i in range(6) for k in range(i)}


@cache
def balance_lines(pattern: Pattern) -> tuple[Line, ...]:
    """Return the factors of what nothing holds: ``S = L D L^T``, D in pivots that must be positive."""
    own = own_inertia(pattern)
    sheet, lines = Sheet(), list[Line]()
    s = sp.zeros(6, 6)
    for i in range(6):
        for j in range(i, 6):
            name = f"base_whole_{KINDS[i]}{KINDS[j]}"
            s[i, j] = s[j, i] = sheet.named(name, own[i, j] + ARTICULATED[i, j], "of the arm with its base")
    lines += sheet.lets
    for k in range(6):
        lines += [Pivot(s[k, k]), Let(GIVES[k], 1 / s[k, k], "motion of the base per force on it")]
        sheet = Sheet()
        for i in range(k + 1, 6):
            lines.append(Let(SHARES[i, k], s[i, k] * GIVES[k], "of one balance in another"))
        for i in range(k + 1, 6):
            for j in range(i, 6):
                name = f"base_freed_{KINDS[i]}{KINDS[j]}_{k + 1}"
                s[i, j] = s[j, i] = sheet.named(name, s[i, j] - SHARES[i, k] * s[k, j])
        lines += sheet.lets
    return tuple(lines)


def force_lines() -> tuple[Line, ...]:
    """Return what forces leave when the balances before are taken out of each, by the factors."""
    lines: list[Line] = []
    own = [*OWN_FORCE, *OWN_MOMENT]
    for i in range(6):
        value = own[i] + BIAS[i] - sum(SHARES[i, k] * LEFT[k] for k in range(i))
        lines.append(Let(LEFT[i], value, "what of the balance is left over", "N" if i < 3 else "N m"))
    return tuple(lines)


@cache
def answer_lines(gain: sp.Expr) -> tuple[Line, ...]:
    """Return the change of the base's accelerations, and what of place and turn makes it.

    Parameters
    ----------
    gain : sympy.Expr
        Acceleration per unknown.
    """
    *lines, update = change_lines()
    sheet = Sheet()
    moved, turned = by_coordinates(sheet, sp.Matrix(CHANGES))
    lines += sheet.lets
    lines += [
        Let(symbol, value, doc, unit)
        for symbols, values, doc, unit in (
            (MOVED, moved / gain, "what the sweep finds the base's place to do", "m/s^2"),
            (TURNED, turned / gain, "what the sweep finds the base's turn to do", "rad/s^2"),
        )
        for symbol, value in zip(symbols, values, strict=True)
    ]
    return (*lines, update)


def change_lines() -> tuple[Line, ...]:
    """Return the change of the base's accelerations in its own axes, by what forces leave."""
    lines: list[Line] = []
    for i in reversed(range(6)):
        value = -GIVES[i] * LEFT[i] - sum(SHARES[k, i] * CHANGES[k] for k in range(i + 1, 6))
        lines.append(Let(CHANGES[i], value, "of the base's acceleration"))
    return (*lines, Update(dict(zip(CHANGE, CHANGES, strict=True))))


def by_coordinates(sheet: Sheet, change: sp.Matrix) -> tuple[sp.Matrix, sp.Matrix]:
    """Return changes of the accelerations of place and turn by those in the base's axes; names go on a sheet.

    Parameters
    ----------
    change : sympy.Matrix, (6,)
        Of acceleration, then of angular acceleration.
    """
    back = inner_turn(sheet)
    return FACING.T * sp.Matrix(change[:3]), back * sp.Matrix(change[3:])


def lacking_lines() -> tuple[Line, ...]:
    """Return what of each balance is left over at a known motion."""
    forces = zip(LACKS, [*OWN_FORCE, *OWN_MOMENT], BIAS, strict=True)
    return tuple(
        Let(symbol, own + carried, "what the balance of the base lacks", "N" if i < 3 else "N m")
        for i, (symbol, own, carried) in enumerate(forces)
    )


@cache
def taking_up_lines(given: tuple[sp.Symbol, ...]) -> tuple[Line, ...]:
    """Return the accelerations of place and turn with a change that was found in the base's axes.

    Parameters
    ----------
    given : tuple of sympy.Symbol, (6,)
        The change.
    """
    sheet = Sheet()
    moved, turned = by_coordinates(sheet, sp.Matrix(given))
    pairs = zip((*PUSH, *TURN_ACCELERATION), (*moved, *turned), strict=True)
    return (*sheet.lets, Update({symbol: symbol + change for symbol, change in pairs}))


def own_inertia(pattern: Pattern) -> sp.Matrix:
    """Return force and moment of a body by its acceleration and angular acceleration, shape (6, 6)."""
    body = body_equations(body_of(pattern))
    return sp.Matrix.vstack(body.force, body.moment).jacobian([*ACCEL, *ALPHA])
