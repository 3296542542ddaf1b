"""Transfer functions of small chains, as the thesis derives them and as determinants give them."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
import sympy as sp

from tmm_gen.derive.transfer import LAPLACE
from tmm_gen.modal.arm import linear_arm
from tmm_gen.modal.matrices import matrices
from tmm_gen.modal.modes import find_modes
from tmm_gen.modal.response import frequency_response
from tmm_gen.scene import load_scene
from tmm_gen.thesis.transfer_functions import SymbolicChain, numbered_chain, system_matrix, transfer_functions

s = LAPLACE
SCENES = Path(__file__).resolve().parents[2] / "scenes"


def test_equations_2_98_to_2_100() -> None:
    k1, k2, c1, c2, i1, i2 = sp.symbols("k_1 k_2 c_1 c_2 I_1 I_2", positive=True)
    found = transfer_functions(numbered_chain(2), 1)
    polynomial = (i1 * s**2 + (c1 + c2) * s + k1 + k2) * (i2 * s**2 + c2 * s + k2) - (c2 * s + k2) ** 2
    assert sp.simplify(found.function(0) - (i2 * s**2 + c2 * s + k2) / polynomial) == 0
    assert sp.simplify(found.function(1) - (c2 * s + k2) / polynomial) == 0
    assert sp.expand(found.denominator.as_expr() - polynomial) == 0


def test_one_station_is_equation_2_49() -> None:
    k, inertia = sp.symbols("k I", positive=True)
    matrix = system_matrix(SymbolicChain([k], [sp.Integer(0)], [inertia]), 1)
    expected = sp.Matrix([[1, 1 / k, 0], [inertia * s**2, inertia * s**2 / k + 1, -1], [0, 0, 1]])
    assert (matrix - expected).applyfunc(sp.simplify) == sp.zeros(3, 3)


def test_a_free_hub_has_a_pole_at_zero_and_reciprocity() -> None:
    chain = numbered_chain(1, hub=True)
    at_hub, at_link = transfer_functions(chain, 0), transfer_functions(chain, 1)
    assert at_hub.denominator.eval(0) == 0
    assert sp.simplify(at_hub.function(1) - at_link.function(0)) == 0


def test_rational_functions_equal_the_sweep() -> None:
    """Exact numbers, ten stations: poles as `modes` finds them, values as the Riccati sweep finds them."""
    scene = load_scene(SCENES / "thesis10.toml")

    def exact(values: list[float]) -> list[sp.Rational]:
        return [sp.Rational(*Fraction(value).as_integer_ratio()) for value in values]

    chain = SymbolicChain(
        exact([j.stiffness for j in scene.joints]),
        exact([j.damping for j in scene.joints]),
        exact([link.inertia for link in scene.links]),
    )
    ratio = transfer_functions(chain, 10)
    assert ratio.denominator.degree() == 20
    arm = linear_arm(scene)
    poles = np.array([pole for mode in find_modes(matrices(arm)) for pole in mode.poles])
    for root in ratio.denominator.nroots(n=20, maxsteps=200):
        assert np.min(np.abs(poles - complex(root))) < 1e-9
    points = [0.3j, 2.0j, 11.0j, 0.5 + 1.0j]
    found = frequency_response(arm, np.array(points))
    tip = [complex(ratio.function(9).subs(s, sp.sympify(point)).evalf(20)) for point in points]
    np.testing.assert_allclose(found["tip"][:, 0], tip, rtol=1e-11)


def test_a_torque_needs_a_place_that_moves() -> None:
    with pytest.raises(ValueError, match="station 0 of 2"):
        transfer_functions(numbered_chain(2), 0)
