"""Estimators: optimal in the linear case, free of offset, and alike near the target."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.linalg import solve_discrete_are

from tmm_gen.control.bench import Bench
from tmm_gen.control.estimators.extended_kalman import ExtendedKalmanFilter, NonlinearFilter
from tmm_gen.control.estimators.kalman import KalmanFilter


def test_the_gain_solves_the_riccati_equation(bench: Bench) -> None:
    found = KalmanFilter(bench.modes, bench.problem)
    covariance = solve_discrete_are(
        found.transition.T, found.measure.T, found.driven(found.drive), found.noise
    )
    seen = found.measure @ covariance
    expected = np.linalg.solve(seen @ found.measure.T + found.noise, seen).T
    assert_allclose(found.gain, expected, rtol=1e-4, atol=1e-6)


@pytest.mark.parametrize("kind", ["modes", "links"])
def test_an_unknown_torque_is_found(bench: Bench, kind: str) -> None:
    """0.2 N m nobody commanded, against the model itself: found within 4 s to 2 %."""
    model = getattr(bench, kind)
    estimator = KalmanFilter(model, bench.problem)
    state, acting = model.start.copy(), np.zeros(1)
    for k in range(200):
        seen = model.measure @ state + model.feed @ (acting + 0.2)
        seen[1] += (model.tip_rate[0] @ state) ** 2 * (model.whirl @ state)
        estimator.correct(estimator.surprise(seen + model.target_sensors), (0, 1), np.inf)
        acting = np.array([0.5 * np.sin(0.3 * k)])
        estimator.advance((acting, acting), acting)
        state = model.transition @ state + model.drive @ (acting + 0.2)
    found, disturbance = estimator.ahead([])
    assert disturbance == pytest.approx(0.2, rel=0.02)
    assert_allclose(model.tip @ found, model.tip @ state, atol=2e-3)


def test_filters_agree_at_the_target(bench: Bench) -> None:
    """On the resting arm all three make the same of a measurement."""
    linear = KalmanFilter(bench.links, bench.problem)
    others = [kind(bench.step, bench.links) for kind in (NonlinearFilter, ExtendedKalmanFilter)]
    start = bench.step.straight(1.0)
    linear.estimate = np.zeros(len(start) + 1)
    for other in others:
        other.estimate = np.append(start, 0.0)
    measured = bench.links.target_sensors + np.array([1e-4, 1e-3, 0.0])
    measured[2] = np.nan  # there is no strain gauge
    acting = np.array([0.01])
    for _ in range(3):
        for each in (linear, *others):
            each.correct(each.surprise(measured), (0, 1), np.inf)
            each.advance((acting, acting), acting)
    for other in others:
        assert_allclose(other.estimate[:-1] - start, linear.estimate[:-1], rtol=1e-3, atol=1e-7)
        assert other.estimate[-1] == pytest.approx(linear.estimate[-1], rel=1e-3, abs=1e-9)


def test_a_filter_without_accelerometer_has_the_gain_of_a_scene_without_one(bench: Bench) -> None:
    found = KalmanFilter(bench.modes, bench.problem)
    scene = bench.scene.replace(**{"control.sensors.accelerometer": None})
    alone = KalmanFilter(bench.modes, Bench.of(scene).problem)
    assert alone.sensors == [0]
    assert_allclose(found.gain_of((0,)), alone.gain, rtol=1e-12)


@pytest.mark.parametrize("kind", [NonlinearFilter, ExtendedKalmanFilter, KalmanFilter])
def test_an_estimate_can_be_turned_and_start_anew(bench: Bench, kind: type) -> None:
    filters = {KalmanFilter: lambda: KalmanFilter(bench.links, bench.problem)}
    estimator = filters.get(kind, lambda: kind(bench.step, bench.links))()
    measured = np.array([0.3, 0.0, np.nan])
    estimator.turn(np.array([0.3]))
    assert estimator.surprise(measured)[0] == pytest.approx(0.0, abs=1e-12)
    estimator.rest(np.array([0.7]), np.array([2.0]))
    measured[0] = 0.7
    assert estimator.surprise(measured)[0] == pytest.approx(0.0, abs=1e-12)
    estimator.advance((np.zeros(1), np.zeros(1)), np.zeros(1))
    after = 0.7 + 2.0 * bench.problem.sample_time
    assert estimator.surprise(measured)[0] == pytest.approx(0.7 - after, rel=0.02)
