"""Parameters of integrators as exact numbers, and the ranges they must lie in."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TypeAlias

import sympy as sp

Number: TypeAlias = "int | float | Fraction | sp.Expr"
"""What a caller may give for a parameter."""

_SIMPLE = 1000
"""Largest denominator that counts as the fraction a rounded float was meant to be."""


def exact(value: Number) -> sp.Expr:
    """Return a parameter as an exact number; symbols and exact expressions pass unchanged.

    A float becomes the simple fraction that rounds to it (``0.25`` is 1/4, ``1/3`` is 1/3), or else the
    decimal number it is written as.

    Raises
    ------
    ValueError
        If the value is not a finite number.
    """
    if isinstance(value, sp.Expr) and not value.has(sp.Float):
        return value
    if isinstance(value, int | Fraction) and not isinstance(value, bool):
        return sp.Rational(value)
    if not isinstance(value, float) and not (isinstance(value, sp.Expr) and value.is_number):
        raise ValueError(f"{value!r} is not an exact expression nor a number")
    number = float(value)
    if not math.isfinite(number):
        raise ValueError(f"{number} is not a finite number")
    simple = Fraction(number).limit_denominator(_SIMPLE)
    return sp.Rational(simple) if float(simple) == number else sp.Rational(repr(number))


def require(condition: sp.Basic | bool, method: str, name: str, value: sp.Expr, allowed: str) -> None:
    """Refuse a parameter that violates its range; symbolic parameters are let through.

    Raises
    ------
    ValueError
        Naming the method, the parameter, its value and what is allowed.
    """
    if condition == False:  # noqa: E712 - a SymPy relation: only a decided "no" refuses
        raise ValueError(f"{method}: {name} = {value} must be {allowed}")
