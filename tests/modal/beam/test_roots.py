"""Exact natural frequencies against characteristic equations written out and solved on their own."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import mpmath
import numpy as np
import pytest

from tmm_gen.modal.beam import (
    BeamArm,
    BeamBase,
    Body,
    Member,
    beam_arm,
    beam_shape,
    damped_pole,
    frequencies_below,
    modes_below,
    natural_frequencies,
)
from tmm_gen.scene import load_scene

ARM10 = Path(__file__).resolve().parents[3] / "scenes" / "arm10.toml"
UNIT = Member(1.0, 1.0, 1.0)
STEEL = Member(0.7, 40.0, 0.9)


def clamped_free(x: float) -> float:
    return np.cos(x) + 1.0 / np.cosh(x)


def tip_mass(ratio: float) -> Callable[[float], float]:
    """1 + cos cosh + ratio x (cos sinh - sin cosh) = 0, over cosh."""
    return lambda x: 1 / np.cosh(x) + np.cos(x) + ratio * x * (np.cos(x) * np.tanh(x) - np.sin(x))


def hub(ratio: float) -> Callable[[float], float]:
    """ratio x^3 (1 + cos cosh) + sin cosh - cos sinh = 0, over cosh."""
    return lambda x: ratio * x**3 * (1 / np.cosh(x) + np.cos(x)) + np.sin(x) - np.cos(x) * np.tanh(x)


def roots(function: Callable[[float], float], count: int) -> list[float]:
    """Find the first roots on a grid far finer than their distance, each to full precision."""
    from scipy.optimize import brentq

    grid = np.linspace(1e-3, (count + 2) * np.pi, 40_000)
    values = np.array([function(x) for x in grid])
    at = np.flatnonzero(np.sign(values[1:]) != np.sign(values[:-1]))[:count]
    return [brentq(function, grid[k], grid[k + 1], xtol=1e-15, rtol=1e-15) for k in at]


def beta(arm: BeamArm, count: int) -> np.ndarray:
    return np.sqrt(natural_frequencies(arm, count) / arm.members[0].unit_frequency)


def test_clamped_free_as_in_textbooks() -> None:
    found = beta(BeamArm((UNIT,)), 4)
    np.testing.assert_allclose(found, [1.875104069, 4.694091133, 7.854757438, 10.99554073], rtol=0, atol=5e-9)


@pytest.mark.parametrize("member", [UNIT, STEEL], ids=["unit", "steel"])
def test_clamped_free_up_to_the_50th_mode(member: Member) -> None:
    found = beta(BeamArm((member,)), 50)
    np.testing.assert_allclose(found, roots(clamped_free, 50), rtol=1e-13)


@pytest.mark.parametrize("ratio", [0.1, 1.0, 10.0])
def test_tip_mass(ratio: float) -> None:
    member = STEEL
    mass = ratio * member.mass_per_length * member.length
    found = beta(BeamArm((member,), bodies=(Body(mass),)), 10)
    np.testing.assert_allclose(found, roots(tip_mass(ratio), 10), rtol=1e-12)


def test_pinned_free() -> None:
    found = beta(BeamArm((UNIT,), BeamBase("hub")), 11)
    assert found[0] == 0.0
    np.testing.assert_allclose(found[1:], roots(lambda x: np.sin(x) - np.cos(x) * np.tanh(x), 10), rtol=1e-12)


@pytest.mark.parametrize("ratio", [1e-6, 1e-4, 1e-2, 0.1, 1.0, 10.0, 1e2, 1e4, 1e6])
def test_hub_inertia(ratio: float) -> None:
    member = STEEL
    inertia = ratio * member.mass_per_length * member.length**3
    found = beta(BeamArm((member,), BeamBase("hub", inertia)), 11)
    assert found[0] == 0.0
    np.testing.assert_allclose(found[1:], roots(hub(ratio), 10), rtol=1e-12)


@pytest.mark.parametrize("ratio", [1e-6, 1.0, 1e6])
def test_fifty_modes_with_any_hub_without_overflow(ratio: float) -> None:
    with np.errstate(all="raise"):
        found = beta(BeamArm((UNIT,), BeamBase("hub", ratio)), 51)
    np.testing.assert_allclose(found[1:], roots(hub(ratio), 50), rtol=1e-12)


def test_a_tiny_first_frequency_is_found() -> None:
    """A tip a million times heavier than the beam: the beam is a spring 3EI/L^3."""
    found = natural_frequencies(BeamArm((UNIT,), bodies=(Body(1e6),)), 2)
    assert found[0] == pytest.approx(np.sqrt(3.0 / (1e6 + 33 / 140)), rel=1e-7)
    np.testing.assert_allclose(np.sqrt(found), roots(tip_mass(1e6), 2), rtol=1e-9)


def test_cutting_a_beam_changes_nothing() -> None:
    whole = natural_frequencies(BeamArm((STEEL,)), 12)
    parts = tuple(Member(0.7 * share, 40.0, 0.9) for share in (0.2, 0.5, 0.3))
    np.testing.assert_allclose(natural_frequencies(BeamArm(parts), 12), whole, rtol=1e-12)


def test_joints_between_beams() -> None:
    """A hinge gives a second free motion, a stiff spring closes it; in between, 8x8 conditions in mpmath."""
    halves = (Member(0.5, 1.0, 1.0),) * 2
    hinged = BeamArm(halves, bodies=(Body(joint_stiffness=0.0), Body()))
    found = natural_frequencies(hinged, 4)
    assert found[0] == 0.0
    assert modes_below(hinged, 1e-3)[0] == 1
    stiff = BeamArm(halves, bodies=(Body(joint_stiffness=1e9), Body()))
    np.testing.assert_allclose(
        natural_frequencies(stiff, 4), natural_frequencies(BeamArm((UNIT,)), 4), rtol=1e-7
    )
    k = 2.5
    sprung = np.sqrt(natural_frequencies(BeamArm(halves, bodies=(Body(joint_stiffness=k), Body())), 3))
    for value in sprung:
        assert _sign_changes(lambda x: _jointed(x, k), value)


def _sign_changes(function: Callable[[mpmath.mpf], mpmath.mpf], at: float) -> bool:
    return bool(function(mpmath.mpf(at) * (1 - 1e-10)) * function(mpmath.mpf(at) * (1 + 1e-10)) < 0)


def _jointed(x: mpmath.mpf, k: float) -> mpmath.mpf:
    """Conditions of two half beams with a spring between them, w = A cos + B sin + C cosh + D sinh each."""

    def rows(y: mpmath.mpf) -> list[list[mpmath.mpf]]:
        c, s, ch, sh = mpmath.cos(y), mpmath.sin(y), mpmath.cosh(y), mpmath.sinh(y)
        return [[c, s, ch, sh], [-s, c, sh, ch], [-c, -s, ch, sh], [s, -c, sh, ch]]

    with mpmath.workdps(40):
        start, end = rows(mpmath.mpf(0)), rows(x / 2)
        none = [mpmath.mpf(0)] * 4
        matrix = [
            start[0] + none,
            start[1] + none,
            none + end[2],
            none + end[3],
            end[0] + [-v for v in start[0]],
            end[2] + [-v for v in start[2]],
            end[3] + [-v for v in start[3]],
            # E I w'' = k (w' outer - w' inner)
            [x**2 * m + k * x * t for m, t in zip(end[2], end[1], strict=True)]
            + [-k * x * t for t in start[1]],
        ]
        return mpmath.det(mpmath.matrix(matrix))


def test_a_band_is_complete() -> None:
    arm = BeamArm((STEEL,), BeamBase("hub", 0.02), (Body(0.3, 0.001),))
    some = natural_frequencies(arm, 9)
    found = frequencies_below(arm, 0.5 * (some[7] + some[8]))
    np.testing.assert_allclose(found, some[:8], rtol=1e-12)
    assert len(frequencies_below(BeamArm((UNIT,)), 1.0)) == 0


def test_timoshenko_against_its_own_equations() -> None:
    """Clamped-free with shear and rotary inertia: det of the boundary conditions in mpmath at 40 digits."""
    rotary, shear = 1.5e-3, 5e-3
    found = natural_frequencies(BeamArm((Member(1.0, 1.0, 1.0, rotary, shear),)), 30)
    slender = natural_frequencies(BeamArm((UNIT,)), 30)
    assert np.all(found < slender)
    assert found[-1] ** 2 * rotary * shear > 1  # beyond the cut-off frequency
    for omega in found[[0, 1, 4, 9, 19, 29]]:
        assert _sign_changes(lambda w: _timoshenko(w, rotary, shear), omega)


def _timoshenko(omega: mpmath.mpf, rotary: float, shear: float) -> mpmath.mpf:
    """Determinant of the free tip's rows of exp(A), A from w' = psi + V/kGA, psi' = M, M' = -V - ..., V' = -..."""
    with mpmath.workdps(40):
        square = mpmath.mpf(omega) ** 2
        whole = mpmath.expm(
            mpmath.matrix([[0, 1, 0, shear], [0, 0, 1, 0], [0, -rotary * square, 0, -1], [-square, 0, 0, 0]])
        )
        return whole[2, 2] * whole[3, 3] - whole[2, 3] * whole[3, 2]


def test_damped_poles_of_a_clamped_beam_have_a_closed_form() -> None:
    """Stiffness-proportional damping: s^2 + T w^2 s + w^2 = 0."""
    member = Member(1.0, 1.0, 1.0, damping_time=1e-3)
    for omega in natural_frequencies(BeamArm((member,)), 8):
        pole = damped_pole(BeamArm((member,)), omega)
        assert pole is not None
        zeta = 0.5e-3 * omega
        assert pole == pytest.approx(omega * complex(-zeta, np.sqrt(1 - zeta**2)), rel=1e-12)
    heavy = Member(1.0, 1.0, 1.0, damping_time=0.1)
    assert damped_pole(BeamArm((heavy,)), natural_frequencies(BeamArm((heavy,)), 3)[2]) is None


@pytest.mark.filterwarnings("error")
def test_no_damping_is_too_strong_for_an_answer() -> None:
    scene = load_scene(ARM10)
    for time in (1.0, 536.8102124127167, 1e6, 1e12, 1e100):
        arm = beam_arm(scene.replace(**{"beam.damping_time": time}))
        assert arm is not None
        for omega in natural_frequencies(arm, 6):
            assert omega == 0.0 or damped_pole(arm, omega) is None


def test_mode_shapes() -> None:
    """Against the textbook form, and straight where the hub turns freely."""
    arm = BeamArm((UNIT,))
    omega = natural_frequencies(arm, 3)[2]
    x, shape = beam_shape(arm, omega)
    b = np.sqrt(omega)
    ratio = (np.cosh(b) + np.cos(b)) / (np.sinh(b) + np.sin(b))
    exact = np.cosh(b * x) - np.cos(b * x) - ratio * (np.sinh(b * x) - np.sin(b * x))
    np.testing.assert_allclose(shape, exact / exact[-1], atol=1e-9)
    x, shape = beam_shape(BeamArm((UNIT,), BeamBase("hub", 0.1)), 0.0)
    np.testing.assert_allclose(shape, x, atol=1e-9)


def test_bodies_must_match_the_members() -> None:
    with pytest.raises(ValueError, match="2 bodies for 1 beams"):
        BeamArm((UNIT,), bodies=(Body(), Body()))
    with pytest.raises(ValueError, match="at least one"):
        BeamArm(())
