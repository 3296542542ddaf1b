"""Expansions about the last instant: predicted sines and cosines, products of two changing quantities."""

from __future__ import annotations

from functools import cache

import sympy as sp

ANGLE, RATE, ACCELERATION = sp.symbols("theta_old omega_old alpha_old", real=True)
SPAN = sp.Symbol("Delta", positive=True)
NEW_RATE = sp.Symbol("omega_new", real=True)


@cache
def predicted_trigonometry() -> tuple[sp.Expr, sp.Expr]:
    """Return sine and cosine after ``Delta``, to second order (Gholampour 2018, eqs. 2-14 and 2-15)."""
    angle = ANGLE + RATE * SPAN + ACCELERATION * SPAN**2 / 2
    return _second_order(sp.sin(angle)), _second_order(sp.cos(angle))


def product(a: sp.Expr, b: sp.Expr, old: tuple[sp.Expr, sp.Expr], rates: tuple[sp.Expr, sp.Expr]) -> sp.Expr:
    """Return a product linear in its new factors (eq. 2-16): ``a b ~ a- b + a b- - a- b- + ad- bd- Delta^2``.

    It follows from ``(a - a-)(b - b-) ~ (ad- Delta)(bd- Delta)``.
    """
    return sp.expand(a * old[1] + old[0] * b - old[0] * old[1] + rates[0] * rates[1] * SPAN**2)


@cache
def square_of_rate() -> sp.Expr:
    """Return the new rate squared, linear in the new rate (eq. 2-17)."""
    return product(NEW_RATE, NEW_RATE, (RATE, RATE), (ACCELERATION, ACCELERATION))


def _second_order(function: sp.Expr) -> sp.Expr:
    terms = [sp.diff(function, SPAN, k).subs(SPAN, 0) * SPAN**k / sp.factorial(k) for k in range(3)]
    old = (sp.sin(ANGLE), sp.cos(ANGLE))
    return sp.collect(sp.expand(sp.Add(*terms)), old)
