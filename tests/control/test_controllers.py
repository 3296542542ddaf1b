"""Controllers: the same problem gives the same torque, and what goes wrong is said."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Status
from tmm_gen.control.controllers import CONTROLLERS
from tmm_gen.control.laws.full_nmpc import FullNmpc
from tmm_gen.control.laws.linear_mpc import LinearMpc
from tmm_gen.control.laws.rti import RealTimeIteration

KNOWN = (np.array([0.1]), np.array([0.2]))
"""Disturbance and last torque, N m."""


def near_the_target(bench: Bench) -> np.ndarray:
    """A state from which no torque of the solution is at its bound."""
    state = bench.step.straight(0.97)
    state[bench.step.places("rate")] = 0.05
    return state


def test_solvers_of_the_nonlinear_problem_agree(small: Bench) -> None:
    torques = [
        FullNmpc(small.step, small.links, small.inertia, solver).decide(near_the_target(small), *KNOWN)
        for solver in ("fatrop", "ipopt")
    ]
    assert [command.status for command in torques] == [Status.OK] * 2
    assert torques[0].torque == pytest.approx(torques[1].torque, abs=1e-5)
    assert 0.0 < abs(torques[0].torque) < 3.0


@pytest.mark.parametrize("zero_order", [False, True])
def test_iterations_converge_to_the_nonlinear_solution(small: Bench, zero_order: bool) -> None:
    """Full sensitivities to the solution; constant ones close to it."""
    state = near_the_target(small)
    wanted = FullNmpc(small.step, small.links, small.inertia).decide(state, *KNOWN).torque
    rti = RealTimeIteration(small.step, small.links, small.inertia, zero_order)
    for _ in range(6):
        found = rti.decide(state, *KNOWN)
        assert found.status is Status.OK
        rti._plan = np.insert(rti._plan, 0, 0.0, axis=1)[:, :-1]  # what the next call shifts away
    assert found.torque == pytest.approx(wanted, abs=1e-2 if zero_order else 2e-3)


def test_linear_and_nonlinear_agree_near_the_target(bench: Bench) -> None:
    state, known = near_the_target(bench), (np.array([0.05]), np.array([0.1]))
    linear = LinearMpc(bench.links, bench.problem, bench.inertia)
    off = linear.decide(state - bench.step.straight(1.0), *known).torque
    rti = RealTimeIteration(bench.step, bench.links, bench.inertia)
    rti.decide(state, *known)
    assert off == pytest.approx(rti.decide(state, *known).torque, abs=0.02)


def test_a_delay_of_whole_samples_only_shifts_the_plan(bench: Bench) -> None:
    """Two samples late, the torque is that of the state two samples ahead."""
    problem = dataclasses.replace(bench.problem, delay=0.04)
    model = dataclasses.replace(bench.modes, delay=dataclasses.replace(bench.modes.delay, whole=2, acting=2))
    late = LinearMpc(model, problem, bench.inertia)
    late._past = np.array([[0.0], [0.5], [-0.4], [1.0]])[-late.delay.memory - 1 :]
    state = 0.05 * np.ones(model.size)
    late.estimator.estimate = np.append(state, 0.1)  # type: ignore[attr-defined]
    ahead, disturbance = late.estimator.ahead(late.delay.known(late._past))
    expected = state
    for torque in late._past[-2:]:
        expected = model.transition @ expected + model.drive @ (torque + 0.1)
    assert_allclose(ahead, expected, rtol=1e-12)
    assert disturbance == pytest.approx(0.1)


@pytest.mark.parametrize(
    "kind", [kind for kind in CONTROLLERS if kind.name != "nmpc"], ids=lambda kind: kind.name
)
def test_bad_measurements_are_said_and_survived(bench: Bench, kind: object) -> None:
    controller = kind.make(bench)  # type: ignore[attr-defined]
    good = np.array([0.0, 0.0, np.nan])
    first = controller.command(good)
    assert first.status is Status.OK
    for spoilt in (np.nan, np.inf):
        command = controller.command(np.array([spoilt, 0.0, np.nan]))
        assert command.status is Status.MEASUREMENT
        assert -3.0 <= command.torque <= 3.0
    for _ in range(3):
        after = controller.command(good)
    assert after.status is Status.OK
    controller.reset()
    assert controller.command(good).torque == first.torque


def test_estimates_beyond_all_bounds_end_in_the_safe_law(bench: Bench) -> None:
    mpc = LinearMpc(bench.modes, bench.problem, bench.inertia)
    for value in (1e300, -1e300, 1e300):
        command = mpc.command(np.array([value, -value, np.nan]))
        assert np.isfinite(command.torque)
        assert abs(command.torque) <= 3.0
    assert command.status is not Status.OK
