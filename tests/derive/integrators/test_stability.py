from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st
from support.eigenvalues import spectral_radius
from support.linear import linear_of

from tmm_gen.derive.integrators.amplification import LAMBDA, OMEGA, ZETA, Amplification, amplification
from tmm_gen.derive.integrators.declaration import Integrator
from tmm_gen.derive.integrators.parameters import exact
from tmm_gen.derive.integrators.registry import integrator, names
from tmm_gen.derive.integrators.stability import radius_at_infinity, stability_limit
from tmm_gen.errors import UserError

NAMES = names()
UNCONDITIONAL = sorted({*NAMES} - {"mixed", "zhou", "zhai"})


def linear(name: str, **parameters: float | sp.Expr) -> Amplification:
    return amplification(integrator(name, **parameters).main)


def _flips(method: Amplification) -> list[sp.Expr]:
    """Return the ``Omega`` at which an eigenvalue is -1, with ``ZETA`` and parameters left as symbols."""
    return [
        sp.simplify(w) for w in sp.solve(sp.factor(method.characteristic.as_expr().subs(LAMBDA, -1)), OMEGA)
    ]


@pytest.mark.parametrize("zeta", [0, 0.05, 0.7])
@pytest.mark.parametrize("name", UNCONDITIONAL)
def test_unconditionally_stable(name: str, zeta: float) -> None:
    assert stability_limit(linear_of(name), zeta) == sp.oo


@pytest.mark.parametrize("name", UNCONDITIONAL)
@settings(max_examples=30)
@given(power=st.floats(-2, 4), zeta=st.floats(0, 2))
def test_unconditionally_stable_at_random_steps(name: str, power: float, zeta: float) -> None:
    assert spectral_radius(linear_of(name), 10**power, zeta) <= 1 + 1e-12


def test_newmark_closed_forms() -> None:
    """Omega = 1/sqrt(1/4 - beta) without damping; Hughes (1987), chapter 9, with gamma and damping."""
    beta, gamma = sp.symbols("beta gamma", positive=True)
    roots = _flips(linear("newmark", beta=beta))
    assert any(sp.simplify(root**2 - 1 / (sp.S.One / 4 - beta)) == 0 for root in roots)
    excess = gamma - sp.S.Half
    hughes = (ZETA * excess + sp.sqrt(gamma / 2 - beta + ZETA**2 * excess**2)) / (gamma / 2 - beta)
    general = _flips(linear("newmark", beta=beta, gamma=gamma))
    assert any(sp.simplify(root - hughes) == 0 for root in general)


@pytest.mark.parametrize("beta", [0, 1 / 12, 1 / 8, 1 / 6, 0.24])
@pytest.mark.parametrize("zeta", [0, 0.05, 0.5])
def test_newmark_limits(beta: float, zeta: float) -> None:
    """With gamma = 1/2 physical damping does not change the limit."""
    limit = stability_limit(linear("newmark", beta=beta), zeta)
    assert float(limit) == pytest.approx(1 / math.sqrt(0.25 - beta), rel=1e-12)
    if beta == 1 / 6 and zeta == 0:
        assert limit == 2 * sp.sqrt(3)


@pytest.mark.parametrize("zeta", [0, 0.1])
@pytest.mark.parametrize(("beta", "gamma"), [(0, 0.6), (0.1, 0.7), (0.25, 0.6)])
def test_dissipative_newmark_limits(beta: float, gamma: float, zeta: float) -> None:
    excess = gamma - 0.5
    expected = (zeta * excess + math.sqrt(gamma / 2 - beta + zeta**2 * excess**2)) / (gamma / 2 - beta)
    limit = stability_limit(linear("newmark", beta=beta, gamma=gamma), zeta)
    assert float(limit) == pytest.approx(expected, rel=1e-12)


def test_newmark_with_too_little_gamma_grows_at_any_step() -> None:
    assert stability_limit(linear("newmark", gamma=0.49)) == 0
    assert stability_limit(linear("newmark", beta=0.25, gamma=0.5)) == sp.oo


def test_wilson_is_unconditionally_stable_from_theta_1_366() -> None:
    """The threshold is (1 + sqrt(3))/2 = 1.36603: there the spectral radius at infinity is 1."""
    threshold = (1 + sp.sqrt(3)) / 2
    for theta in (1.3661, 1.4, 2, threshold):
        assert stability_limit(linear("wilson", theta=theta)) == sp.oo
    for theta in (1.3, 1.366):
        assert stability_limit(linear("wilson", theta=theta)).is_finite
    assert float(radius_at_infinity(linear("wilson", theta=threshold))) == pytest.approx(1, abs=1e-12)
    assert stability_limit(linear("wilson", theta=1)) == 2 * sp.sqrt(3)


def test_the_proposed_method_grows_at_any_step_without_damping() -> None:
    assert stability_limit(linear_of("zhou")) == 0
    assert spectral_radius(linear_of("zhou"), 0.1) > 1
    limits = [float(stability_limit(linear_of("zhou"), zeta)) for zeta in (0.01, 0.05, 0.2)]
    assert 0 < limits[0] < limits[1] < limits[2] < 4
    assert stability_limit(linear("zhou", g2=1)) == sp.sqrt(6)


def test_zhai_undamped_is_the_central_difference_method() -> None:
    assert stability_limit(linear_of("zhai")) == 2
    assert stability_limit(linear_of("zhai"), 0.05) < 2


@pytest.mark.parametrize("zeta", [0.0, 0.05, 0.3])
@pytest.mark.parametrize(
    "method",
    [
        integrator("newmark", beta=0),
        integrator("newmark", beta=1 / 6),
        integrator("newmark", beta=0.1, gamma=0.7),
        integrator("wilson", theta=1.3),
        integrator("zhai"),
        integrator("zhai", psi=0.3, phi=0.4),
        integrator("zhou"),
        integrator("zhou", g1=0, g2=0),
        integrator("mixed"),
        integrator("mixed", delta=0.02),
    ],
    ids=lambda m: "-".join([m.name, *map(str, m.parameters.values())]),
)
def test_limits_against_direct_simulation(
    method: Integrator, zeta: float, simulate: Callable[..., np.ndarray], oscillator: type
) -> None:
    """1 % below the limit motion stays bounded for 3000 steps, 1 % above it does not."""
    limit = float(stability_limit(amplification(method.main), zeta))
    motion = oscillator(frequency=1.0, zeta=zeta)
    above = simulate(method, motion, 1.01 * limit if limit else 0.6, 30000)[0]
    assert np.max(np.abs(above)) > 1e3
    if limit:
        below = simulate(method, motion, 0.99 * limit, 3000)[0]
        assert np.max(np.abs(below)) < 100


@pytest.mark.parametrize("rho", [0, 0.25, 0.5, 0.8, 0.95, 1])
def test_generalized_alpha_has_the_radius_asked_for(rho: float) -> None:
    method = linear("generalized_alpha", rho_inf=rho)
    assert radius_at_infinity(method) == sp.nsimplify(rho, rational=True)
    assert spectral_radius(method, 10**7) == pytest.approx(rho, abs=1e-3)
    assert stability_limit(method) == sp.oo


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("bathe", 0),
        ("houbolt", 0),
        ("park", 0),
        ("sdirk2", 0),
        ("sdirk4", 0),
        ("newmark", 1),
        ("fox_euler", 1),
    ],
)
def test_radius_at_infinity(name: str, expected: int) -> None:
    assert radius_at_infinity(linear_of(name)) == expected
    assert spectral_radius(linear_of(name), 10**9) == pytest.approx(expected, abs=1e-2)


def test_explicit_methods_have_no_radius_at_infinity() -> None:
    assert radius_at_infinity(linear_of("zhai")) == sp.oo
    assert radius_at_infinity(linear("newmark", beta=0)) == sp.oo


@settings(max_examples=15)
@given(rho=st.fractions(0, 1, max_denominator=50), omega=st.floats(0.01, 100))
def test_generalized_alpha_never_grows(rho: float, omega: float) -> None:
    assert spectral_radius(linear("generalized_alpha", rho_inf=rho), omega) <= 1 + 1e-12


@settings(max_examples=10)
@given(gamma=st.fractions(sp.Rational(1, 20), sp.Rational(19, 20), max_denominator=20))
def test_bathe_is_unconditionally_stable_for_any_split(gamma: float) -> None:
    method = linear("bathe", gamma=gamma)
    assert stability_limit(method) == sp.oo
    assert radius_at_infinity(method) == 0


@pytest.mark.parametrize("name", ["houbolt", "sdirk4", "zhou"])
@settings(max_examples=30)
@given(omega=st.floats(0.05, 20), zeta=st.floats(0, 0.9))
def test_radius_equals_that_of_the_matrix(name: str, omega: float, zeta: float) -> None:
    matrix = linear_of(name).expression.subs({OMEGA: exact(omega), ZETA: exact(zeta)}).evalf(30)
    eigenvalues = np.linalg.eigvals(np.array(matrix.tolist(), dtype=float))
    assert spectral_radius(linear_of(name), omega, zeta) == pytest.approx(
        np.max(np.abs(eigenvalues)), rel=1e-6
    )


def test_damping_of_many_digits() -> None:
    """SymPy cannot work exactly with what this damping makes of sdirk2: it is taken with fewer digits then."""
    assert stability_limit(linear_of("sdirk2"), 8.560935915e-11) == sp.oo


@pytest.mark.parametrize("name", NAMES)
def test_absurd_damping_has_a_limit_or_a_sentence(name: str) -> None:
    """Where numbers of a field are longer than SymPy can tell apart, the remedy that is named works."""
    try:
        assert stability_limit(linear_of(name), 9.796933025e38) >= 0
    except UserError as error:
        assert "below 1e6" in str(error)  # noqa: PT017 - a limit is as right
        assert stability_limit(linear_of(name), 9.8765432101234e5) >= 0
