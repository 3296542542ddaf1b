"""The cost to go is what the cost would go on to: the horizon makes no difference where no bound is met."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tmm_gen.control.bench import Bench
from tmm_gen.control.laws.lqr import Regulator
from tmm_gen.control.prediction.linear import LinearModel
from tmm_gen.control.quadratic.condensed import Condensed
from tmm_gen.control.quadratic.response import response
from tmm_gen.control.quadratic.terminal import cost_to_go, end_rows
from tmm_gen.control.task.problem import ControlProblem
from tmm_gen.scene.control import RegulatorWeights


def unbounded(model: LinearModel, problem: ControlProblem, state: np.ndarray, last: float,
              end: np.ndarray) -> tuple[float, float]:  # fmt: skip
    """First torque and cost of the best torques without bounds."""
    problem = dataclasses.replace(problem, tip=(None,), hub=(None,), torque_rate=np.array([np.inf]))
    count = problem.horizon
    made = response(model, count, end)
    condensed = Condensed(problem, made.slopes, model.goal)
    targets = np.repeat([*problem.reference, 0.0, *model.goal.hub, 0.0], count)
    offsets = np.concatenate([targets, np.zeros(len(end))])
    nothing, before = np.zeros((1, count)), np.array([last])
    along = made.outputs(made.by_state @ state + made.by_last @ before + offsets)
    gradient = condensed.gradient(along, nothing, before, model.goal.torque)
    torques = -np.linalg.solve(condensed.hessian, gradient)
    errors = made.by_state @ state + made.by_last @ before
    weights = problem.weights
    per_row = np.repeat(np.hstack([weights.tip, weights.tip_rate, weights.hub, weights.hub_rate]), count)
    per_row = np.concatenate([per_row, np.ones(len(end))])
    alone = 0.5 * np.sum(per_row * errors**2) + 0.5 * weights.torque_step[0] * last**2
    return float(torques[0]), float(alone + 0.5 * gradient @ torques)


@pytest.mark.parametrize("which", ["links", "modes"])
@pytest.mark.parametrize("late", [0.0, 0.013])
def test_every_horizon_gives_the_same(bench: Bench, which: str, late: float) -> None:
    """Two samples with the cost to go, thirty with it, four hundred without."""
    told = Bench(bench.scene, dataclasses.replace(bench.problem, delay=late))
    model: LinearModel = getattr(told, which)
    state = 0.05 * np.random.default_rng(2).standard_normal(model.size)
    state /= np.maximum(1.0, np.abs(model.transition).max(axis=0))  # no accelerations of thousands
    end = end_rows(model, told.problem.weights)
    found = [
        unbounded(model, dataclasses.replace(told.problem, horizon=horizon), state, 0.3, rows)
        for horizon, rows in ((2, end), (30, end), (400, np.zeros((0, model.size + 1))))
    ]
    assert_allclose(found[0], found[2], rtol=1e-6)
    assert_allclose(found[1], found[2], rtol=1e-6)


def test_it_is_that_of_a_regulator_where_changes_of_torque_cost_nothing(bench: Bench) -> None:
    free = dataclasses.replace(bench.problem.weights, torque_step=np.array([1e-12]))
    problem = dataclasses.replace(bench.problem, weights=free)
    rest = RegulatorWeights(
        **{name: float(getattr(free, name)[0]) for name in ("hub", "tip_rate", "hub_rate", "torque")}
    )
    regulator = Regulator(bench.modes, problem, rest, bench.inertia)
    state = 1e-3 * np.random.default_rng(3).standard_normal(bench.modes.size)
    torque, _ = unbounded(bench.modes, problem, state, 0.0, end_rows(bench.modes, free))
    assert torque == pytest.approx(-float(regulator.gain[0] @ state), rel=1e-6)


def test_rows_make_the_whole_cost(bench: Bench) -> None:
    """Of the kernel's state a third is no state: accelerations follow from the rest."""
    weights = bench.problem.weights
    for model, rank in (
        (bench.links, 2 * (bench.scene.stations + 1) + 1),
        (bench.modes, bench.modes.size + 1),
    ):
        value, rows = cost_to_go(model, weights), end_rows(model, weights)
        assert rank - 1 <= len(rows) <= rank
        assert_allclose(rows.T @ rows, value, atol=1e-9 * np.abs(value).max())
