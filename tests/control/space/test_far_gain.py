"""Gains of a filter far from its target: where those of the target make an error grow, the others let it die."""

from __future__ import annotations

import numpy as np
import pytest

from tmm_gen.control.bench import Bench
from tmm_gen.control.estimators.extended_kalman import NonlinearFilter
from tmm_gen.control.goals.target import rest_with
from tmm_gen.control.prediction.links import target_state

SMALL = 1e-6
"""By how much each entry of an estimate is off, rad, rad/s, and so on."""
SAMPLES = 150


def left(bench: Bench, found: NonlinearFilter, hub: np.ndarray) -> float:
    """Return by how much an error of the estimate of an arm that rests with its hubs there has grown, in hubs."""
    rest = rest_with(bench.step.scene, hub, "control.reference")
    truth = target_state(bench.step, rest)
    seen = np.array(bench.step.sensors(truth)).ravel()
    found.reset()
    found.estimate = np.append(truth, np.zeros(len(found.estimate) - len(truth)))
    found.estimate += SMALL * np.random.default_rng(2).normal(size=len(found.estimate))
    for _ in range(SAMPLES):
        found.correct(found.surprise(seen), tuple(found.sensors), found.start + np.inf)
        found.advance((rest.goal.torque, rest.goal.torque), rest.goal.torque)
    return float(np.max(np.abs(found.hubs()[0] - hub))) / SMALL


@pytest.fixture(scope="module")
def found(bench: Bench) -> NonlinearFilter:
    """The filter of the small arm, whose tip swings sideways otherwise when it points up or down."""
    return NonlinearFilter(bench.step, bench.links)


@pytest.fixture(scope="module")
def poses(found: NonlinearFilter) -> np.ndarray:
    """Hubs beyond the reach of the target's gains, rad, drawn otherwise than those that these were tried in."""
    assert found.far is not None
    drawn = found.far.target + np.random.default_rng(11).uniform(-np.pi, np.pi, (24, 2))
    return np.array([hub for hub in drawn if found.far.is_far(hub)])


def test_errors_die_far_from_the_target(bench: Bench, found: NonlinearFilter, poses: np.ndarray) -> None:
    """Of an arm at rest in any pose, foreseen by the nonlinear step."""
    assert len(poses) > 8
    assert max(left(bench, found, hub) for hub in poses) < 0.2


def test_with_the_gains_of_the_target_they_grow(bench: Bench, poses: np.ndarray) -> None:
    """In some of the same poses; at the target they die."""
    near = NonlinearFilter(bench.step, bench.links)
    near.far = None
    assert max(left(bench, near, hub) for hub in poses) > 10.0
    assert left(bench, near, bench.links.goal.hub) < 0.2


def test_the_motor_that_turns_the_whole_arm_may_be_anywhere(found: NonlinearFilter) -> None:
    """Near the target is where the others are near."""
    assert found.far is not None
    target, reach = found.far.target, found.far.reach
    assert not found.far.is_far(target + np.array([9.0, 0.99 * reach[1]]))
    assert found.far.is_far(target + np.array([0.0, 1.01 * reach[1]]))
    found.rest(target + np.array([0.0, 2.0]), np.zeros(2))
    assert found.taken_in(()) == (-1,)
    found.reset()
