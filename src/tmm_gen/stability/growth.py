"""How much a motion grows in one step of an integrator: numbers from its derived amplification matrix.

A mode ``q'' + d q' + k q = 0`` is given by ``k h^2`` and ``d h``, not by frequency and damping ratio: so rigid-body
motions, free dampers and arms that fall over are modes like any other.
"""

from __future__ import annotations

from functools import cached_property
from typing import Any

import mpmath
import numpy as np
import sympy as sp
from numpy.typing import ArrayLike, NDArray

from tmm_gen.derive.integrators.amplification import LAMBDA, OMEGA, ZETA, Amplification, amplification
from tmm_gen.derive.integrators.declaration import Integrator

Array = NDArray[np.float64]

_STIFFNESS, _DAMPING = sp.Symbol("K", positive=True), sp.Symbol("D", nonnegative=True)
_DIGITS = 60
ON_CIRCLE = 1e-20
"""Eigenvalues of many digits that exceed 1 by less are on the unit circle."""


class Growth:
    """The spectral radius of one step of an integrator on one mode.

    Parameters
    ----------
    integrator : Integrator
        With its parameters bound to numbers.
    """

    def __init__(self, integrator: Integrator) -> None:
        self.integrator = integrator
        self.linear: Amplification = amplification(integrator.main)

    def matrices(self, stiffness: ArrayLike, damping: ArrayLike) -> Array:
        """Return amplification matrices, in double precision.

        Parameters
        ----------
        stiffness, damping : array_like, shape (...)
            ``k h^2`` and ``d h``.

        Returns
        -------
        array, shape (..., n, n)
            Of the history in units of steps.
        """
        k, d = np.broadcast_arrays(np.asarray(stiffness, float), np.asarray(damping, float))
        entries = self._entries
        size = len(self.linear.history)
        made = np.empty((*k.shape, size, size))
        with np.errstate(all="ignore"):
            for row in range(size):
                for column in range(size):
                    made[..., row, column] = entries[row][column](k, d)
        return made

    def radius(self, stiffness: ArrayLike, damping: ArrayLike) -> Array:
        """Return the spectral radius in double precision, infinite where entries overflow, shape (...)."""
        made = self.matrices(stiffness, damping)
        good = np.all(np.isfinite(made), axis=(-1, -2))
        found = np.abs(np.linalg.eigvals(np.where(good[..., None, None], made, 0.0))).max(axis=-1)
        radius: Array = np.where(good, found, np.inf)
        return radius

    def excess(self, stiffness: float, damping: float) -> float:
        """Return the spectral radius less 1, from many digits; zero where it is on the unit circle."""
        with mpmath.workdps(_DIGITS):
            by_power = self._characteristic(mpmath.mpf(stiffness), mpmath.mpf(damping))
            if not by_power[0]:
                return float("inf")
            roots = mpmath.polyroots(by_power, maxsteps=300, extraprec=600)
            over = max(abs(root) for root in roots) - 1
            return 0.0 if abs(over) < ON_CIRCLE else float(over)

    @cached_property
    def _entries(self) -> list[list[Any]]:
        roots = {symbol: sp.N(value, 17) for symbol, value in self.linear.roots.items()}
        size = len(self.linear.history)
        made = self.linear.matrix.to_Matrix()
        return [
            [
                sp.lambdify((_STIFFNESS, _DAMPING), _by_stiffness(made[row, column]).subs(roots), "numpy")
                for column in range(size)
            ]
            for row in range(size)
        ]

    @cached_property
    def _characteristic(self) -> Any:
        by_power = sp.Poly(self.linear.characteristic.as_expr(), LAMBDA).all_coeffs()
        return sp.lambdify(
            (_STIFFNESS, _DAMPING), [_by_stiffness(coefficient) for coefficient in by_power], "mpmath"
        )


def _by_stiffness(expression: sp.Expr) -> sp.Expr:
    """Write ``Omega^2`` as ``K`` and ``2 zeta Omega`` as ``D``."""
    return sp.cancel(expression.subs(ZETA, _DAMPING / (2 * OMEGA))).subs(OMEGA, sp.sqrt(_STIFFNESS))
