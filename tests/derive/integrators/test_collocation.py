"""Collocation methods follow from their abscissae: tableau, eigenvalues, transformation, predictions."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sp

from tmm_gen.derive.integrators.collocation import collocated, gauss_nodes, radau_nodes
from tmm_gen.derive.integrators.declaration import KINDS, STEP, past, stage
from tmm_gen.derive.integrators.order import order
from tmm_gen.derive.integrators.registry import integrator, names
from tmm_gen.derive.integrators.relations import UnsuitableUnknownError, affine_motion
from tmm_gen.derive.integrators.spectrum import Spectrum

COUPLED = [method for method in map(integrator, names()) if method.main.coupled]
ROOT = sp.sqrt(6)


def numbers(pairs: tuple[tuple[tuple[sp.Rational, sp.Rational], ...], ...]) -> np.ndarray:
    return np.array([[complex(re, im) for re, im in row] for row in pairs])


def test_radau_is_that_of_the_literature() -> None:
    """Hairer & Wanner (1996), table IV.5.6."""
    table = integrator("radau3").tableau
    assert table is not None
    assert list(table.nodes) == [sp.expand((4 - ROOT) / 10), sp.expand((4 + ROOT) / 10), 1]
    expected = [
        [(88 - 7 * ROOT) / 360, (296 - 169 * ROOT) / 1800, (-2 + 3 * ROOT) / 225],
        [(296 + 169 * ROOT) / 1800, (88 + 7 * ROOT) / 360, (-2 - 3 * ROOT) / 225],
        [(16 - ROOT) / 36, (16 + ROOT) / 36, sp.Rational(1, 9)],
    ]
    assert table.matrix == sp.Matrix(expected).applyfunc(sp.expand)
    assert integrator("gauss2").tableau.matrix[0, 1] == sp.Rational(1, 4) - sp.sqrt(3) / 6  # type: ignore[union-attr]


@pytest.mark.parametrize("method", COUPLED, ids=lambda m: m.name)
def test_weights_fall_apart_into_systems(method: object) -> None:
    """``A = T diag(lambda) T^-1`` to rounding, with one of each conjugate pair; rows of ``T^-1`` add up to 1."""
    spectrum = Spectrum(method.main)  # type: ignore[attr-defined]
    values = np.array([complex(re, im) for re, im in spectrum.values])
    into, back = numbers(spectrum.into), numbers(spectrum.back)
    weights = np.array(spectrum.matrix.tolist(), float)
    np.testing.assert_allclose((back * values @ into).real, weights, atol=1e-15)
    np.testing.assert_allclose((back @ into).real, np.eye(len(weights)), atol=2e-15)
    np.testing.assert_allclose(into.sum(axis=1), 1.0, atol=1e-15)
    assert np.all(values.imag >= 0.0)
    assert np.all(values.real > 0.0)  # what pivots of passive arms rest on
    whole = np.concatenate([values, values[values.imag > 0].conj()])
    np.testing.assert_allclose(
        np.sort_complex(whole), np.sort_complex(np.linalg.eigvals(weights)), atol=1e-14
    )


@pytest.mark.parametrize("method", COUPLED, ids=lambda m: m.name)
def test_what_the_polynomial_predicts_is_exact_for_polynomials(method: object) -> None:
    """Through s accelerations: powers below s, ahead by a step, at the middle, and at the end."""
    spectrum = Spectrum(method.main)  # type: ignore[attr-defined]
    for power in range(len(spectrum.nodes)):
        last = sp.Matrix([(c - 1) ** power for c in spectrum.nodes])
        ahead = spectrum.ahead * last
        assert [sp.expand(a - c**power) for a, c in zip(ahead, spectrum.nodes, strict=True)] == [0] * len(
            last
        )
        now = sp.Matrix([c**power for c in spectrum.nodes])
        for at, found in ((sp.Rational(1, 2), spectrum.middle), (sp.S.One, spectrum.ends)):
            exact = {"a": at**power, "v": at ** (power + 1) / (power + 1)}
            exact["q"] = at ** (power + 2) / ((power + 1) * (power + 2))
            for kind in ("a", "v") if at == 1 and power + 2 > len(last) else KINDS:
                value = (sp.Matrix([list(found[kind])]) * now)[0]
                assert sp.expand(sp.radsimp(value - exact[kind])) == 0, (kind, power, at)


def test_any_abscissae_make_a_method() -> None:
    """Three stages at 0, 1/2 and 1 are Lobatto IIIA: order 4; two equal ones make none."""
    lobatto = collocated("lobatto", "", "", (sp.S.Zero, sp.Rational(1, 2), sp.S.One))
    assert order(lobatto) == 4
    assert order(collocated("trapezoid", "", "", (sp.S.Zero, sp.S.One))) == 2
    with pytest.raises(ValueError, match="no two nodes"):
        collocated("twice", "", "", (sp.S.One, sp.S.One))
    assert radau_nodes(1) == (1,)
    assert gauss_nodes(1) == (sp.Rational(1, 2),)


def test_coupled_stages_are_solved_for_accelerations_alone() -> None:
    scheme = integrator("radau2").main
    motion = affine_motion(scheme, 1, "acceleration")
    assert motion.gain["v"] == sp.Rational(5, 12) * STEP
    assert motion.offset["v"] == past("v") - STEP * stage("a", 2) / 12
    with pytest.raises(UnsuitableUnknownError, match="unknown = 'acceleration'"):
        affine_motion(scheme, 1, "displacement")
