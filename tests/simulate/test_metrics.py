"""Figures of responses whose peak, settling time and slope are known in closed form."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tmm_gen.simulate.metrics import convergence_slope, largest_error, rms_error, step_figures


def test_errors_are_relative_to_the_scale() -> None:
    assert rms_error([1.0, 2.0], [1.0, 1.0], -0.5) == pytest.approx(math.sqrt(0.5) / 0.5)
    assert largest_error([1.0, -2.0], [1.0, 1.0], 0.5) == 6.0


def test_underdamped_step() -> None:
    decay, turn = 0.3, 2.0
    time = np.linspace(0.0, 30.0, 300_001)
    response = 4.0 * (1 - np.exp(-decay * time) * (np.cos(turn * time) + decay / turn * np.sin(turn * time)))
    found = step_figures(time, response, final=4.0)
    assert found.overshoot == pytest.approx(math.exp(-decay * math.pi / turn), rel=1e-8)
    assert found.peak == pytest.approx(4.0 * (1 + found.overshoot))
    assert found.peak_time == pytest.approx(math.pi / turn, abs=1e-4)
    assert found.settling_time is not None
    later = time >= found.settling_time
    assert np.all(np.abs(response[later] - 4.0) <= 0.08)
    assert abs(response[np.flatnonzero(later)[0] - 1] - 4.0) > 0.08


def test_downward_and_unsettled() -> None:
    found = step_figures([0, 1, 2, 3], [0.0, -1.5, -1.0, -0.5], final=-1.0)
    assert (found.peak, found.overshoot, found.settling_time) == (-1.5, 0.5, None)


def test_monotonous_has_no_overshoot() -> None:
    found = step_figures([0, 1, 2, 3], [0.0, 0.5, 0.99, 1.0])
    assert (found.overshoot, found.settling_time, found.final) == (0.0, 2.0, 1.0)


def test_return_to_the_start() -> None:
    found = step_figures([0, 1, 2, 3], [0.0, -5.0, 0.05, 0.0])
    assert (found.peak, found.peak_time, found.overshoot, found.settling_time) == (-5.0, 1.0, 0.0, 2.0)


def test_nothing_moves() -> None:
    found = step_figures([0, 1], [2.0, 2.0])
    assert (found.peak, found.overshoot, found.settling_time) == (2.0, 0.0, 0.0)


def test_slope_of_a_power() -> None:
    steps = np.array([0.1, 0.05, 0.02, 0.01])
    found = convergence_slope(steps, 3.0 * steps**2.5)
    assert found.order == pytest.approx(2.5)
    assert found.spread == pytest.approx(0.0, abs=1e-10)
    assert convergence_slope(steps, steps + 0.1 * steps**2).spread > 0.001


@pytest.mark.parametrize("errors", [[1.0], [1.0, 0.0], [1.0, math.nan]])
def test_slope_needs_positive_errors(errors: list[float]) -> None:
    with pytest.raises(ValueError, match="positive errors"):
        convergence_slope([0.1, 0.2][: len(errors)], errors)
