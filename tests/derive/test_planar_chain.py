"""The planar link's law satisfies the textbook equations; its sweep is the derivative of that law."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sp

from tmm_gen.derive import expansions
from tmm_gen.derive import planar_chain as chain
from tmm_gen.derive.elements.planar import CENTER, INERTIA, LENGTH, LINK, MASS
from tmm_gen.derive.torsion_chain import GAINS

RNG = np.random.default_rng(7)
VALUES = {LENGTH: 0.3, MASS: 0.7, INERTIA: 0.02, CENTER: 0.35}


def evaluated(expression: sp.Expr, angle: float, values: dict[sp.Symbol, float]) -> float:
    law = chain.link_law()
    geometry = {
        chain.SINE: np.sin(angle),
        chain.COSINE: np.cos(angle),
        chain.LEVER_SINE: VALUES[LENGTH] * np.sin(angle),
        chain.LEVER_COSINE: VALUES[LENGTH] * np.cos(angle),
        chain.CARRIED_MASS: float(law.carried_mass.subs(VALUES)),
        chain.PIN_INERTIA: float(law.pin_inertia.subs(VALUES)),
    }
    return float(sp.sympify(expression).subs({**VALUES, **geometry, **values}))


def turning(lever: np.ndarray, force: np.ndarray) -> float:
    """The moment of a force in the plane; NumPy's own `cross` wants three components."""
    return float(lever[0] * force[1] - lever[1] * force[0])


def inner_forces(angle: float, rate: float, acceleration: float, a: np.ndarray, f: np.ndarray) -> np.ndarray:
    """Forces at the inner end by Newton and Euler, written here by hand from eqs. 2-3 to 2-9."""
    length, mass, inertia, center = (VALUES[s] for s in (LENGTH, MASS, INERTIA, CENTER))
    along, across = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
    a_center = a + center * length * (acceleration * across - rate**2 * along)
    inner = f[:2] + mass * a_center
    to_inner, to_outer = -center * length * along, (1 - center) * length * along
    # I alpha = M_in - M_out + r_in x F_in - r_out x F_out
    moment = inertia * acceleration + f[2] - turning(to_inner, inner) + turning(to_outer, f[:2])
    return np.array([*inner, moment])


def law_forces(angle: float, rate: float, acceleration: float, a: np.ndarray, f: np.ndarray) -> np.ndarray:
    law = chain.link_law()
    values = {
        chain.RATE: rate,
        chain.ACCELERATION: acceleration,
        chain.A_X: a[0],
        chain.A_Y: a[1],
        chain.F_X: f[0],
        chain.F_Y: f[1],
        chain.TORQUE: f[2],
    }
    values[chain.OUTER_A_X] = evaluated(law.outer_x, angle, values)
    values[chain.OUTER_A_Y] = evaluated(law.outer_y, angle, values)
    values[chain.LOAD_X] = evaluated(law.load_x, angle, values)
    values[chain.LOAD_Y] = evaluated(law.load_y, angle, values)
    return np.array([evaluated(e, angle, values) for e in (law.force_x, law.force_y, law.torque)])


@pytest.mark.filterwarnings("ignore:Arrays of 2-dimensional vectors are deprecated")
def test_law_is_newton_and_euler() -> None:
    for _ in range(5):
        angle, rate, acceleration = RNG.normal(size=3)
        a, f = RNG.normal(size=2), RNG.normal(size=3)
        np.testing.assert_allclose(
            law_forces(angle, rate, acceleration, a, f),
            inner_forces(angle, rate, acceleration, a, f),
            rtol=1e-12,
        )


def test_every_declared_equation_of_the_link_is_used() -> None:
    assert len(LINK.equations) == len(LINK.outboard.motions) + len(LINK.outboard.forces)


def test_sweep_is_the_derivative_of_the_law() -> None:
    """Carry f = S k + e over a link by the sweep, and by finite differences of the exact law."""
    gains = {"q": 0.04, "v": 0.3, "a": 1.0}
    angle, rate, acceleration = 0.7, -1.1, 2.3
    a = np.array([0.4, -0.9])
    impedance, bias = RNG.normal(size=(3, 3)), RNG.normal(size=3)
    law, sweep = chain.link_law(), chain.link_sweep()

    def outer_acceleration(k: np.ndarray) -> np.ndarray:
        th, om, al = angle + gains["q"] * k[2], rate + gains["v"] * k[2], acceleration + gains["a"] * k[2]
        at = {chain.RATE: om, chain.ACCELERATION: al, chain.A_X: a[0] + k[0], chain.A_Y: a[1] + k[1]}
        return np.array([evaluated(law.outer_x, th, at), evaluated(law.outer_y, th, at)])

    def inner(k: np.ndarray) -> np.ndarray:
        outer = np.array([*(outer_acceleration(k) - outer_acceleration(np.zeros(3))), k[2]])
        th, om, al = angle + gains["q"] * k[2], rate + gains["v"] * k[2], acceleration + gains["a"] * k[2]
        return law_forces(th, om, al, a + k[:2], impedance @ outer + bias)

    eps = 1e-6
    slopes = np.column_stack([(inner(eps * e) - inner(-eps * e)) / (2 * eps) for e in np.eye(3)])
    values: dict[sp.Symbol, float] = {GAINS[k]: v for k, v in gains.items()}
    values |= {chain.RATE: rate, chain.ACCELERATION: acceleration, chain.A_X: a[0], chain.A_Y: a[1]}
    values |= {chain.S[i, j]: impedance[i, j] for i in range(3) for j in range(3)}
    values |= {chain.E[i]: bias[i] for i in range(3)}
    at_bias = {chain.F_X: chain.E[0], chain.F_Y: chain.E[1], chain.TORQUE: chain.E[2]}
    for name, expression in (
        (chain.TANGENTIAL, sweep.tangential),
        (chain.TURNING, sweep.turning),
        (chain.GAIN_X, sweep.gain_x),
        (chain.GAIN_Y, sweep.gain_y),
        (chain.OUTER_A_X, law.outer_x),
        (chain.OUTER_A_Y, law.outer_y),
        (chain.LOAD_X, law.load_x.subs(at_bias)),
        (chain.LOAD_Y, law.load_y.subs(at_bias)),
    ):
        values[name] = evaluated(expression, angle, values)
    values |= {chain.OWN_X: values[chain.GAIN_X], chain.OWN_Y: values[chain.GAIN_Y]}
    for name, expression in zip(chain.OUTER_COLUMN, sweep.outer, strict=True):
        values[name] = evaluated(expression, angle, values)
    swept = np.array([[evaluated(sweep.impedance[i, j], angle, values) for j in range(3)] for i in range(3)])
    np.testing.assert_allclose(swept, slopes, rtol=1e-7, atol=1e-8)
    carried = np.array([evaluated(e, angle, values) for e in sweep.bias])
    np.testing.assert_allclose(carried, inner(np.zeros(3)), rtol=1e-12)


def test_predicted_sines_are_of_second_order() -> None:
    """Eqs. 2-14 and 2-15: halving the span divides the error by eight."""
    values = {expansions.ANGLE: 0.6, expansions.RATE: 1.3, expansions.ACCELERATION: 0.8}
    sine, cosine = expansions.predicted_trigonometry()
    for predicted, exact in ((sine, np.sin), (cosine, np.cos)):
        errors = []
        for span in (0.02, 0.01):
            angle = 0.6 + 1.3 * span + 0.4 * span**2
            errors.append(abs(float(predicted.subs({**values, expansions.SPAN: span})) - exact(angle)))
        assert 2.8 < np.log2(errors[0] / errors[1]) < 3.2


def test_square_of_rate_is_that_of_the_thesis() -> None:
    """Eq. 2-17, from the product rule 2-16."""
    old, acceleration, span, new = (
        expansions.RATE,
        expansions.ACCELERATION,
        expansions.SPAN,
        expansions.NEW_RATE,
    )
    assert sp.expand(expansions.square_of_rate() - (2 * old * new - old**2 + acceleration**2 * span**2)) == 0
