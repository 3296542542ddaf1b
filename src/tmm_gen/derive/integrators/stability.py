"""Spectral radius and the exact limit of stability, from the characteristic polynomial.

Eigenvalues leave the unit circle only where the polynomial has a root at 1, at -1, a pair on the circle, or
where roots on the circle meet. Each of these is an algebraic condition on ``Omega``: between its positive
real roots nothing changes, and one sample decides.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

import mpmath
import sympy as sp
from sympy.polys.matrices import DomainMatrix
from sympy.polys.polyerrors import CoercionFailed

from tmm_gen.derive.integrators.amplification import LAMBDA, OMEGA, ZETA, Amplification
from tmm_gen.derive.integrators.parameters import Number, exact
from tmm_gen.errors import UserError

_DIGITS = 50
_FEWER = 5
"""Digits of a damping ratio that limits in print can tell of."""
_ON_CIRCLE = mpmath.mpf(10) ** -30
"""Eigenvalues that exceed 1 by less are on the circle: rounding is at 1e-50, a true excess far above."""


@lru_cache(
    maxsize=1024, typed=True
)  # asked for every arm that has no damping, and twice for its fastest mode
def stability_limit(linear: Amplification, zeta: Number = 0) -> sp.Expr:
    """Return the largest ``Omega`` below which no motion grows, at a physical damping ratio.

    Returns
    -------
    sympy.Expr
        Exact; infinity if there is no limit, zero if motion grows however small the step.

    Raises
    ------
    UserError
        If the damping ratio is so large that its numbers cannot be told apart in an exact field.
    """
    fewer = float(f"{float(zeta):.{_FEWER}g}")
    for ratio in (zeta, fewer):
        try:
            return _limit(at_damping(linear, ratio))
        except (ValueError, CoercionFailed):
            # SymPy's table of prime factors refuses what it has left of some very large integers, and its search for
            # a number of a field finds none where integers are longer than its digits
            continue
    raise UserError(
        f"no exact limit can be derived at a damping ratio of {float(zeta):.3g}. Lower the damping, or stiffness and "
        "damping time, until it is below 1e6."
    )


def _limit(polynomial: sp.Poly) -> sp.Expr:
    boundaries = sorted(set(_boundaries(polynomial)), key=lambda root: root.evalf(_DIGITS))
    previous = sp.Integer(0)
    for boundary in [*boundaries, sp.oo]:
        if not _stable(polynomial, _between(previous, boundary)):
            return previous
        previous = boundary
    return sp.oo


def radius_at_infinity(linear: Amplification, zeta: Number = 0) -> sp.Expr:
    """Return the limit of the spectral radius for ``Omega`` to infinity; infinity where eigenvalues run away.

    Exact where the eigenvalues there are roots of polynomials of degree two at most.
    """
    polynomial = at_damping(linear, zeta)
    degree = polynomial.degree(OMEGA)
    leading = sp.Poly(polynomial.as_expr().coeff(OMEGA, degree), LAMBDA, extension=True)
    if leading.degree() < polynomial.degree(LAMBDA):
        return sp.oo
    radii: list[sp.Expr] = [sp.Integer(0)]
    for factor, _ in leading.factor_list()[1]:
        if factor.degree() <= 2:
            radii += [sp.radsimp(sp.Abs(root)) for root in sp.roots(factor)]
        else:
            radii += [sp.Float(abs(root), 15) for root, _ in _roots(factor)]
    return max(radii, key=lambda radius: radius.evalf(_DIGITS))


def at_damping(linear: Amplification, zeta: Number) -> sp.Poly:
    """Return the characteristic polynomial at a damping ratio, without its zero eigenvalues."""
    expression = linear.characteristic.as_expr().subs(ZETA, exact(zeta))
    polynomial = sp.Poly(expression, LAMBDA, OMEGA, extension=True)
    lowest = min(power for power, _ in polynomial.monoms())
    return polynomial.exquo(sp.Poly(LAMBDA**lowest, LAMBDA, OMEGA, domain=polynomial.domain))


def reciprocal_part(polynomial: sp.Poly) -> sp.Poly:
    """Return the factor whose roots come in pairs ``root, 1/root``: it holds all that stay on the circle."""
    degree = polynomial.degree(LAMBDA)
    mirrored = sp.Poly(
        sp.expand(LAMBDA**degree * polynomial.as_expr().subs(LAMBDA, 1 / LAMBDA)),
        LAMBDA,
        OMEGA,
        domain=polynomial.domain,
    )
    return polynomial.gcd(mirrored)


def _boundaries(polynomial: sp.Poly) -> Iterator[sp.Expr]:
    """Yield the positive ``Omega`` at which stability can change."""
    on_circle = reciprocal_part(polynomial)
    rest = polynomial.exquo(on_circle)
    conditions = [polynomial.as_expr().subs(LAMBDA, 1), polynomial.as_expr().subs(LAMBDA, -1)]
    degree = polynomial.degree(LAMBDA)
    conditions.append(sum(c * OMEGA**power for (k, power), c in polynomial.terms() if k == degree))
    if on_circle.degree(LAMBDA) > 1:
        for factor, _ in on_circle.sqf_list()[1]:
            if factor.degree(LAMBDA) > 1:
                conditions.append(sp.Poly(factor.as_expr(), LAMBDA).discriminant())
    if rest.degree(LAMBDA) > 1:
        conditions.append(_pair_condition(rest))
    for condition in conditions:
        yield from _positive_roots(condition)


def _pair_condition(polynomial: sp.Poly) -> sp.Expr:
    """Return the last but one Hurwitz determinant after ``LAMBDA = (1 + z)/(1 - z)``.

    It vanishes where a pair of eigenvalues is on the circle.
    """
    numbers, degree = polynomial.domain, polynomial.degree(LAMBDA)
    ring, z, omega = sp.ring("z, Omega", numbers)
    mapped = ring.zero
    for (k, power), c in polynomial.rep.to_dict().items():
        mapped += c * omega**power * (1 + z) ** k * (1 - z) ** (degree - k)
    over_omega = numbers[OMEGA]
    coefficients = [over_omega.zero] * (degree + 1)
    for (k, power), c in mapped.terms():
        coefficients[k] += over_omega.ring.from_dict({(power,): c})
    size = degree - 1
    hurwitz = [[over_omega.zero] * size for _ in range(size)]
    for i in range(size):
        for j in range(size):
            if 0 <= (k := degree - 1 - 2 * j + i) <= degree:
                hurwitz[i][j] = coefficients[k]
    return over_omega.to_sympy(DomainMatrix(hurwitz, (size, size), over_omega).charpoly()[-1])


def _positive_roots(condition: sp.Expr) -> Iterator[sp.Expr]:
    """Yield the positive real roots of a polynomial in ``OMEGA``, in radicals where the degree allows."""
    polynomial = sp.Poly(condition, OMEGA, extension=True)
    if polynomial.degree() < 1:
        return
    if not polynomial.domain.is_ZZ and not polynomial.domain.is_QQ:
        # The product over conjugates has rational coefficients; its further roots are harmless candidates.
        polynomial = polynomial.norm()
    for factor, _ in polynomial.factor_list()[1]:
        even = all(power % 2 == 0 for (power,) in factor.monoms())
        if even:
            squared = sp.Poly.from_dict({(p // 2,): c for (p,), c in factor.terms()}, OMEGA)
            yield from (sp.sqrt(root) for root in squared.real_roots() if root.is_positive)
        else:
            yield from (root for root in factor.real_roots() if root.is_positive)


def _between(low: sp.Expr, high: sp.Expr) -> sp.Rational:
    """Return a rational number strictly between two boundaries."""
    if high == sp.oo:
        return sp.Rational(sp.ceiling(low.evalf(_DIGITS)) + 1)
    middle = ((low + high) / 2).evalf(_DIGITS)
    half_gap = ((high - low) / 2).evalf(_DIGITS)
    return sp.Rational(middle).limit_denominator(int(10 / half_gap) + 1000)


def _stable(polynomial: sp.Poly, omega: sp.Rational) -> bool:
    """Return whether no eigenvalue is outside the circle and none on it is multiple."""
    here = sp.Poly(polynomial.as_expr().subs(OMEGA, omega), LAMBDA, extension=True)
    for root, multiplicity in _roots(here):
        if abs(root) > 1 + _ON_CIRCLE or (multiplicity > 1 and abs(root) > 1 - _ON_CIRCLE):
            return False
    return True


def _roots(polynomial: sp.Poly) -> list[tuple[mpmath.mpc, int]]:
    """Return all roots with their multiplicities, to 50 digits."""
    found = []
    with mpmath.workdps(_DIGITS):
        for factor, multiplicity in polynomial.sqf_list()[1]:
            coefficients = [mpmath.mpmathify(c.evalf(_DIGITS + 10)) for c in factor.all_coeffs()]
            for root in mpmath.polyroots(coefficients, maxsteps=200, extraprec=400):
                found.append((root, multiplicity))
    return found
