"""Kalman filters on the nonlinear model: with its covariance, or at the gain of the target."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.delay import Pair
from tmm_gen.control.kalman import KalmanFilter
from tmm_gen.control.linear import LinearModel
from tmm_gen.control.step_model import StepModel

Array = NDArray[np.float64]


class NonlinearFilter:
    """Predicts by the generated step, corrects at the stationary gain of the target: cheap, and right near it.

    Parameters
    ----------
    model : StepModel
        The generated step.
    linear : LinearModel
        Of the same step about the target.
    """

    def __init__(self, model: StepModel, linear: LinearModel) -> None:
        self.model = model
        stationary = KalmanFilter(linear, model.problem)
        self.gain, self.sensors = stationary.gain, stationary.sensors
        self.reset()

    def reset(self) -> None:
        """Start from the scene's initial motion."""
        self.estimate = np.append(self.model.initial(), 0.0)

    def correct(self, measured: Array) -> None:
        """Take a measurement in, (3,), NaN where there is no sensor."""
        seen = np.array(self.model.sensors(self.estimate[:-1])).ravel()
        self.estimate = self.estimate + self.gain @ (measured - seen)[self.sensors]

    def advance(self, torques: Pair, end: float) -> None:
        """Predict a sample with the torques that act in it, and the one at its end, N m."""
        self.estimate = self._after(self.estimate, torques)

    def ahead(self, torques: list[Pair]) -> tuple[Array, float]:
        """Return state, (m,), and disturbance, N m, after some more samples."""
        estimate = self.estimate
        for pair in torques:
            estimate = self._after(estimate, pair)
        return estimate[:-1], float(estimate[-1])

    def finite(self) -> bool:
        """Return whether the estimate can be used."""
        return bool(np.all(np.isfinite(self.estimate)))

    def _after(self, estimate: Array, torques: Pair) -> Array:
        after = np.array(self.model.sample(estimate[:-1], np.array(torques) + estimate[-1])).ravel()
        return np.append(after, estimate[-1])


class ExtendedKalmanFilter(NonlinearFilter):
    """Extended Kalman filter: linearises the generated step at every estimate.

    Parameters
    ----------
    model : StepModel
        The generated step.
    linear : LinearModel
        Of the same step about the target; its filter's covariance is where this one starts.
    """

    def __init__(self, model: StepModel, linear: LinearModel) -> None:
        self._stationary = KalmanFilter(linear, model.problem)
        super().__init__(model, linear)

    def reset(self) -> None:
        """Start from the scene's initial motion."""
        super().reset()
        self.covariance = self._stationary.covariance

    def correct(self, measured: Array) -> None:
        """Take a measurement in, (3,), NaN where there is no sensor."""
        seen, by_state = (np.array(item) for item in self.model.sensor_slopes(self.estimate[:-1]))
        measure = np.column_stack([by_state, np.zeros(3)])[self.sensors]
        product = measure @ self.covariance
        gain = np.linalg.solve(product @ measure.T + self._stationary.noise, product).T
        self.estimate = self.estimate + gain @ (measured - seen.ravel())[self.sensors]
        self.covariance = self.covariance - gain @ product

    def advance(self, torques: Pair, end: float) -> None:
        """Predict a sample with the torques that act in it, and the one at its end, N m."""
        acting = np.array(torques) + self.estimate[-1]
        after, by_state, by_torques = (
            np.array(item) for item in self.model.sample_slopes(self.estimate[:-1], acting)
        )
        drive = by_torques.sum(axis=1)
        transition = np.eye(len(self.estimate))
        transition[:-1, :-1], transition[:-1, -1] = by_state, drive
        self.estimate = np.append(after.ravel(), self.estimate[-1])
        spread = transition @ self.covariance @ transition.T
        self.covariance = 0.5 * (spread + spread.T) + self._stationary.driven(np.append(drive, 0.0))

    def finite(self) -> bool:
        """Return whether the estimate can be used."""
        return super().finite() and bool(np.all(np.isfinite(self.covariance)))
