"""Parameters of integrators as exact numbers, within the ranges they are declared with."""

from __future__ import annotations

import math
from collections.abc import Mapping
from fractions import Fraction
from typing import TypeAlias

import sympy as sp

from tmm_gen.scene.integrator import Method, Parameter

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


def bind(method: Method, given: Mapping[str, Number]) -> dict[str, sp.Expr]:
    """Return all parameters of a method as exact numbers; those not given have its defaults.

    Raises
    ------
    ValueError
        If one is unknown, no number, or out of its range; symbols are let through.
    """
    known = [parameter.name for parameter in method.parameters]
    for name in given:
        if name not in known:
            choice = f"it has {', '.join(known)}" if known else "it has none"
            raise ValueError(f"{method.name} has no parameter {name!r}; {choice}")
    bound: dict[str, sp.Expr] = {}
    for parameter in method.parameters:
        try:
            value = exact(given.get(parameter.name, parameter.default))
        except ValueError as error:
            raise ValueError(f"{method.name}: {parameter.name}: {error}") from None
        if _outside(parameter, value):
            raise ValueError(f"{method.name}: {parameter.name} = {value} must be {parameter.range}")
        bound[parameter.name] = value
    return bound


def _outside(parameter: Parameter, value: sp.Expr) -> bool:
    """Return whether a value is certainly out of range: of symbols nobody knows."""
    low, high = _end(parameter.low), _end(parameter.high)
    conditions = (value > low, value < high) if parameter.open else (value >= low, value <= high)
    return any(condition == False for condition in conditions)  # noqa: E712 - SymPy: only a decided "no"


def _end(value: float) -> sp.Expr:
    return exact(value) if math.isfinite(value) else sp.oo * int(math.copysign(1, value))
