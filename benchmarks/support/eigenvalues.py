"""Eigenvalues of a derived amplification matrix to 50 digits, one frequency at a time."""

from __future__ import annotations

import mpmath
import sympy as sp

from tmm_gen.derive.integrators.amplification import LAMBDA, OMEGA, Amplification
from tmm_gen.derive.integrators.parameters import Number, exact
from tmm_gen.derive.integrators.stability import at_damping

_DIGITS = 50


def spectral_radius(linear: Amplification, omega: Number, zeta: Number = 0) -> float:
    """Return the largest modulus of the eigenvalues at ``Omega = omega``."""
    here = sp.Poly(at_damping(linear, zeta).as_expr().subs(OMEGA, exact(omega)), LAMBDA, extension=True)
    radii = [0.0]
    with mpmath.workdps(_DIGITS):
        for factor, _ in here.sqf_list()[1]:
            coefficients = [mpmath.mpmathify(c.evalf(_DIGITS + 10)) for c in factor.all_coeffs()]
            radii += [abs(root) for root in mpmath.polyroots(coefficients, maxsteps=200, extraprec=400)]
    return float(max(radii))
