"""Period error and numerical damping of the principal eigenvalue, as numbers and as leading terms.

The principal eigenvalue is ``exp((-xi + i) w' h)`` to first order in the numerical damping ratio ``xi``: the
period is ``2 pi / w'``, to be compared with the exact one.
"""

from __future__ import annotations

import math

import mpmath
import sympy as sp
from sympy.polys.ring_series import rs_exp, rs_mul, rs_series_inversion, rs_trunc
from sympy.polys.rings import ring

from tmm_gen.derive.integrators.amplification import LAMBDA, OMEGA, Amplification
from tmm_gen.derive.integrators.stability import at_damping, reciprocal_part

_TERMS = 8
"""Powers of ``Omega`` to which the series is developed: enough for the damping of methods up to order 6."""

_DIGITS = 30
_STRIDE = 0.1
_REAL = 1e-12


def leading_terms(linear: Amplification) -> tuple[sp.Expr, sp.Expr]:
    """Return the leading terms in ``Omega`` of relative period error and numerical damping ratio, undamped.

    Returns
    -------
    period_error, numerical_damping : sympy.Expr
        ``coefficient * Omega**power``; the damping is exactly zero where the principal pair stays on
        the circle.
    """
    polynomial = at_damping(linear, 0)
    logarithm = _principal_logarithm(polynomial, list(linear.roots.values()))
    damping = sp.Integer(0) if _stays_on_circle(polynomial) else _leading([-sp.re(c) for c in logarithm])
    return _leading([-sp.im(c) for c in logarithm]), damping


def principal_exponent(linear: Amplification, omega: float, zeta: float = 0.0) -> complex:
    """Return ``log`` of the eigenvalue that approximates ``exp(s Omega)``, followed from small ``Omega``.

    Raises
    ------
    ValueError
        If it is no longer one of a complex pair: there is no period.
    """
    by_power = sp.Poly(at_damping(linear, zeta).as_expr(), LAMBDA).all_coeffs()
    exponent = -zeta + 1j * math.sqrt(1 - zeta**2)
    steps = max(1, math.ceil(omega / _STRIDE))
    with mpmath.workdps(_DIGITS):
        coefficients = sp.lambdify(OMEGA, by_power, "mpmath")
        value = mpmath.mpc(1)
        for k in range(1, steps + 1):
            expected = value * mpmath.exp(exponent * omega / steps)
            here = mpmath.polyroots(coefficients(mpmath.mpf(omega) * k / steps), maxsteps=200, extraprec=200)
            value = min(here, key=lambda root: abs(root - expected))
        if abs(mpmath.im(value)) < _REAL:
            raise ValueError(f"at Omega = {omega:g} the principal eigenvalues are not a complex pair")
        return complex(mpmath.log(value))


def _principal_logarithm(polynomial: sp.Poly, roots: list[sp.Expr]) -> list[sp.Expr]:
    """Return the coefficients of ``log(LAMBDA)/Omega - i`` by powers of ``Omega``, undamped.

    Newton's iteration on the characteristic polynomial as a power series; its derivative there starts with
    ``Omega``, because two eigenvalues meet at 1.
    """
    field = sp.QQ.algebraic_field(sp.I, *roots)
    series, omega = ring(OMEGA, field)
    by_power = {
        k: series.from_dict({p: field.from_sympy(c) for p, c in sp.Poly(part, OMEGA).terms()})
        for (k,), part in sp.Poly(polynomial.as_expr(), LAMBDA).terms()
    }
    logarithm = omega * field.from_sympy(sp.I)
    known = 2
    while known < _TERMS + 2:
        known = min(2 * known, _TERMS + 2)
        exponential = rs_exp(logarithm, omega, known + 1)
        value, slope, power = series.zero, series.zero, series.one
        for k in range(max(by_power) + 1):
            term = rs_mul(by_power.get(k, series.zero), power, omega, known + 1)
            value, slope = value + term, slope + k * term
            power = rs_mul(power, exponential, omega, known + 1)
        inverse = rs_series_inversion(slope.quo(omega), omega, known)
        logarithm = rs_trunc(logarithm - rs_mul(value.quo(omega), inverse, omega, known), omega, known)
    coefficients = [field.to_sympy(logarithm.coeff(omega**k)) for k in range(1, _TERMS + 2)]
    return [coefficients[0] - sp.I, *coefficients[1:]]


def _leading(coefficients: list[sp.Expr]) -> sp.Expr:
    """Return the first term that does not vanish."""
    for power, coefficient in enumerate(coefficients):
        if (exact := sp.expand(coefficient)) != 0:
            return exact * OMEGA**power
    raise ArithmeticError(f"no term up to Omega^{len(coefficients) - 1}")


def _stays_on_circle(polynomial: sp.Poly) -> bool:
    """Return whether the undamped principal pair has modulus 1 for small ``Omega``, exactly."""
    rest = polynomial.exquo(reciprocal_part(polynomial))
    return bool(rest.as_expr().subs({LAMBDA: 1, OMEGA: 0}) != 0)
