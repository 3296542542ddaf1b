"""Polynomials through motion data: the source of multistep relations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive.integrators.declaration import STEP, Kind, past, stage

h = STEP

TIME = sp.Symbol("tau", real=True)
"""Time since the newest known instant, in steps."""

_DERIVATIVES: dict[Kind, int] = {"q": 0, "v": 1, "a": 2}


@dataclass(frozen=True)
class Datum:
    """One interpolation condition.

    Parameters
    ----------
    instant : sympy.Expr
        In steps from the newest known instant.
    value : sympy.Expr
        What the polynomial, or a derivative of it, equals there.
    derivative : int
        Order of that derivative with respect to time in seconds.
    """

    instant: sp.Expr
    value: sp.Expr
    derivative: int = 0


def known(kind: Kind, lag: int = 0) -> Datum:
    """Return the condition that a displacement's interpolant meets a value of the history."""
    return Datum(sp.Integer(-lag), past(kind, lag), _DERIVATIVES[kind])


def interpolant(data: Sequence[Datum]) -> sp.Expr:
    """Return the polynomial in ``TIME`` of lowest degree that meets all data.

    Raises
    ------
    ValueError
        If the data do not determine a polynomial of degree ``len(data) - 1``.
    """
    coefficients = sp.symbols(f"c0:{len(data)}")
    polynomial = sum((c * TIME**k for k, c in enumerate(coefficients)), sp.Integer(0))
    conditions = [derivative(polynomial, d.derivative, d.instant) - d.value for d in data]
    solution = sp.solve(conditions, coefficients, dict=True)
    if len(solution) != 1 or len(solution[0]) < len(data):
        raise ValueError(f"{len(data)} data do not determine a polynomial: {data}")
    return polynomial.subs(solution[0])


def derivative(polynomial: sp.Expr, order: int, instant: sp.Expr) -> sp.Expr:
    """Return a derivative with respect to time in seconds of a polynomial in ``TIME``."""
    return (sp.diff(polynomial, (TIME, order)) / h**order).subs(TIME, instant)


def motion_relations(data: Sequence[Datum], index: int = 1) -> tuple[sp.Expr, sp.Expr]:
    """Return the two relations of a stage at ``t + h`` that lies on the interpolant of its displacement.

    Parameters
    ----------
    data : sequence of Datum
        Conditions besides the new displacement itself.
    index : int
        The stage's number.
    """
    one = sp.Integer(1)
    polynomial = interpolant([*data, Datum(one, stage("q", index))])
    return (
        sp.expand(derivative(polynomial, 1, one)) - stage("v", index),
        sp.expand(derivative(polynomial, 2, one)) - stage("a", index),
    )


def backward_difference(older: Sequence[Datum], newest: sp.Expr) -> sp.Expr:
    """Return the rate at ``t + h`` of the polynomial through ``older`` and ``newest``, which is there."""
    one = sp.Integer(1)
    return sp.expand(derivative(interpolant([*older, Datum(one, newest)]), 1, one))
