from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st
from support.linear import linear_of

from tmm_gen.derive.integrators.amplification import LAMBDA, OMEGA, ZETA, Amplification, amplification
from tmm_gen.derive.integrators.declaration import KINDS, Integrator
from tmm_gen.derive.integrators.registry import integrator, names

ALL = tuple(integrator(name) for name in names())


def numbers(linear: Amplification, omega: float, zeta: float) -> np.ndarray:
    at = linear.expression.subs({OMEGA: sp.Rational(omega), ZETA: sp.Rational(zeta)})
    return np.array(at.evalf(30).tolist(), dtype=float)


@pytest.mark.parametrize("method", ALL, ids=lambda m: m.name)
def test_the_matrix_repeats_a_simulation(
    method: Integrator, simulate: Callable[..., np.ndarray], oscillator: type
) -> None:
    """Steps after the start-up, against the declared relations solved as they stand."""
    step, frequency, zeta = 0.25, 3.0, 0.125
    linear = linear_of(method.name)
    matrix = numbers(linear, step * frequency, zeta)
    motion = simulate(method, oscillator(frequency=frequency, zeta=zeta), step, 12)
    scale = {kind: step**k for k, kind in enumerate(KINDS)}

    def vector(k: int) -> np.ndarray:
        return np.array([motion[KINDS.index(p.kind), k - p.lag] * scale[p.kind] for p in linear.history])

    for k in range(3, 11):
        np.testing.assert_allclose(matrix @ vector(k), vector(k + 1), rtol=1e-11, atol=1e-13)


@pytest.mark.parametrize("method", ALL, ids=lambda m: m.name)
def test_a_load_enters_as_in_a_simulation(
    method: Integrator, simulate: Callable[..., np.ndarray], oscillator: type
) -> None:
    step, frequency, zeta = 0.25, 2.0, 0.125
    linear = linear_of(method.name)
    matrix = numbers(linear, step * frequency, zeta)
    forcing = linear.forcing.to_Matrix().subs(linear.roots)
    forcing = np.array(forcing.subs({OMEGA: step * frequency, ZETA: zeta}).evalf(30).tolist(), dtype=float)
    loaded = oscillator(frequency=frequency, zeta=zeta, amplitude=5.0)
    motion = simulate(method, loaded, step, 12)
    scale = {kind: step**k for k, kind in enumerate(KINDS)}

    def vector(k: int) -> np.ndarray:
        return np.array([motion[KINDS.index(p.kind), k - p.lag] * scale[p.kind] for p in linear.history])

    for k in range(3, 11):
        loads = np.array([step**2 * loaded.load((k + float(c)) * step) for c in linear.instants])
        np.testing.assert_allclose(
            matrix @ vector(k) + forcing @ loads, vector(k + 1), rtol=1e-11, atol=1e-12
        )


@pytest.mark.parametrize("method", ALL, ids=lambda m: m.name)
def test_characteristic_polynomial_vanishes_at_eigenvalues(method: Integrator) -> None:
    linear = linear_of(method.name)
    omega, zeta = 0.75, 0.125
    at = sp.Poly(linear.characteristic.as_expr().subs({OMEGA: omega, ZETA: zeta}), LAMBDA)
    eigenvalues = np.linalg.eigvals(numbers(linear, omega, zeta))
    values = np.polyval([complex(c) for c in at.all_coeffs()], eigenvalues)
    assert np.max(np.abs(values)) < 1e-9 * max(abs(complex(c)) for c in at.all_coeffs())


@pytest.mark.parametrize("name", ["newmark", "bathe", "park", "sdirk2", "sdirk4"])
@settings(max_examples=8)
@given(omega=st.fractions("1/10", 5, max_denominator=20))
def test_steady_response_solves_the_step(name: str, omega: float) -> None:
    """(LAMBDA - matrix) x = forcing for a load that grows by LAMBDA a step, stage by stage."""
    linear = linear_of(name)
    at = {OMEGA: sp.Rational(omega), ZETA: sp.Rational(1, 8), LAMBDA: sp.Rational(5, 4)}
    denominator, numerators = linear.response
    size, stages = len(linear.history), len(linear.instants)
    value = np.array([[float(n.as_expr().subs(at)) for n in row] for row in numerators])
    value /= float(denominator.as_expr().subs(at))
    forcing = linear.forcing.to_Matrix().subs(linear.roots).subs(at)
    forcing = np.array(forcing.evalf(30).tolist(), dtype=float).reshape(size, stages)
    left = (1.25 * np.eye(size) - numbers(linear, at[OMEGA], at[ZETA])) @ value
    np.testing.assert_allclose(left, forcing, rtol=1e-9, atol=1e-11)


def test_symbolic_parameters_stay_symbols() -> None:
    beta, gamma = sp.symbols("beta gamma", positive=True)
    general = amplification(integrator("newmark", beta=beta, gamma=gamma).main).characteristic.as_expr()
    special = amplification(integrator("newmark", beta=1 / 6).main).characteristic.as_expr()
    assert sp.cancel(general.subs({beta: sp.S.One / 6, gamma: sp.S.Half}) / special).is_number


def test_undamped_trapezoidal_rule_is_the_cayley_transform() -> None:
    """Newmark 1/4 maps exp(i Omega) to (1 + i Omega/2)/(1 - i Omega/2)."""
    polynomial = linear_of("newmark").characteristic.as_expr().subs(ZETA, 0)
    cayley = (1 + sp.I * OMEGA / 2) / (1 - sp.I * OMEGA / 2)
    assert sp.simplify(polynomial.subs(LAMBDA, cayley)) == 0
