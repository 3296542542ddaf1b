"""Kalman filters on the nonlinear model: with its covariance, or at the gain of the target."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.estimators.credible import Credible
from tmm_gen.control.estimators.far_gain import FarGain, far_gain
from tmm_gen.control.estimators.kalman import KalmanFilter
from tmm_gen.control.prediction.linear import LinearModel
from tmm_gen.control.prediction.links import rest_state
from tmm_gen.control.prediction.step_model import StepModel
from tmm_gen.control.task.delay import Pair

Array = NDArray[np.float64]


class NonlinearFilter:
    """Predicts by the generated step, corrects at the stationary gain of the target: cheap, and right near it.

    Where that would do harm, far from the target, hubs are corrected as if nothing bent
    (:mod:`tmm_gen.control.estimators.far_gain`).

    Parameters
    ----------
    model : StepModel
        The generated step.
    linear : LinearModel
        Of the same step about the target.
    """

    def __init__(self, model: StepModel, linear: LinearModel) -> None:
        self.model, self._motors = model, model.motors
        self._linear, self._stationary = linear, KalmanFilter(linear, model.problem)
        self.gain, self.sensors = self._stationary.gain, self._stationary.sensors
        self._biased = self._stationary.biased
        self._unknown = np.zeros(linear.count + len(self._biased))
        self.home, self.start, self.length = linear.start_hub, linear.start_torque, linear.length
        self._more = 0.0
        self._angles, self._rates = model.places("angle"), model.places("rate")
        self.far = self._far_gain()
        self.reset()

    def _far_gain(self) -> FarGain | None:
        return far_gain(self.model, self._linear, self._stationary)

    def reset(self) -> None:
        """Start from the scene's initial motion."""
        self.begin(self.model.initial())

    def begin(self, state: Array) -> None:
        """Start from another state, (s,), with nothing unknown."""
        self.estimate = np.append(state, self._unknown)

    def turn(self, angle: Array) -> None:
        """Turn hubs by angles, (m,), rad, with all they carry."""
        self.estimate[self._angles] += self._motors.turned @ angle

    def rest(self, hub: Array, rate: Array) -> None:
        """Start anew from an arm of the target's shape: where its hubs are, rad, how fast they turn, rad/s, (m,)."""
        state = rest_state(self.model, self._linear)
        self.estimate = np.append(state, self._unknown)
        self.estimate[self._angles] += self._motors.turned @ (hub - self._linear.goal.hub)
        self.estimate[self._rates] = self._motors.turned @ rate

    def hubs(self) -> tuple[Array, Array]:
        """Return angles and rates of the hubs, (m,) each, rad and rad/s."""
        rows = self._motors.hub
        return rows @ self.estimate[self._angles], rows @ self.estimate[self._rates]

    def holds(self, hub: Array) -> Array:
        """Return the torques that hold an arm with its hubs there, rad, (m,), N m."""
        lift = self._linear.lift
        held = lift.beside(self._linear.goal) + lift.weight(hub, self._more)
        return np.asarray(held - self._parts(self.estimate)[1], float)

    def carry(self, model: StepModel, more: float) -> None:
        """Predict by the step of the same arm with some more payload than the scene's, kg."""
        self.model, self._more = model, more

    def surprise(self, measured: Array) -> Array:
        """Return how far a measurement is off what is expected, (3 m,), NaN where there is no sensor."""
        state, _ = self._parts(self.estimate)
        seen = np.asarray(measured - np.array(self.model.sensors(state)).ravel(), float)
        seen[self._biased] -= self.estimate[self.model.size + self._linear.count :]
        return seen

    def _is_far(self) -> bool:
        return self.far is not None and self.far.is_far(self.hubs()[0])

    def taken_in(self, sensors: tuple[int, ...]) -> tuple[int, ...]:
        """Return which of the sensors behind the encoders are taken in where these can be; -1 says: none, it is far."""
        return (-1,) if self._is_far() else sensors

    def correct(self, surprise: Array, sensors: tuple[int, ...], most: Array) -> None:
        """Take in what some sensors are off, (3 m,); disturbances stay within ``most`` N m, (m,), either way."""
        self.estimate = self.estimate + self._gain_of(sensors) @ surprise[list(sensors)]
        self._limit(most)

    def _gain_of(self, sensors: tuple[int, ...]) -> Array:
        """Return the gain where the arm is, (s + m + b, those)."""
        if self.far is None or not self._is_far():
            return self._stationary.gain_of(sensors)
        every, inferred = self._stationary.inferred(sensors)
        return np.asarray(
            self.far.gain[:, [self.sensors.index(sensor) for sensor in every]] @ inferred, float
        )

    def _limit(self, most: Array) -> None:
        _, disturbance = self._parts(self.estimate)
        np.clip(disturbance, -most, most, out=disturbance)

    def advance(self, torques: Pair, end: Array) -> None:
        """Predict a sample with the torques that act in it, and those at its end, N m."""
        self.estimate = self._after(self.estimate, torques)

    def ahead(self, torques: list[Pair]) -> tuple[Array, Array]:
        """Return state, (s,), and disturbances, (m,), N m, after some more samples."""
        estimate = self.estimate
        for pair in torques:
            estimate = self._after(estimate, pair)
        return self._parts(estimate)

    def _parts(self, estimate: Array) -> tuple[Array, Array]:
        """Return state and disturbances of an estimate, as views of it."""
        size = self.model.size
        return estimate[:size], estimate[size : size + self._linear.count]

    def usable(self, limits: Credible) -> bool:
        """Return whether the estimate can be that of an arm: finite, no link far out of line, none too fast."""
        angles = self.estimate[self._angles]
        return bool(
            np.all(np.isfinite(self.estimate))
            and self._motors.bent(angles) <= limits.bend
            and np.max(np.abs(self.estimate[self._rates])) <= limits.rate
        )

    def _after(self, estimate: Array, torques: Pair) -> Array:
        state, disturbance = self._parts(estimate)
        acting = np.concatenate([torque + disturbance for torque in torques])
        return self._moved_on(np.array(self.model.sample(state, acting)).ravel(), estimate)

    def _moved_on(self, state: Array, estimate: Array) -> Array:
        """Return an estimate with another state: what is unknown stays."""
        return np.append(state, estimate[self.model.size :])


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

    def _far_gain(self) -> FarGain | None:
        return None  # its own gain is that of where the arm is

    def reset(self) -> None:
        """Start from the scene's initial motion."""
        super().reset()
        self.covariance = self._stationary.covariance

    def rest(self, hub: Array, rate: Array) -> None:
        """Start anew; see :class:`NonlinearFilter`."""
        super().rest(hub, rate)
        self.covariance = self._stationary.covariance

    def correct(self, surprise: Array, sensors: tuple[int, ...], most: Array) -> None:
        """Take in what some sensors are off; see :class:`NonlinearFilter`."""
        state, _ = self._parts(self.estimate)
        _, by_state = (np.array(item) for item in self.model.sensor_slopes(state))
        seen = list(sensors)
        measure = np.hstack([by_state, np.zeros((len(by_state), len(self._unknown)))])[seen]
        for column, sensor in enumerate(self._biased, start=len(state) + self._linear.count):
            measure[:, column] = np.array(seen) == sensor
        product = measure @ self.covariance
        noise = self._stationary.noise_of(sensors)
        gain = np.linalg.solve(product @ measure.T + noise, product).T
        self.estimate = self.estimate + gain @ surprise[seen]
        self._limit(most)
        self.covariance = self.covariance - gain @ product

    def advance(self, torques: Pair, end: Array) -> None:
        """Predict a sample with the torques that act in it, and the one at its end, N m."""
        state, disturbance = self._parts(self.estimate)
        size, count, unknown = len(state), len(disturbance), len(self._unknown)
        acting = np.concatenate([torque + disturbance for torque in torques])
        after, by_state, by_torques = (np.array(item) for item in self.model.sample_slopes(state, acting))
        drive = by_torques[:, :count] + by_torques[:, count:]
        transition = np.eye(size + unknown)
        transition[:size, :size], transition[:size, size : size + count] = by_state, drive
        self.estimate = self._moved_on(after.ravel(), self.estimate)
        spread = transition @ self.covariance @ transition.T
        grown = self._stationary.driven(np.vstack([drive, np.zeros((unknown, count))]))
        self.covariance = 0.5 * (spread + spread.T) + grown

    def usable(self, limits: Credible) -> bool:
        """Return whether the estimate can be that of an arm, and its covariance is finite."""
        return super().usable(limits) and bool(np.all(np.isfinite(self.covariance)))
