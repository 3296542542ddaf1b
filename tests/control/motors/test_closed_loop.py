"""Closed loops of two motors on the finer arm: how they begin, what they come to, their pictures."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from tmm_gen.closed_loop.compare import compare
from tmm_gen.closed_loop.motion import motion
from tmm_gen.closed_loop.pictures import comparison_picture
from tmm_gen.closed_loop.plant import Plant
from tmm_gen.control.bench import Bench
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.controllers import BY_NAME

pytestmark = pytest.mark.compiler

NOMINAL, FRICTION = CONDITIONS[0], CONDITIONS[3]


def test_the_arm_rests_until_its_motors_let_go(two: Bench) -> None:
    """Held by the torques of its start nothing moves; without them it falls. Encoders round, as finely as told."""
    plant = Plant(two.scene, two.problem, NOMINAL)
    torque = plant._start()[1]
    for _ in range(5):
        angles = plant.advance(torque)
    np.testing.assert_allclose(angles[:, 2:], 0.0, atol=1e-6)
    count = 2.0 * np.pi / two.problem.encoders
    assert np.all(np.abs(plant.measured()[:2] / count % 1.0) < 1e-9)
    for _ in range(5):
        angles = plant.advance(np.zeros(2))
    assert np.all(angles[-1, :2] < -0.01)


def test_figures_pictures_and_motion_are_of_both_motors(two: Bench) -> None:
    kinds = [BY_NAME[name] for name in ("pd-id", "rti-zero")]
    trials = list(compare(two, kinds, [NOMINAL, FRICTION], duration=2.0))
    low, high = two.problem.torque
    for trial in trials:
        assert trial.loop.torque.shape == (100, 2)
        assert np.all((trial.loop.torque >= low) & (trial.loop.torque <= high))
        assert trial.figures.fallbacks == 0
    predicted = trials[1]
    np.testing.assert_allclose(predicted.loop.hub[-1], two.problem.reference, atol=0.02)
    assert abs(predicted.figures.offset) < 5e-3
    assert comparison_picture(trials, two.problem).startswith(b"\x89PNG")
    shown = motion(two.scene, predicted)
    assert shown.trace is not None
    assert set(shown.inputs) == {"shoulder_torque", "elbow_torque"}


def test_a_delay_is_made_up_for(two: Bench) -> None:
    """Torques of the start act until the first that was chosen does."""
    late = dataclasses.replace(two.problem, delay=0.02)
    plant = Plant(two.scene, late, NOMINAL)
    first = plant.advance(high := late.torque[1])
    np.testing.assert_allclose(first[:, 2:], 0.0, atol=1e-6)
    assert np.all(plant.advance(high)[-1, 2:] > 1e-4)
