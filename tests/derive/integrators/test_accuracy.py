from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st
from support.linear import linear_of
from support.principal_eigenvalue import numerical_damping, period_error

from tmm_gen.derive.integrators.accuracy import leading_terms, principal_exponent
from tmm_gen.derive.integrators.amplification import OMEGA, amplification
from tmm_gen.derive.integrators.declaration import Integrator
from tmm_gen.derive.integrators.order import free_order
from tmm_gen.derive.integrators.registry import all_integrators, integrator

ALL = all_integrators()


def test_trapezoidal_rule_has_the_known_closed_form() -> None:
    """Its frequency is 2 arctan(Omega/2)/h."""
    terms = leading_terms(linear_of("newmark"))
    assert terms == (OMEGA**2 / 12, 0)
    for omega in (0.1, 1.0, 3.0):
        assert period_error(linear_of("newmark"), omega) == pytest.approx(
            omega / (2 * math.atan(omega / 2)) - 1
        )
        assert numerical_damping(linear_of("newmark"), omega) == pytest.approx(0, abs=1e-14)


def test_newmark_period_error_depends_on_beta() -> None:
    """(beta - 1/12)/2 Omega^2: beta = 1/12 (Fox and Goodwin) cancels it."""
    for beta in (0, 1 / 8, 1 / 6, 0.25):
        term, damping = leading_terms(amplification(integrator("newmark", beta=beta).main))
        assert damping == 0
        assert float(term / OMEGA**2) == pytest.approx((beta - 1 / 12) / 2)
    assert leading_terms(amplification(integrator("newmark", beta=1 / 12).main))[0] == -(OMEGA**4) / 480


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("houbolt", (11 * OMEGA**2 / 24, OMEGA**3 / 2)),
        ("park", (OMEGA**2 / 6, OMEGA**5 / 12)),
        ("bathe", (OMEGA**2 / 24, OMEGA**3 / 288)),
        ("zhou", (OMEGA**4 / 120, -(OMEGA**3) / 48)),
    ],
)
def test_leading_terms(name: str, expected: tuple[sp.Expr, sp.Expr]) -> None:
    assert leading_terms(linear_of(name)) == expected


@pytest.mark.parametrize("method", ALL, ids=lambda m: m.name)
def test_leading_terms_are_approached_by_the_numbers(method: Integrator) -> None:
    linear = linear_of(method.name)
    small = 1e-2
    for term, measured in zip(
        leading_terms(linear), (period_error(linear, small), numerical_damping(linear, small)), strict=True
    ):
        expected = float(term.subs(OMEGA, sp.Rational(small)))
        assert measured == pytest.approx(expected, rel=1e-2, abs=1e-15)


@pytest.mark.parametrize("method", ALL, ids=lambda m: m.name)
def test_the_lowest_power_is_the_order(method: Integrator) -> None:
    """The eigenvalue's error, period and damping together, is of the order of free motion."""
    terms = [sp.Poly(term, OMEGA).degree() for term in leading_terms(linear_of(method.name)) if term != 0]
    # damping hides one order higher than frequency for even orders, frequency for odd ones
    assert min(terms) == free_order(linear_of(method.name))


@pytest.mark.parametrize("zeta", [0.0, 0.1])
@pytest.mark.parametrize("method", ALL, ids=lambda m: m.name)
def test_numbers_against_a_simulation(
    method: Integrator, zeta: float, simulate: Callable[..., np.ndarray], oscillator: type
) -> None:
    """Prony's method on the tail of a simulated free motion: q is a sum of exponentials of each step."""
    omega, skip = 0.4, 40
    q = simulate(method, oscillator(zeta=zeta), omega, skip + 60)[0][skip:]
    # spurious motions have died out: a recursion over two steps is left
    rows = np.column_stack([q[1:-1], q[:-2]])
    (one, two), *_ = np.linalg.lstsq(rows, q[2:], rcond=None)
    root = max(np.roots([1, -one, -two]), key=lambda r: r.imag)
    exponent = np.log(root)
    assert exponent == pytest.approx(principal_exponent(linear_of(method.name), omega, zeta), rel=1e-8)
    assert period_error(linear_of(method.name), omega, zeta) == pytest.approx(
        omega * math.sqrt(1 - zeta**2) / exponent.imag - 1, rel=1e-6
    )
    assert numerical_damping(linear_of(method.name), omega, zeta) == pytest.approx(
        -exponent.real / abs(exponent) - zeta, rel=1e-6, abs=1e-10
    )


@settings(max_examples=8)
@given(rho=st.fractions(0, 1, max_denominator=20))
def test_generalized_alpha_is_dissipative_except_at_one(rho: sp.Rational) -> None:
    _, damping = leading_terms(amplification(integrator("generalized_alpha", rho_inf=rho).main))
    assert (damping == 0) == (rho == 1)
    assert damping == 0 or (damping / OMEGA**3).is_positive


def test_no_period_where_the_pair_has_become_real() -> None:
    with pytest.raises(ValueError, match="not a complex pair"):
        period_error(amplification(integrator("newmark", beta=0).main), 2.5)
