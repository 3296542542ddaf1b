"""Poles, natural frequencies, damping ratios."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.linalg import eigvals
from thesis.spring_rule_errors import convergence

from tmm_gen.modal.arm import linear_arm
from tmm_gen.modal.beam import beam_arm, damped_pole, natural_frequencies
from tmm_gen.modal.discretised import links_needed, straight_frequencies, with_links
from tmm_gen.modal.matrices import Matrices, matrices
from tmm_gen.modal.modes import find_modes
from tmm_gen.modal.sweep import sweep
from tmm_gen.scene import Scene


def all_poles(linear: Matrices) -> np.ndarray:
    """Eigenvalues of the first-order system, by SciPy."""
    size = len(linear.mass)
    zero, unit = np.zeros((size, size)), np.eye(size)
    return eigvals(
        np.block([[zero, unit], [-linear.stiffness, -linear.damping]]),
        np.block([[unit, zero], [zero, linear.mass]]),
    )


@pytest.mark.parametrize("name", ["thesis2", "thesis10", "drivetrain"])
def test_modes_hold_all_poles(name: str, scene_named: Callable[[str], Scene]) -> None:
    linear = matrices(linear_arm(scene_named(name)))
    modes = find_modes(linear)
    found = [pole for mode in modes for pole in mode.poles]
    expected = all_poles(linear)
    assert len(found) == len(expected)
    scale = np.max(np.abs(expected))
    # 1e-7: a double pole at zero (an arm that turns freely) is known to the root of rounding
    for one, others in ((found, expected), (expected, found)):
        assert all(np.min(np.abs(np.array(others) - pole)) < 1e-7 * scale for pole in one)


def test_thesis10_in_closed_form(scene_named: Callable[[str], Scene]) -> None:
    """Ten equal stations, clamped and free: w_j = 2 sqrt(k/I) sin((2j - 1) pi / 42), zeta = c w / (2 k)."""
    modes = find_modes(matrices(linear_arm(scene_named("thesis10"))))
    exact = 2 * np.sqrt(20.0) * np.sin((2 * np.arange(1, 11) - 1) * np.pi / 42)
    np.testing.assert_allclose([mode.frequency for mode in modes], exact, rtol=1e-12)
    np.testing.assert_allclose([mode.damping_ratio for mode in modes], 5 * exact / 40, rtol=1e-12)
    assert modes[-1].poles[0].imag == 0.0  # overdamped: two real poles
    assert (modes[0].motion, modes[-1].motion) == ("swings", "creeps back")
    assert modes[-1].poles[0] * modes[-1].poles[1] == pytest.approx(exact[-1] ** 2)


def test_a_free_drive_turns(scene_named: Callable[[str], Scene]) -> None:
    """One mode turns freely, braked by the bearing; the others swing."""
    scene = scene_named("drivetrain")
    first, second = find_modes(matrices(linear_arm(scene)), 2)
    assert (first.frequency, first.damping_ratio, first.unstable) == (0.0, None, False)
    inertia = scene.base.inertia + sum(link.inertia for link in scene.links)
    assert first.poles[1].real == pytest.approx(-scene.base.damping / inertia, rel=1e-3)
    np.testing.assert_allclose(first.shape, 1.0, rtol=1e-6)
    assert second.hertz == pytest.approx(88.2, abs=0.1)


def test_impedance_of_the_sweep_vanishes_at_the_poles(scene_named: Callable[[str], Scene]) -> None:
    """Poles come from matrices, the sweep from transfer matrices: next to a pole the sweep's answer blows up."""
    arm = linear_arm(scene_named("thesis2"))
    for mode in find_modes(matrices(arm)):
        near = sweep(arm, np.array([mode.poles[0] * (1 + 1e-9), mode.poles[0] * 1.1])).motion[-1, :, 0, 0]
        assert abs(near[0]) > 1e6 * abs(near[1])


def test_an_arm_held_upside_down_falls_over(beam_scene: Callable[..., Scene]) -> None:
    from tmm_gen.modal.rest import rest_at

    motor = 'kind = "motor"\ninertia = 0.01'
    scene = beam_scene(links=3, base=motor, gravity=9.81)
    for angle, falls in ((np.pi / 2, True), (-np.pi / 2, False)):
        rest = rest_at(scene, np.full(4, angle))
        first = find_modes(matrices(linear_arm(scene, rest)))[0]
        assert first.unstable == falls
        assert (first.frequency == 0.0) == falls


@pytest.mark.parametrize(
    ("base", "tip"),
    [
        ('kind = "clamp"', ""),
        ('kind = "clamp"', "[tip]\nmass = 0.4"),
        ('kind = "motor"\ninertia = 0.05\ndamping = 0.02', "[tip]\nmass = 0.1"),
    ],
)
def test_an_arm_of_many_links_is_the_continuous_beam(
    base: str, tip: str, beam_scene: Callable[..., Scene]
) -> None:
    """Richardson's extrapolation of 100 and 200 links: frequencies to 1e-6, damped poles too."""
    scene = beam_scene(base=base, tip=tip, damping=1e-4)
    exact = natural_frequencies(beam_arm(scene), 5)
    coarse, fine = (straight_frequencies(scene, n)[:5] for n in (100, 200))
    np.testing.assert_allclose((4 * fine - coarse) / 3, exact, rtol=2e-6, atol=1e-9)
    modes = find_modes(matrices(linear_arm(with_links(scene, 100))), 4)
    for mode, omega in zip(modes, exact, strict=False):
        if omega > 0.0:
            pole = damped_pole(beam_arm(scene), omega)
            assert pole == pytest.approx(mode.poles[0], rel=1e-3)


def test_inertia_at_the_tip_costs_an_order(beam_scene: Callable[..., Scene]) -> None:
    """The last link is as stiff as a rod: the half of it beyond its middle does not bend under the body."""
    scene = beam_scene(tip="[tip]\nmass = 0.4\ninertia = 0.01")
    exact = natural_frequencies(beam_arm(scene), 3)
    errors = [straight_frequencies(scene, n)[:3] / exact - 1 for n in (100, 200)]
    np.testing.assert_allclose(np.log2(errors[0][1:] / errors[1][1:]), 1, atol=0.05)


@pytest.mark.parametrize(("rule", "order"), [("thesis", 1), ("uniform", 1), ("half-clamp", 2)])
def test_order_of_the_spring_rules(rule: str, order: int, beam_scene: Callable[..., Scene]) -> None:
    found = convergence(beam_scene(tip=""), rule, (2, 10, 50, 70, 100, 140, 200), 5)  # type: ignore[arg-type]
    np.testing.assert_allclose(found.slopes(50), order, atol=0.05)
    assert np.isnan(found.errors[0, 2])


def test_few_links_are_enough_and_one_less_is_not(beam_scene: Callable[..., Scene]) -> None:
    scene = beam_scene(tip="[tip]\nmass = 0.1")
    band = float(natural_frequencies(beam_arm(scene), 4)[3]) * 1.01
    found = links_needed(scene, 0.01, band)
    assert len(found.exact) == 4
    assert found.worst <= 0.01
    assert found.errors_below is not None
    assert np.max(found.errors_below) > 0.01
    for links in range(1, found.links):
        few = straight_frequencies(scene, links)
        assert len(few) < 4 or np.max(np.abs(few[:4] / found.exact - 1)) > 0.01
    assert links_needed(scene, 0.01, 1e-3).links == 1
    with pytest.raises(ValueError, match="not enough"):
        links_needed(scene, 1e-9, band)
