"""Start values that the last step's polynomial is compared with are what they are called."""

from __future__ import annotations

import pytest
import sympy as sp
from start_values import STARTS

from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.derive.integrators.spectrum import spectrum_of


@pytest.mark.parametrize(("name", "degree"), [("polynomial", 2), ("line", 1), ("held", 0)])
def test_start_values_are_exact_for_polynomials_of_their_degree(name: str, degree: int) -> None:
    spectrum = spectrum_of(integrator("radau3").main)
    weights = STARTS[name](spectrum)
    for power in range(degree + 2):
        before = sp.Matrix([node**power for node in spectrum.nodes])
        ahead = sp.Matrix([(1 + node) ** power for node in spectrum.nodes])
        off = (weights * before - ahead).applyfunc(lambda x: sp.simplify(sp.expand(x)))
        assert off.is_zero_matrix == (power <= degree)
