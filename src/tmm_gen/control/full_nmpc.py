"""Nonlinear model predictive control to convergence, by CasADi: the reference of the real-time iterations.

Multiple shooting, stage by stage: ``(u_k, s_k, r_k)`` of all motors and the state after it, with the last torques as
more states, since their changes are weighed. fatrop exploits the stages (L. Vanroye, A. Sathya, J. De Schutter,
W. Decre, FATROP, 2023); IPOPT takes the same problem as a sparse one.
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
from tmm_gen.control.where import where
from tmm_gen.errors import UserError

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
    inertia : array, (m,)
        What each motor turns, kg m^2, for the safe law.
    solver : {"fatrop", "ipopt"}
        What solves it.

    Raises
    ------
    UserError
        If rates of hubs are bounded.
    """

    def __init__(
        self, model: StepModel, linear: LinearModel, inertia: Array, solver: Solver = "fatrop"
    ) -> None:
        self.model, self.linear, self.solver = model, linear, solver
        if np.any(np.isfinite(model.problem.hub_rate)):
            raise UserError(
                f"{where(model.scene, 'control.bounds.hub_rate')}: the controller 'nmpc' does not keep "
                "it; take 'rti', or remove the key."
            )
        self._guess: Array | None = None
        super().__init__(model.problem, ExtendedKalmanFilter(model, linear), model.delay, inertia)

    def _forget(self) -> None:
        self._guess = None

    @cached_property
    def width(self) -> int:
        """Variables of a stage: the state with the last torques, then torques and two slacks of each motor."""
        return self.model.size + 4 * self.problem.count

    @cached_property
    def stages(self) -> _Stages:
        """The nonlinear programme."""
        import casadi as ca

        problem, size = (
            self.model.problem,
            self.model.size,
        )  # its bounds are the scene's, whatever was told since
        weights = problem.weights
        count, motors, goal = problem.horizon, problem.count, self.linear.goal
        wide = size + motors
        state = [ca.MX.sym(f"x{k}", wide) for k in range(count + 1)]
        free = [ca.MX.sym(f"u{k}", 3 * motors) for k in range(count)]
        given = ca.MX.sym("given", wide + motors)  # state, last torques, disturbances
        disturbance = given[wide:]
        acting = ca.vertcat(disturbance, disturbance)
        rows: list[Any] = [state[0] - given[:wide]]
        equality, low_rows, high_rows = [True] * wide, [0.0] * wide, [0.0] * wide
        cost: Any = 0.0
        for k in range(count):
            torque, slacks = (
                free[k][:motors],
                {"tip": free[k][motors : 2 * motors], "hub": free[k][2 * motors :]},
            )
            change = torque - state[k][size:]
            after = self.model.sample(state[k][:size], ca.vertcat(state[k][size:], torque) + acting)
            rows.append(state[k + 1] - ca.vertcat(after, torque))
            equality += [True] * wide
            low_rows += [0.0] * wide
            high_rows += [0.0] * wide
            cost += 0.5 * _weighed(weights.torque, torque - goal.torque + disturbance)
            cost += 0.5 * _weighed(weights.torque_step, change)
            cost += 0.5 * _weighed(weights.overshoot, slacks["tip"])
            cost += 0.5 * _weighed(weights.hub_bound, slacks["hub"])
            cost += 0.5 * self._stage_cost(after)
            for kind in problem.kinds(goal):
                if kind.what == "rate":
                    rows.append(change[kind.motor])
                    equality.append(False)
                    low_rows.append(kind.low)
                    high_rows.append(kind.high)
                    continue
                value, slack = self._angles(kind.what, after)[kind.motor], slacks[kind.what][kind.motor]
                for bound, upper in ((kind.low, False), (kind.high, True)):
                    if np.isfinite(bound):
                        rows.append(value - slack if upper else value + slack)
                        low_rows.append(-np.inf if upper else bound)
                        high_rows.append(bound if upper else np.inf)
                        equality.append(False)
        rest = np.append(rest_state(self.model, self.linear), goal.torque)
        left = state[-1] - rest + ca.vertcat(np.zeros(size), disturbance)
        cost += 0.5 * ca.sumsqr(ca.mtimes(end_rows(self.linear, weights), left))
        variables = [part for pair in zip(state, free, strict=False) for part in pair] + [state[-1]]
        low, high = np.full((count, self.width), -np.inf), np.full((count, self.width), np.inf)
        low[:, wide : wide + motors], high[:, wide : wide + motors] = problem.torque
        unbounded = np.full(wide, np.inf)
        return _Stages(
            {"x": ca.vertcat(*variables), "f": cost, "g": ca.vertcat(*rows), "p": given},
            equality,
            np.concatenate([low.ravel(), -unbounded]),
            np.concatenate([high.ravel(), unbounded]),
            np.array(low_rows),
            np.array(high_rows),
        )

    def _angles(self, name: str, state: Any) -> Any:
        """Return the angles of a state's tips or hubs, or their rates, (m,)."""
        import casadi as ca

        motors = self.model.motors
        rows = motors.tip if name.startswith("tip") else motors.hub
        return ca.mtimes(ca.DM(self.model.rows(rows, "rate" if name.endswith("rate") else "angle")), state)

    def _stage_cost(self, state: Any) -> Any:
        weights, goal = self.problem.weights, self.linear.goal
        return (
            _weighed(weights.tip, self._angles("tip", state) - goal.tip)
            + _weighed(weights.hub, self._angles("hub", state) - goal.hub)
            + _weighed(weights.tip_rate, self._angles("tip_rate", state))
            + _weighed(weights.hub_rate, self._angles("hub_rate", state))
        )

    @cached_property
    def function(self) -> Any:
        """The solver."""
        import casadi as ca

        options = dict(_OPTIONS[self.solver])
        if self.solver == "fatrop":
            options["equality"] = self.stages.equality
        return ca.nlpsol("nmpc", self.solver, self.stages.problem, options)

    def decide(self, state: Array, disturbance: Array, last: Array) -> Command:
        """Solve the nonlinear problem from the last solution shifted; see :class:`ModelBased`."""
        size, count, stages = self.model.size, self.problem.count, self.stages
        none = np.zeros(count)
        guess = self._first(state, last) if self._guess is None else self._guess
        found = self.function(
            x0=guess,
            p=np.concatenate([state, last, disturbance]),
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
            return Command(none, Status.NOT_FINITE, iterations)
        if not statistics["success"]:
            self._guess = None
            return Command(none, Status.ITERATIONS, iterations)
        self._guess = np.concatenate([point[self.width :], point[-self.width :]])[: len(point)]
        return Command(point[size + count : size + 2 * count], Status.OK, iterations)

    def _first(self, state: Array, last: Array) -> Array:
        """Return a first guess: the arm stays where it is."""
        count = self.problem.count
        stage = np.concatenate([state, last, self.linear.goal.torque, np.zeros(2 * count)])
        return np.concatenate([np.tile(stage, self.problem.horizon), stage[: self.model.size + count]])


def _weighed(weights: Array, values: Any) -> Any:
    """Return the weighed sum of squares."""
    import casadi as ca

    return ca.dot(ca.DM(weights), values**2)
