"""Inputs as a cubic in each step, as near to them as can be."""

from __future__ import annotations

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from tmm_gen.inputs.signals import Signal

Array = NDArray[np.float64]

DEGREE = 3
_NODES, _WEIGHTS = legendre.leggauss(DEGREE + 1)


def projected(signal: Signal, h: float, first: int, count: int) -> Array:
    """Return a cubic for each step that is as near to an input as can be, coefficients of ``(t / h)^p``, (count, 4).

    Its mean over the step is the input's even where that has kinks within.
    """
    begin = h * (first + np.arange(count))
    values = np.asarray(signal.at(begin[:, None] + h * 0.5 * (1.0 + _NODES)), float)
    series = np.stack(
        [
            (2 * p + 1) / 2.0 * values @ (_WEIGHTS * legendre.legval(_NODES, np.eye(DEGREE + 1)[p]))
            for p in range(DEGREE + 1)
        ],
        axis=1,
    )
    knots = signal.knots[(signal.knots > begin[0]) & (signal.knots < begin[-1] + h)]
    for index in np.unique((knots / h).astype(int) - first):
        if 0 <= index < count:
            inside = knots[(knots > begin[index]) & (knots < begin[index] + h)]
            series[index] = _piecewise(signal, begin[index], h, inside)
    return series @ _MONOMIALS


def _piecewise(signal: Signal, begin: float, h: float, knots: Array) -> Array:
    """Return the Legendre series of an input over a step with kinks."""
    edges = np.concatenate([[0.0], (knots - begin) / h, [1.0]])
    half = 0.5 * np.diff(edges)[:, None]
    places = edges[:-1, None] + half * (1.0 + _NODES)
    values = np.asarray(signal.at(begin + h * places), float)
    basis = legendre.legvander(2.0 * places - 1.0, DEGREE)
    return np.asarray(
        (2 * np.arange(DEGREE + 1) + 1) * np.einsum("kn,kn,knp->p", half * _WEIGHTS, values, basis)
    )


def _monomials() -> Array:
    """Return the rows that take Legendre series on [-1, 1] to powers of ``(x + 1) / 2``."""
    rows = np.zeros((DEGREE + 1, DEGREE + 1))
    for p in range(DEGREE + 1):
        plain = np.polynomial.Polynomial(legendre.leg2poly(np.eye(DEGREE + 1)[p]))
        moved = plain(np.polynomial.Polynomial([-1.0, 2.0])).coef
        rows[p, : len(moved)] = moved
    return rows


_MONOMIALS = _monomials()
