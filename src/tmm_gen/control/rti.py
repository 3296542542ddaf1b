"""Nonlinear model predictive control by real-time iteration: one condensed quadratic program per sample.

M. Diehl, H. G. Bock, J. P. Schloeder, A real-time iteration scheme for nonlinear optimization in optimal feedback
control, SIAM J. Control Optim. 43 (2005). Zero-order: H. G. Bock, M. Diehl, E. Kostina, J. P. Schloeder, Constrained
optimal feedback control of systems governed by large differential algebraic equations (2007), level C.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.command import Command
from tmm_gen.control.condensed import Condensed, Outputs
from tmm_gen.control.extended_kalman import ExtendedKalmanFilter, NonlinearFilter
from tmm_gen.control.linear import LinearModel
from tmm_gen.control.links import rest_state
from tmm_gen.control.model_based import ModelBased
from tmm_gen.control.qp import QuadraticProgram
from tmm_gen.control.response import response
from tmm_gen.control.step_model import StepModel
from tmm_gen.control.terminal import end_rows

Array = NDArray[np.float64]


class RealTimeIteration(ModelBased):
    """Nonlinear MPC, one iteration per sample, warm-started by the last solution shifted.

    Parameters
    ----------
    model : StepModel
        The generated step.
    linear : LinearModel
        Of the same step about the target.
    inertia : float
        Of hub and arm about the hub, kg m^2, for the safe law.
    zero_order : bool
        Whether to keep the sensitivities of the linear model, and its filter's gain, instead of computing those
        along the trajectory.
    """

    def __init__(
        self, model: StepModel, linear: LinearModel, inertia: float, zero_order: bool = False
    ) -> None:
        problem = model.problem
        self.model, self.linear, self.zero_order = model, linear, zero_order
        self.end = end_rows(linear, problem.weights)
        slopes = response(linear, problem.horizon, self.end).slopes
        self.prepared = Condensed(problem, slopes, linear.target_hub, linear.target_torque)
        kind = NonlinearFilter if zero_order else ExtendedKalmanFilter
        self._program = QuadraticProgram(self.prepared.hessian, self.prepared.rows, problem.horizon)
        super().__init__(problem, kind(model, linear), model.delay, inertia)

    @cached_property
    def rows(self) -> Array:
        """Rows that give tip, tip rate, hub, hub rate from the state, (4, m)."""
        model = self.model
        return np.array(
            [model.mean_row("angle"), model.mean_row("rate"), model.hub_row("angle"), model.hub_row("rate")]
        )

    @property
    def target(self) -> Array:
        """The state at the target, (m,)."""
        return rest_state(self.model, self.linear)

    def _forget(self) -> None:
        self._program.forget()
        self._plan = np.full(self.problem.horizon, self.linear.target_torque)

    def decide(self, state: Array, disturbance: float, last: float) -> Command:
        """Solve one quadratic program about the last plan; see :class:`ModelBased`."""
        low, high = self.problem.torque
        plan = np.clip(np.append(self._plan[1:], self._plan[-1]), low, high)
        inputs = np.vstack([np.append(last, plan[:-1]), plan]) + disturbance
        states = np.array(self.model.rollout(state, inputs))
        left = np.append(states[:, -1] - self.target, inputs[1, -1] - self.linear.target_torque)
        tip, tip_rate, hub, hub_rate = self.rows @ states
        along = Outputs(tip, tip_rate, hub, hub_rate, self.end @ left)
        condensed = self.prepared if self.zero_order else self._linearised(state, states, inputs)
        renewed = condensed is not self.prepared
        solution = self._program.solve_softly(
            condensed.gradient(along, plan, last, disturbance),
            *condensed.bounds(along, plan, last, self.prepared.stopping),
            soft=condensed.soft,
            hessian=condensed.hessian if renewed else None,
            rows=condensed.rows if renewed else None,
        )
        if not solution.status.optimal:
            self._plan = np.full(len(plan), np.clip(self.linear.target_torque - disturbance, low, high))
            return Command(0.0, solution.status, solution.iterations)
        self._plan = plan + solution.point[: len(plan)]
        return Command(float(self._plan[0]), solution.status, solution.iterations)

    def _linearised(self, state: Array, states: Array, inputs: Array) -> Condensed:
        """Return the quadratic program with sensitivities along a trajectory."""
        count, size = inputs.shape[1], len(state)
        points = np.column_stack([state, states[:, :-1]])
        _, by_state, by_torques = self.model.rollout_slopes(points, inputs)
        transitions = np.array(by_state).reshape(size, count, size).transpose(1, 0, 2)
        drives = np.array(by_torques).reshape(size, count, 2)
        slopes = np.zeros((4, count, count))
        carried = np.zeros((size, count))
        for stage in range(count):
            carried = transitions[stage] @ carried
            if stage:
                carried[:, stage - 1] += drives[:, stage, 0]
            carried[:, stage] += drives[:, stage, 1]
            slopes[:, stage] = self.rows @ carried
        left = np.vstack([carried, np.eye(1, count, count - 1)])
        tip, tip_rate, hub, hub_rate = slopes
        found = Outputs(tip, tip_rate, hub, hub_rate, self.end @ left)
        return Condensed(self.problem, found, self.linear.target_hub, self.linear.target_torque)
