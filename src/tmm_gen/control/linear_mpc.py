"""Linear model predictive control: condensed, free of offset, delay compensated."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.command import Command
from tmm_gen.control.condensed import Condensed
from tmm_gen.control.following import Following
from tmm_gen.control.kalman import KalmanFilter
from tmm_gen.control.linear import LinearModel
from tmm_gen.control.model_based import ModelBased
from tmm_gen.control.problem import ControlProblem
from tmm_gen.control.qp import QuadraticProgram, Solution
from tmm_gen.control.response import response
from tmm_gen.control.terminal import end_rows
from tmm_gen.control.terms import Wanted

Array = NDArray[np.float64]


class LinearMpc(ModelBased):
    """Linear MPC with a Kalman filter; everything but a gradient and bounds is prepared once.

    Parameters
    ----------
    model : LinearModel
        By links or by modes.
    problem : ControlProblem
        What is to be solved at each sample.
    inertia : array, (m,)
        What each motor turns, kg m^2, for the safe law.
    """

    def __init__(self, model: LinearModel, problem: ControlProblem, inertia: Array) -> None:
        self.model = model
        self.end = end_rows(model, problem.weights)
        self.response = response(model, problem.horizon, self.end)
        self.following = Following(model, problem.sample_time)
        self.condensed = Condensed(problem, self.response.slopes, model.goal)
        still = np.zeros(problem.count)
        targets = np.repeat(np.concatenate([model.goal.tip, still, model.goal.hub, still]), problem.horizon)
        self.offsets = np.concatenate([targets, np.zeros(len(self.response.slopes.end))])
        self._program = QuadraticProgram.of(self.condensed)
        super().__init__(problem, KalmanFilter(model, problem), model.delay, inertia)

    def _forget(self) -> None:
        self._program.forget()

    def decide(self, state: Array, disturbance: Array, last: Array) -> Command:
        """Solve the quadratic program about no torque at all; see :class:`ModelBased`."""
        solution = self.planned(state, disturbance, last)
        if not solution.status.optimal:
            return Command(np.zeros(self.problem.count), solution.status, solution.iterations)
        first = solution.point[: self.condensed.inputs : self.problem.horizon]
        return Command(first, solution.status, solution.iterations)

    def planned(self, state: Array, disturbance: Array, last: Array) -> Solution:
        """Return the torques over the horizon, and the slacks behind them, with arguments as for :meth:`decide`."""
        made = self.response
        pushed = disturbance - self.model.goal.torque
        found = made.by_state @ state + made.by_constant @ pushed + made.by_last @ last
        along = made.outputs(found + self.offsets)
        nothing = np.zeros((self.problem.count, self.problem.horizon))
        return self._program.solve_softly(
            self.condensed.gradient(along, nothing, last, disturbance, self._wanted()),
            *self.condensed.bounds(
                along, nothing, last, without=("tip",) if self._window else (), torque=self.problem.torque
            ),
            soft=self.condensed.soft,
        )

    def _wanted(self) -> Wanted | None:
        """Return what is wanted over the horizon, if anything but rest at the target."""
        if self._window is None:
            return None
        first = self.delay.whole + self._passed
        return self.following.wanted(self._window, first, self.problem.horizon, self.end)
