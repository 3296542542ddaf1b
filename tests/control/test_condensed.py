"""The condensed quadratic program says what the problem says."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tmm_gen.control.bench import Bench
from tmm_gen.control.prediction.linear import LinearModel
from tmm_gen.control.quadratic.condensed import Condensed, Outputs
from tmm_gen.control.quadratic.response import response
from tmm_gen.control.task.problem import ControlProblem
from tmm_gen.control.task.terms import Goal


def predicted(model: LinearModel, problem: ControlProblem, state: np.ndarray, torques: np.ndarray, last: float,
              disturbance: float) -> tuple[np.ndarray, np.ndarray]:  # fmt: skip
    """Step a linear model through the horizon; tip, tip rate, hub, hub rate, (4, N), and what is left, (s + 1,)."""
    found = []
    for before, then in zip(np.append(last, torques[:-1]), torques, strict=True):
        pushed = disturbance - model.goal.torque
        state = model.transition @ state + model.before @ (before + pushed) + model.then @ (then + pushed)
        rows = (model.tip, model.tip_rate, model.hub, model.hub_rate)
        found.append(np.concatenate([row @ state for row in rows]))
    offsets = np.array([*problem.reference, 0.0, *model.goal.hub, 0.0])
    left = np.append(state, torques[-1] + disturbance - model.goal.torque)
    return (np.array(found) + offsets).T, left


def stated_cost(problem: ControlProblem, model: LinearModel, outputs: np.ndarray, torques: np.ndarray,
                last: float, disturbance: float, slack: np.ndarray) -> float:  # fmt: skip
    """The cost, term by term as the problem states it."""
    weights, total = problem.weights, 0.0
    weights = dataclasses.replace(weights, **{key: value[0] for key, value in vars(weights).items()})
    reference, target_hub, target_torque = problem.reference[0], model.goal.hub[0], model.goal.torque[0]
    tip, tip_rate, hub, hub_rate = outputs
    for k in range(problem.horizon):
        total += 0.5 * weights.tip * (tip[k] - reference) ** 2
        total += 0.5 * weights.hub * (hub[k] - target_hub) ** 2
        total += 0.5 * (weights.tip_rate * tip_rate[k] ** 2 + weights.hub_rate * hub_rate[k] ** 2)
        change = torques[k] - (torques[k - 1] if k else last)
        total += 0.5 * weights.torque * (torques[k] - target_torque + disturbance) ** 2
        total += 0.5 * weights.torque_step * change**2
        total += 0.5 * (weights.overshoot * slack[0, k] ** 2 + weights.hub_bound * slack[1, k] ** 2)
    return total


def test_cost_and_rows_are_those_of_the_problem(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tmm_gen.control.quadratic.condensed.BEYOND", np.inf)  # no bound gives way
    problem = dataclasses.replace(bench.problem, torque_rate=np.array([40.0]), delay=0.027)
    model = dataclasses.replace(
        bench.modes,
        before=0.3 * bench.modes.then,
        then=0.7 * bench.modes.then,
        goal=Goal(np.ones(1), np.array([1.03]), np.array([0.2])),
    )
    random = np.random.default_rng(0)
    count, last, disturbance = problem.horizon, 0.4, -0.15
    state = 0.1 * random.standard_normal(model.size)
    along = random.uniform(-1.0, 1.0, count)
    end = random.standard_normal((3, model.size + 1))
    made = response(model, count, end)
    condensed = Condensed(problem, made.slopes, model.goal)
    start, left = predicted(model, problem, state, along, last, disturbance)
    at_start = Outputs(*start[:, None], end @ left)
    known = (at_start, along[None], np.array([last]))
    gradient = condensed.gradient(*known, np.array([disturbance]))
    low, high = condensed.bounds(*known)
    origin = stated_cost(problem, model, start, along, last, disturbance, np.zeros((2, count)))
    origin += 0.5 * np.sum((end @ left) ** 2)
    for _ in range(3):
        change, slack = random.uniform(-1.0, 1.0, count), random.uniform(0.0, 0.1, (2, count))
        torques, z = along + change, np.concatenate([change, *slack])
        outputs, left = predicted(model, problem, state, torques, last, disturbance)
        stated = stated_cost(problem, model, outputs, torques, last, disturbance, slack)
        stated += 0.5 * np.sum((end @ left) ** 2)
        quadratic = 0.5 * z @ condensed.hessian @ z + gradient @ z
        assert_allclose(quadratic, stated - origin, rtol=1e-9, atol=1e-9)
        changes = np.diff(torques, prepend=last)
        tip, hub = outputs[0], outputs[2]
        upper = [
            torques - 3.0,
            changes - 0.8,
            tip - slack[0] - 1.005,
            hub - slack[1] - problem.hub[0][1],
        ]
        lower = [torques + 3.0, changes + 0.8, hub + slack[1] - problem.hub[0][0]]
        rows = np.concatenate([z[:count], condensed.rows @ z])
        assert_allclose(np.sort((rows - high)[np.isfinite(high)]), np.sort(np.concatenate(upper)), atol=1e-9)
        assert_allclose(np.sort((rows - low)[np.isfinite(low)]), np.sort(np.concatenate(lower)), atol=1e-9)


def test_the_free_response_is_the_models(bench: Bench) -> None:
    model, problem = bench.links, bench.problem
    random = np.random.default_rng(1)
    state, torques = 0.1 * random.standard_normal(model.size), random.uniform(-3.0, 3.0, problem.horizon)
    end = np.eye(model.size + 1)
    made = response(model, problem.horizon, end)
    found = made.by_state @ state + made.by_constant @ (0.3 - model.goal.torque) + made.by_last @ [0.7]
    slopes = (made.slopes.tip, made.slopes.tip_rate, made.slopes.hub, made.slopes.hub_rate, made.slopes.end)
    found += np.concatenate([(slope @ torques).ravel() for slope in slopes])
    shown = made.outputs(found)
    outputs, left = predicted(model, problem, state, torques, 0.7, 0.3)
    targets = np.array([*problem.reference, 0.0, *model.goal.hub, 0.0])[:, None]
    together = np.vstack([shown.tip, shown.tip_rate, shown.hub, shown.hub_rate]) + targets
    assert_allclose(together, outputs, rtol=1e-9, atol=1e-9)
    assert_allclose(shown.end, left, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize(
    ("tip", "rate", "given_way"), [(1.0, 0.0, False), (1.2, 0.0, True), (0.9, 0.01, False), (0.9, 0.2, True)]
)
def test_soft_bounds_give_way_where_the_arm_passes_them_anyway(
    bench: Bench, tip: float, rate: float, given_way: bool
) -> None:
    """Far beyond, or so fast (rad per sample) that no brake helps."""
    problem, model = bench.problem, bench.modes
    made = response(model, problem.horizon, np.zeros((1, model.size + 1)))
    condensed = Condensed(problem, made.slopes, model.goal)
    way = tip + rate * np.arange(problem.horizon)
    hub = np.full(problem.horizon, 0.5)
    along = Outputs(*(each[None] for each in (way, 0.0 * way, hub, 0.0 * way)), np.zeros(1))
    _, high = condensed.bounds(along, 0.0 * way[None], np.zeros(1))
    soft = high[condensed.soft]
    assert np.all(np.isinf(soft[: problem.horizon])) == given_way
    assert np.isfinite(soft[problem.horizon : 2 * problem.horizon]).all()
