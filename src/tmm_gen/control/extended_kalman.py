"""Kalman filters on the nonlinear model: with its covariance, or at the gain of the target."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.credible import Credible
from tmm_gen.control.delay import Pair
from tmm_gen.control.kalman import KalmanFilter
from tmm_gen.control.linear import LinearModel
from tmm_gen.control.links import rest_state
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
        self._linear, self._stationary = linear, KalmanFilter(linear, model.problem)
        self.gain, self.sensors = self._stationary.gain, self._stationary.sensors
        self.home, self.length = linear.start_hub, linear.length
        self._angles, self._rates = model.places("angle"), model.places("rate")
        self.reset()

    def reset(self) -> None:
        """Start from the scene's initial motion."""
        self.estimate = np.append(self.model.initial(), 0.0)

    def turn(self, angle: float) -> None:
        """Turn the whole arm by an angle, rad."""
        self.estimate[self._angles] += angle

    def rest(self, hub: float, rate: float) -> None:
        """Start anew from an arm of the target's shape: where its hub is, rad, and how fast it turns, rad/s."""
        self.estimate = np.append(rest_state(self.model, self._linear), 0.0)
        self.estimate[self._angles] += hub - self._linear.target_hub
        self.estimate[self._rates] = rate

    def surprise(self, measured: Array) -> Array:
        """Return how far a measurement is off what is expected, (3,), NaN where there is no sensor."""
        return np.asarray(measured - np.array(self.model.sensors(self.estimate[:-1])).ravel(), float)

    def correct(self, surprise: Array, sensors: tuple[int, ...], most: float) -> None:
        """Take in what some sensors are off, (3,); the disturbance stays within ``most`` N m either way."""
        self.estimate = self.estimate + self._stationary.gain_of(sensors) @ surprise[list(sensors)]
        self.estimate[-1] = np.clip(self.estimate[-1], -most, most)

    def advance(self, torques: Pair, end: float) -> None:
        """Predict a sample with the torques that act in it, and the one at its end, N m."""
        self.estimate = self._after(self.estimate, torques)

    def ahead(self, torques: list[Pair]) -> tuple[Array, float]:
        """Return state, (m,), and disturbance, N m, after some more samples."""
        estimate = self.estimate
        for pair in torques:
            estimate = self._after(estimate, pair)
        return estimate[:-1], float(estimate[-1])

    def usable(self, limits: Credible) -> bool:
        """Return whether the estimate can be that of an arm: finite, no link far out of line, none too fast."""
        angles = self.estimate[self._angles]
        return bool(
            np.all(np.isfinite(self.estimate))
            and np.max(np.abs(angles - angles[0])) <= limits.bend
            and np.max(np.abs(self.estimate[self._rates])) <= limits.rate
        )

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
        super().__init__(model, linear)

    def reset(self) -> None:
        """Start from the scene's initial motion."""
        super().reset()
        self.covariance = self._stationary.covariance

    def rest(self, hub: float, rate: float) -> None:
        """Start anew; see :class:`NonlinearFilter`."""
        super().rest(hub, rate)
        self.covariance = self._stationary.covariance

    def correct(self, surprise: Array, sensors: tuple[int, ...], most: float) -> None:
        """Take in what some sensors are off, (3,); the disturbance stays within ``most`` N m either way."""
        _, by_state = (np.array(item) for item in self.model.sensor_slopes(self.estimate[:-1]))
        seen = list(sensors)
        measure = np.column_stack([by_state, np.zeros(3)])[seen]
        product = measure @ self.covariance
        noise = self._stationary.noise_of(sensors)
        gain = np.linalg.solve(product @ measure.T + noise, product).T
        self.estimate = self.estimate + gain @ surprise[seen]
        self.estimate[-1] = np.clip(self.estimate[-1], -most, most)
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

    def usable(self, limits: Credible) -> bool:
        """Return whether the estimate can be that of an arm, and its covariance is finite."""
        return super().usable(limits) and bool(np.all(np.isfinite(self.covariance)))
