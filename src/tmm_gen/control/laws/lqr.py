"""Linear-quadratic regulator: the baseline that knows the model but no bounds."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.command import Command
from tmm_gen.control.estimators.kalman import KalmanFilter
from tmm_gen.control.laws.following import Following
from tmm_gen.control.laws.model_based import ModelBased
from tmm_gen.control.prediction.linear import LinearModel
from tmm_gen.control.task.problem import ControlProblem
from tmm_gen.control.task.unsaid import REGULATOR_TORQUE, Told
from tmm_gen.scene.control import RegulatorWeights
from tmm_gen.scene.each import by_names

Array = NDArray[np.float64]


class Regulator(ModelBased):
    """``u = u_s - d - K x``, clipped; with the estimator and the look ahead that linear MPC has.

    Parameters
    ----------
    model : LinearModel
        By links or by modes.
    problem : ControlProblem
        Sample time, sensors, bounds.
    weights : RegulatorWeights
        Of the infinite-horizon cost.
    inertia : array, (m,)
        What each motor turns, kg m^2, for the safe law.
    """

    def __init__(
        self, model: LinearModel, problem: ControlProblem, weights: RegulatorWeights, inertia: Array
    ) -> None:
        from scipy.linalg import solve_discrete_are  # slow to import

        self.model = model
        hub, tip_rate, hub_rate = (
            np.array(by_names(value, problem.motors.names))
            for value in (weights.hub, weights.tip_rate, weights.hub_rate)
        )
        torque = Told.by(problem.motors, problem.torque).of(weights.torque, REGULATOR_TORQUE)
        cost = model.weighed(np.ones(model.count), hub, tip_rate, hub_rate)
        a, b = model.transition, model.drive
        price = np.diag(torque)
        value = solve_discrete_are(a, b, cost, price)
        self.gain = np.linalg.solve(price + b.T @ value @ b, b.T @ value @ a)
        self.following = Following(model, problem.sample_time)
        super().__init__(problem, KalmanFilter(model, problem), model.delay, inertia)

    def _forget(self) -> None:
        """Do nothing: this one plans nothing."""

    def decide(self, state: Array, disturbance: Array, last: Array) -> Command:
        """Return the torques of the linear law; see :class:`ModelBased`."""
        if self._window is None:
            return Command(self.model.goal.torque - disturbance - self.gain @ state)
        place = self.delay.whole + self._passed - 1
        motion = self._window.at(place) if place >= 0 else self._window.before(self.problem.sample_time)
        wanted, torque = self.following.at(motion)
        return Command(torque - disturbance - self.gain @ (state - wanted))
