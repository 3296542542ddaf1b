"""Nonlinear model predictive control to convergence, by CasADi: the reference of the real-time iterations.

Multiple shooting, stage by stage: ``(u_k, s_k, r_k)`` and the state after it, with the last torque as one more state
where its changes are bounded or weighed. fatrop exploits the stages (L. Vanroye, A. Sathya, J. De Schutter, W. Decre,
FATROP, 2023); IPOPT takes the same problem as a sparse one.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.command import Command, Status
from tmm_gen.control.extended_kalman import ExtendedKalmanFilter
from tmm_gen.control.linear import LinearModel
from tmm_gen.control.links import rest_state
from tmm_gen.control.model_based import ModelBased
from tmm_gen.control.step_model import StepModel
from tmm_gen.control.terminal import end_rows

Array = NDArray[np.float64]
Solver = Literal["fatrop", "ipopt"]

_OPTIONS: dict[str, dict[str, Any]] = {
    "fatrop": {
        "structure_detection": "auto",
        "expand": True,
        "print_time": False,
        "fatrop": {"print_level": 0, "tol": 1e-10, "max_iter": 200},
    },
    "ipopt": {
        "expand": True,
        "print_time": False,
        "ipopt": {"print_level": 0, "sb": "yes", "tol": 1e-10, "max_iter": 200},
    },
}


@dataclass(frozen=True, eq=False)
class _Stages:
    """The nonlinear programme as CasADi takes it, and its bounds."""

    problem: dict[str, Any]
    equality: list[bool]
    low: Array
    high: Array
    low_rows: Array
    high_rows: Array


class FullNmpc(ModelBased):
    """Solves the nonlinear problem to convergence at every sample.

    Parameters
    ----------
    model : StepModel
        The generated step.
    linear : LinearModel
        Of the same step about the target.
    inertia : float
        Of hub and arm about the hub, kg m^2, for the safe law.
    solver : {"fatrop", "ipopt"}
        What solves it.
    """

    def __init__(
        self, model: StepModel, linear: LinearModel, inertia: float, solver: Solver = "fatrop"
    ) -> None:
        self.model, self.linear, self.solver = model, linear, solver
        self._guess: Array | None = None
        super().__init__(model.problem, ExtendedKalmanFilter(model, linear), model.delay, inertia)

    def _forget(self) -> None:
        self._guess = None

    @cached_property
    def width(self) -> int:
        """Variables of a stage: the state with the last torque, then torque and two slacks."""
        return self.model.size + 1 + 3

    @cached_property
    def stages(self) -> _Stages:
        """The nonlinear programme."""
        import casadi as ca

        problem, weights, size = self.problem, self.problem.weights, self.model.size
        count = problem.horizon
        state = [ca.MX.sym(f"x{k}", size + 1) for k in range(count + 1)]
        free = [ca.MX.sym(f"u{k}", 3) for k in range(count)]
        given = ca.MX.sym("given", size + 2)  # state, last torque, disturbance
        disturbance = given[size + 1]
        rows: list[Any] = [state[0] - given[: size + 1]]
        equality, low_rows, high_rows = [True] * (size + 1), [0.0] * (size + 1), [0.0] * (size + 1)
        cost: Any = 0.0
        for k in range(count):
            torque, change = free[k][0], free[k][0] - state[k][size]
            after = self.model.sample(state[k][:size], ca.vertcat(state[k][size], torque) + disturbance)
            rows.append(state[k + 1] - ca.vertcat(after, torque))
            equality += [True] * (size + 1)
            low_rows += [0.0] * (size + 1)
            high_rows += [0.0] * (size + 1)
            cost += 0.5 * weights.torque * (torque - self.linear.target_torque + disturbance) ** 2
            cost += 0.5 * weights.torque_step * change**2
            cost += 0.5 * (weights.overshoot * free[k][1] ** 2 + weights.hub_bound * free[k][2] ** 2)
            cost += 0.5 * self._stage_cost(after)
            tip, hub = self._row("tip", after), self._row("hub", after)
            more = [(tip, free[k][1], problem.tip), (hub, free[k][2], problem.hub)]
            for value, slack, bounds in more:
                for side in (0, 1) if bounds is not None else ():
                    assert bounds is not None
                    if np.isfinite(bounds[side]):
                        rows.append(value - slack if side else value + slack)
                        low_rows.append(-np.inf if side else bounds[0])
                        high_rows.append(bounds[1] if side else np.inf)
                        equality.append(False)
            if problem.torque_rate is not None:
                largest = problem.torque_rate * problem.sample_time
                rows.append(change)
                equality.append(False)
                low_rows.append(-largest)
                high_rows.append(largest)
        rest = np.append(rest_state(self.model, self.linear), self.linear.target_torque)
        left = state[-1] - rest + ca.vertcat(np.zeros(size), disturbance)
        cost += 0.5 * ca.sumsqr(ca.mtimes(end_rows(self.linear, weights), left))
        variables = [part for pair in zip(state, free, strict=False) for part in pair] + [state[-1]]
        low, high = np.full((count, self.width), -np.inf), np.full((count, self.width), np.inf)
        low[:, size + 1], high[:, size + 1] = problem.torque
        unbounded = np.full(size + 1, np.inf)
        return _Stages(
            {"x": ca.vertcat(*variables), "f": cost, "g": ca.vertcat(*rows), "p": given},
            equality,
            np.concatenate([low.ravel(), -unbounded]),
            np.concatenate([high.ravel(), unbounded]),
            np.array(low_rows),
            np.array(high_rows),
        )

    def _row(self, name: str, state: Any) -> Any:
        """Return an angle or a rate of a state."""
        import casadi as ca

        quantity = "rate" if name.endswith("rate") else "angle"
        row = self.model.mean_row(quantity) if name.startswith("tip") else self.model.hub_row(quantity)
        return ca.dot(ca.DM(row), state)

    def _stage_cost(self, state: Any) -> Any:
        weights = self.problem.weights
        return (
            weights.tip * (self._row("tip", state) - self.problem.reference) ** 2
            + weights.hub * (self._row("hub", state) - self.linear.target_hub) ** 2
            + weights.tip_rate * self._row("tip_rate", state) ** 2
            + weights.hub_rate * self._row("hub_rate", state) ** 2
        )

    @cached_property
    def function(self) -> Any:
        """The solver."""
        import casadi as ca

        options = dict(_OPTIONS[self.solver])
        if self.solver == "fatrop":
            options["equality"] = self.stages.equality
        return ca.nlpsol("nmpc", self.solver, self.stages.problem, options)

    def decide(self, state: Array, disturbance: float, last: float) -> Command:
        """Solve the nonlinear problem from the last solution shifted; see :class:`ModelBased`."""
        size, stages = self.model.size, self.stages
        guess = self._first(state, last) if self._guess is None else self._guess
        found = self.function(
            x0=guess,
            p=np.concatenate([state, [last, disturbance]]),
            lbx=stages.low,
            ubx=stages.high,
            lbg=stages.low_rows,
            ubg=stages.high_rows,
        )
        statistics = self.function.stats()
        point = np.array(found["x"]).ravel()
        iterations = int(statistics.get("iter_count", 0))
        if not np.all(np.isfinite(point)):
            self._guess = None
            return Command(0.0, Status.NOT_FINITE, iterations)
        if not statistics["success"]:
            self._guess = None
            return Command(0.0, Status.ITERATIONS, iterations)
        self._guess = np.concatenate([point[self.width :], point[-self.width :]])[: len(point)]
        return Command(float(point[size + 1]), Status.OK, iterations)

    def _first(self, state: Array, last: float) -> Array:
        """Return a first guess: the arm stays where it is."""
        stage = np.concatenate([state, [last, self.linear.target_torque, 0.0, 0.0]])
        return np.concatenate([np.tile(stage, self.problem.horizon), stage[: self.model.size + 1]])
