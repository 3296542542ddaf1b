"""The error a step leaves by itself: the integrator's own on known motions, and low where it cannot be known."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from tmm_gen.derive.integrators.accuracy import leading_terms
from tmm_gen.derive.integrators.amplification import OMEGA, amplification
from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.reference.planar_arm import Arm
from tmm_gen.scene import Integrator, Scene
from tmm_gen.simulate.step_error import error_per_radian, step_error

STEP, FREQUENCY = 1e-3, 5.0
NEWMARK = (FREQUENCY * STEP) ** 2 / 12.0


@pytest.fixture(scope="module")
def arm(falling: Callable[..., Scene]) -> Arm:
    return Arm(falling(2), {})


@pytest.mark.parametrize(
    ("name", "parameters"),
    [
        ("newmark", {}),
        ("newmark", {"beta": 0.3, "gamma": 0.6}),
        ("generalized_alpha", {}),
        ("houbolt", {}),
        ("sdirk4", {}),
    ],
)
def test_an_integrator_strays_as_its_leading_terms_say(name: str, parameters: dict[str, float]) -> None:
    terms = leading_terms(amplification(integrator(name, **parameters).main))
    for angle in (1e-3, 1e-2):
        errors = (float(term.subs(OMEGA, angle)) for term in terms)
        found = error_per_radian(Integrator(name, 1.0, parameters), angle)
        assert found == pytest.approx(np.hypot(*errors), rel=0.05)


def test_a_long_step_counts_as_half_a_radian_and_a_tiny_one_is_no_trouble() -> None:
    declared = Integrator("newmark", 1.0)
    assert error_per_radian(declared, 1e9) == error_per_radian(declared, 0.5)
    assert 0.0 <= error_per_radian(declared, 0.0) < 1e-12
    # no vibration any more at half a radian
    assert error_per_radian(Integrator("newmark", 1.0, {"beta": 1.0, "gamma": 1.0}), 0.5) > 1e-2


def swing(
    arm: Arm, amplitude: float, until: float, count: int = 400
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Both links swing together."""
    times = np.linspace(until / count, until, count)
    q = amplitude * np.outer(np.sin(FREQUENCY * times), np.ones(2))
    v = amplitude * FREQUENCY * np.outer(np.cos(FREQUENCY * times), np.ones(2))
    return times, q, v


@pytest.mark.parametrize("amplitude", [1e-6, 0.1])
def test_of_a_swing_it_is_that_of_its_frequency(arm: Arm, amplitude: float) -> None:
    assert step_error(arm, *swing(arm, amplitude, 20.0)) == pytest.approx(NEWMARK, rel=0.02)


def test_of_a_spinning_arm_it_is_that_of_its_turns(arm: Arm) -> None:
    times = np.linspace(0.02, 8.0, 400)
    q = FREQUENCY * np.outer(times, np.ones(2))
    v = np.full_like(q, FREQUENCY)
    assert step_error(arm, times, q, v) == pytest.approx(NEWMARK, rel=0.02)


def test_ringing_of_fast_modes_adds_next_to_nothing(arm: Arm) -> None:
    times, q, v = swing(arm, 0.1, 20.0)
    fast, small = 40.0 * FREQUENCY, 1e-3
    bent = np.array([1.0, -1.0])
    q = q + small * np.outer(np.sin(fast * times), bent)
    v = v + small * fast * np.outer(np.cos(fast * times), bent)
    assert NEWMARK <= step_error(arm, times, q, v) < 1.3 * NEWMARK


def test_constant_acceleration_is_followed_exactly(arm: Arm) -> None:
    """The beginning of a fall: its only period would be its own length, 20 steps, and that error 3e-3."""
    times = np.arange(1, 21) * STEP
    q = np.outer(-2e-3 * times**2, np.ones(2))
    v = np.outer(-4e-3 * times, np.ones(2))
    assert step_error(arm, times, q, v) < 1e-8


@pytest.mark.parametrize("count", [1, 2, 3])
def test_of_a_few_looks_nothing_is_known_and_the_step_counts_as_long(arm: Arm, count: int) -> None:
    long = error_per_radian(arm.scene.integrator, 0.5)
    assert step_error(arm, *swing(arm, 0.1, count * STEP, count)) == long


def test_without_motion_there_is_no_error(arm: Arm) -> None:
    times = np.arange(1, 5) * STEP
    assert step_error(arm, times, np.zeros((4, 2)), np.zeros((4, 2))) == 0.0
