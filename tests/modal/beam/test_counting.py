"""The counts behind the search: clamped and supported members, and that the dynamic stiffness is what it says."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from tmm_gen.derive.elements.beam import FREQUENCY, ROTARY, SHEAR, WAVE, system_matrix, waves
from tmm_gen.modal.beam import BeamArm, BeamBase, Body, Member, clamped_count, dynamic_stiffness, modes_below
from tmm_gen.modal.beam.stiffness import supported_count

THICK = Member(1.0, 1.0, 1.0, 1.5e-3, 5e-3)


def test_clamped_members() -> None:
    """Clamped at both ends: cos x cosh x = 1 at 4.730041, 7.853205, 10.995608, ..."""
    textbook = np.array([4.730040745, 7.853204624, 10.995607838, 14.137165491])
    member = Member(2.0, 3.0, 0.5)
    omega = textbook**2 * member.unit_frequency
    assert list(clamped_count(member, 0.999999 * omega)) == [0, 1, 2, 3]
    assert list(clamped_count(member, 1.000001 * omega)) == [1, 2, 3, 4]


def test_the_closed_count_of_wittrick_and_williams() -> None:
    """J0 = i - (1 - (-1)^i sign(1 - cosh x cos x))/2 with i = floor(x / pi), their eq. for bending."""
    x = np.linspace(0.3, 60.0, 997)
    i = np.floor(x / np.pi)
    expected = i - 0.5 * (1 - (-1) ** i * np.sign(1 / np.cosh(x) - np.cos(x)))
    np.testing.assert_array_equal(clamped_count(Member(1.0, 1.0, 1.0), x**2), expected)


def test_supported_thick_beam_by_its_polynomial() -> None:
    """Both spectra of a beam on two supports, from the derived polynomial, number by number."""
    n = sp.Symbol("n")
    square = sp.Symbol("Omega2")
    sine_waves = {WAVE: sp.I * n * sp.pi, FREQUENCY: -square}  # w = sin(n pi xi)
    polynomial = (system_matrix() - WAVE * sp.eye(4)).det().subs(sine_waves)
    polynomial = sp.expand(polynomial).subs({ROTARY: THICK.rotary, SHEAR: THICK.shear})
    squares = [1.0 / (THICK.rotary * THICK.shear)]  # pure shear
    for number in range(1, 80):
        squares += [float(r) for r in sp.Poly(polynomial.subs(n, number).evalf(30), square).nroots(n=20)]
    found = np.sqrt(np.array(squares))
    for omega in (5.0, 50.0, 300.0, 364.0, 366.0, 1000.0, 2000.0):
        assert supported_count(THICK, omega)[0] == np.sum(found < omega)


@given(st.floats(0.05, 80.0), st.floats(0.1, 0.9), st.sampled_from(["slender", "thick"]))
def test_two_halves_count_like_the_whole(x: float, share: float, kind: str) -> None:
    rotary, shear = (0.0, 0.0) if kind == "slender" else (1e-3, 4e-3)
    whole = Member(1.0, 1.0, 1.0, rotary, shear)
    parts = tuple(Member(part, 1.0, 1.0, rotary, shear) for part in (share, 1 - share))
    omega = x**2
    base, tip = BeamBase("hub", 0.2), Body(0.3, 0.01)
    one = modes_below(BeamArm((whole,), base, (tip,)), omega)
    two = modes_below(BeamArm(parts, base, (Body(), tip)), omega)
    assert one == two


@pytest.mark.parametrize("s", [0.3j, 2.0j, 40.0j, 900.0j, -1.0 + 30.0j])
@pytest.mark.parametrize("member", [Member(1.0, 1.0, 1.0), THICK], ids=["slender", "thick"])
def test_dynamic_stiffness_against_the_matrix_exponential(s: complex, member: Member) -> None:
    """The differential equations, integrated by mpmath at 60 digits, on both sides of the change of basis."""
    import mpmath

    with mpmath.workdps(60):
        p = mpmath.mpc(s) ** 2
        values = {"p": p, "r2": mpmath.mpf(member.rotary), "sigma2": mpmath.mpf(member.shear)}
        system = system_matrix()
        matrix = mpmath.matrix(4, 4)
        for row in range(4):
            for column in range(4):
                entry = sp.lambdify(sp.symbols("p"), system[row, column].subs(_plain(member)), "mpmath")
                matrix[row, column] = entry(values["p"])
        whole = mpmath.expm(matrix)
        upper, corner = whole[0:2, 0:2], whole[0:2, 2:4]
        inverse = corner**-1
        force_in = mpmath.matrix(2, 4)
        force_in[:, 0:2], force_in[:, 2:4] = -inverse * upper, inverse
        force_out = whole[2:4, 2:4] * force_in
        for row in range(2):
            for column in range(2):
                force_out[row, column] += whole[2 + row, column]
        rows = [-force_in[1, :], -force_in[0, :], force_out[1, :], force_out[0, :]]
        expected = np.array([[complex(row[k]) for k in range(4)] for row in rows])
    found = dynamic_stiffness(member, np.array([s]))[0]
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-9 * np.abs(expected).max())


def _plain(member: Member) -> dict[sp.Symbol, sp.Float]:
    return {ROTARY: sp.Float(member.rotary, 60), SHEAR: sp.Float(member.shear, 60)}


def test_euler_and_bernoulli_come_out_without_shear_and_rotary_inertia() -> None:
    p = sp.Symbol("p")
    squares = [square.subs({ROTARY: 0, SHEAR: 0}) for square in waves().squares]
    assert {sp.expand(square**2) for square in squares} == {-p}
