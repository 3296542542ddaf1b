"""Elements in space in small motion about rest, from their exact equations.

At rest nothing turns, and every section accelerates properly by gravity with its sign turned. To first order what a
section does beyond that is linear in accelerations and in the hinge's own motion; rates take no part.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive.space.declaration import ACCEL, ACCELERATION, ALPHA, OMEGA, RATE, Body, Passage
from tmm_gen.derive.space.equations import body_equations, passage_equations

_ACCELERATIONS = [*ACCEL, *ALPHA]
_RATES = [*OMEGA, RATE]


@dataclass(frozen=True)
class RestingPassage:
    """A massless element about rest.

    Parameters
    ----------
    through : sympy.Matrix, shape (6, 6)
        Proper and angular acceleration at the outer side by those at the inner one. Its transpose carries force and
        moment from the outer side to the inner one.
    pushed : sympy.Matrix, shape (6, 1)
        The same by the hinge's own acceleration.
    """

    through: sp.Matrix
    pushed: sp.Matrix


def resting_passage(passage: Passage) -> RestingPassage:
    """Derive a massless element about rest.

    Raises
    ------
    ValueError
        If rates take part, or forces do not pass as power does.
    """
    equations = passage_equations(passage)
    relative = equations.relative
    accel = equations.turn * ACCEL + relative.jacobian(OMEGA) * ALPHA + equations.omega.cross(relative)
    alpha = equations.carried + equations.swung * RATE + equations.pushed * ACCELERATION
    whole = sp.Matrix.vstack(accel, alpha)
    through = _slopes(whole, _ACCELERATIONS)
    if not _slopes(whole, _RATES).is_zero_matrix:
        raise ValueError(f"rates act on '{passage.name}' at rest")
    if equations.forces != through.T:
        raise ValueError(f"forces do not pass '{passage.name}' as power does")
    return RestingPassage(through, _slopes(whole, [ACCELERATION]))


def resting_body(body: Body) -> sp.Matrix:
    """Return force and moment that a body takes by its section's proper and angular acceleration, shape (6, 6).

    Raises
    ------
    ValueError
        If rates take part at rest.
    """
    equations = body_equations(body)
    force = equations.force + OMEGA.cross(equations.momentum)
    moment = equations.moment + OMEGA.cross(equations.spin)
    whole = sp.Matrix.vstack(force, moment)
    if not _slopes(whole, list(OMEGA)).is_zero_matrix:
        raise ValueError(f"rates act on '{body.name}' at rest")
    return _slopes(whole, _ACCELERATIONS)


def _slopes(values: sp.Matrix, symbols: list[sp.Symbol]) -> sp.Matrix:
    """Return derivatives where rates are zero."""
    return values.jacobian(symbols).xreplace(dict.fromkeys(_RATES, sp.S.Zero)).applyfunc(sp.expand)
