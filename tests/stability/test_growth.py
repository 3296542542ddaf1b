"""Growth as numbers is that of the derived amplification matrix, mode by mode and for the arm as a whole."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from support.eigenvalues import spectral_radius

from tmm_gen.derive.integrators.registry import integrator, names
from tmm_gen.scene import Scene
from tmm_gen.stability.growth import Growth
from tmm_gen.stability.motion import small_motion
from tmm_gen.stability.whole_arm import WholeStep


@pytest.mark.parametrize("name", names())
def test_radius_is_the_derived_one(name: str) -> None:
    growth = Growth(integrator(name))
    for omega, zeta in ((0.3, 0.0), (1.7, 0.05), (40.0, 3.0)):
        expected = spectral_radius(growth.linear, omega, zeta)
        stiffness, damping = omega**2, 2.0 * zeta * omega
        assert growth.radius(stiffness, damping) == pytest.approx(expected, rel=1e-7)
        assert growth.excess(stiffness, damping) == pytest.approx(expected - 1.0, rel=1e-9, abs=1e-14)


def test_what_stays_on_the_circle_is_told_from_what_grows_a_little() -> None:
    assert Growth(integrator("newmark")).excess(0.01**2, 0.0) == 0.0
    # a negative damping ratio of Omega^3 / 48
    assert Growth(integrator("zhou")).excess(0.01**2, 0.0) == pytest.approx(0.01**4 / 48, rel=1e-3)


def test_motions_without_a_frequency_have_a_radius_too() -> None:
    free = Growth(integrator("newmark"))
    assert free.excess(0.0, 0.0) == pytest.approx(0.0, abs=1e-15)
    assert free.excess(-0.01, 0.0) == pytest.approx(np.exp(0.1) - 1.0, rel=1e-2)  # falls over, as it should
    assert Growth(integrator("zhai")).excess(0.0, 5.0) > 0.1  # a free body on a strong damper


@pytest.mark.parametrize("name", ["newmark", "zhou", "zhai", "sdirk4", "houbolt"])
def test_modes_and_the_whole_arm_agree_where_damping_does_not_couple(
    name: str, example: Callable[[str], Scene]
) -> None:
    motion = small_motion(example("thesis10"))
    assert not motion.mixed
    growth = Growth(integrator(name))
    whole = WholeStep(growth.integrator, motion.linear)
    for step in (0.01, 0.3):
        modes = growth.radius(motion.stiffness * step**2, motion.damping * step)
        assert whole.radius(step) == pytest.approx(np.max(modes), rel=1e-9)


def test_damping_that_couples_modes_is_noticed(example: Callable[[str], Scene]) -> None:
    assert small_motion(example("drivetrain")).mixed
