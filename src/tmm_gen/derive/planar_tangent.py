"""How the linearised sweep of a planar arm follows its own point of linearisation, derived link by link.

One Newton iteration solves ``r(z) + A(z) P u = 0`` for the increment ``u`` about the predicted motion ``z``. Its exact
derivative is the solution of ``A P du = -d(r(z) + A(z) P u)|_u``: the same factors, with a right-hand side that is the
derivative of each link's linearised law with ``u`` held at what it was solved to. SymPy takes these derivatives here.

The slope of "force times lever arm" must be taken at the force as predicted, a function of ``z`` alone: were it
taken at the force the outer links have already corrected, ``A`` would depend on its own factors.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import sympy as sp

from tmm_gen.derive.elements.planar import LENGTH
from tmm_gen.derive.planar_chain import (
    A_X,
    A_Y,
    ACCELERATION,
    COSINE,
    LEVER_COSINE,
    LEVER_SINE,
    LOAD_X,
    LOAD_Y,
    RATE,
    SINE,
    TANGENTIAL,
    TURNING,
    link_law,
    link_sweep,
)
from tmm_gen.derive.torsion_chain import GAINS

SOLVED = sp.Symbol("u_solved", real=True)
"""Increment of the link's unknown, as solved."""
PREDICTED_LOAD_X, PREDICTED_LOAD_Y = sp.symbols("L_x_predicted L_y_predicted", real=True)


@dataclass(frozen=True)
class Slopes:
    """Derivatives by a link's predicted angle, rate and acceleration."""

    angle: sp.Expr
    rate: sp.Expr
    acceleration: sp.Expr


@dataclass(frozen=True)
class LinkTangent:
    """Derivatives of a link's linearised law, its increment held.

    Parameters
    ----------
    predicted_x, predicted_y : Slopes
        Of the acceleration of the outer end against the inner one, as predicted.
    solved_x, solved_y : Slopes
        The same as solved: predicted, and its slope times the increment.
    torque : Slopes
        Of the torque at the inner end, loads held.
    load_x, load_y : sympy.Expr
        Of that torque by the loads as solved.
    predicted_load_x, predicted_load_y : sympy.Expr
        Of that torque by the loads as predicted, at which its slope was taken.
    """

    predicted_x: Slopes
    predicted_y: Slopes
    solved_x: Slopes
    solved_y: Slopes
    torque: Slopes
    load_x: sp.Expr
    load_y: sp.Expr
    predicted_load_x: sp.Expr
    predicted_load_y: sp.Expr


@cache
def link_tangent() -> LinkTangent:
    """Differentiate a link's linearised law by its point of linearisation."""
    law, sweep = link_law(), link_sweep()
    ends = {TANGENTIAL: sweep.tangential, TURNING: sweep.turning}
    swing_x, swing_y = law.outer_x - A_X, law.outer_y - A_Y
    at_predicted = law.torque.subs({LOAD_X: PREDICTED_LOAD_X, LOAD_Y: PREDICTED_LOAD_Y})
    increment = sum(GAINS[k] * s for k, s in zip("qva", _parts(at_predicted), strict=True)) * SOLVED
    torque = law.torque + increment
    return LinkTangent(
        predicted_x=slopes(swing_x),
        predicted_y=slopes(swing_y),
        solved_x=slopes(swing_x + sweep.gain_x.subs(ends) * SOLVED),
        solved_y=slopes(swing_y + sweep.gain_y.subs(ends) * SOLVED),
        torque=slopes(torque),
        load_x=sp.diff(torque, LOAD_X),
        load_y=sp.diff(torque, LOAD_Y),
        predicted_load_x=sp.factor(sp.diff(torque, PREDICTED_LOAD_X)),
        predicted_load_y=sp.factor(sp.diff(torque, PREDICTED_LOAD_Y)),
    )


def slopes(expression: sp.Expr) -> Slopes:
    """Differentiate an expression in lever arms, rate and acceleration."""
    return Slopes(*(sp.collect(part, [LEVER_SINE, LEVER_COSINE]) for part in _parts(expression)))


def _parts(expression: sp.Expr) -> tuple[sp.Expr, sp.Expr, sp.Expr]:
    turned = expression.subs({LEVER_SINE: LENGTH * SINE, LEVER_COSINE: LENGTH * COSINE})
    by_angle = sp.diff(turned, SINE) * COSINE - sp.diff(turned, COSINE) * SINE
    back = {SINE: LEVER_SINE / LENGTH, COSINE: LEVER_COSINE / LENGTH}
    return (
        sp.expand(sp.expand(by_angle).subs(back)),
        sp.expand(sp.diff(expression, RATE)),
        sp.expand(sp.diff(expression, ACCELERATION)),
    )
