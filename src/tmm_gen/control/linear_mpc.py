"""Linear model predictive control: condensed, free of offset, delay compensated."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.command import Command
from tmm_gen.control.condensed import Condensed
from tmm_gen.control.kalman import KalmanFilter
from tmm_gen.control.linear import LinearModel
from tmm_gen.control.model_based import ModelBased
from tmm_gen.control.problem import ControlProblem
from tmm_gen.control.qp import QuadraticProgram, Solution
from tmm_gen.control.response import response
from tmm_gen.control.terminal import end_rows

Array = NDArray[np.float64]


class LinearMpc(ModelBased):
    """Linear MPC with a Kalman filter; everything but a gradient and bounds is prepared once.

    Parameters
    ----------
    model : LinearModel
        By links or by modes.
    problem : ControlProblem
        What is to be solved at each sample.
    inertia : float
        Of hub and arm about the hub, kg m^2, for the safe law.
    """

    def __init__(self, model: LinearModel, problem: ControlProblem, inertia: float) -> None:
        self.model = model
        self.response = response(model, problem.horizon, end_rows(model, problem.weights))
        self.condensed = Condensed(problem, self.response.slopes, model.target_hub, model.target_torque)
        targets = np.repeat([problem.reference, 0.0, model.target_hub, 0.0], problem.horizon)
        self.offsets = np.concatenate([targets, np.zeros(len(self.response.slopes.end))])
        self._program = QuadraticProgram(self.condensed.hessian, self.condensed.rows, problem.horizon)
        super().__init__(problem, KalmanFilter(model, problem), model.delay, inertia)

    def _forget(self) -> None:
        self._program.forget()

    def decide(self, state: Array, disturbance: float, last: float) -> Command:
        """Solve the quadratic program about no torque at all; see :class:`ModelBased`."""
        solution = self.planned(state, disturbance, last)
        torque = float(solution.point[0]) if solution.status.optimal else 0.0
        return Command(torque, solution.status, solution.iterations)

    def planned(self, state: Array, disturbance: float, last: float) -> Solution:
        """Return the torques over the horizon, and the slacks behind them, with arguments as for :meth:`decide`."""
        pushed = disturbance - self.model.target_torque
        found = self.response.by_state @ state + self.response.by_constant * pushed
        along = self.response.outputs(found + self.response.by_last * last + self.offsets)
        nothing = np.zeros(self.problem.horizon)
        return self._program.solve_softly(
            self.condensed.gradient(along, nothing, last, disturbance),
            *self.condensed.bounds(along, nothing, last),
            soft=self.condensed.soft,
        )
