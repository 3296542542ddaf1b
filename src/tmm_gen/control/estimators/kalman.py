"""Kalman filter of a linear model with a disturbance state, at its stationary gain."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.prediction.linear import LinearModel
from tmm_gen.control.prediction.linear_target import Place
from tmm_gen.control.task.delay import Pair
from tmm_gen.control.task.problem import ControlProblem

if TYPE_CHECKING:
    from tmm_gen.control.estimators.credible import Credible

Array = NDArray[np.float64]

_TINY = 1e-12
"""Variance of every state per sample, relative to the torque's: keeps the filter from being too sure."""
_DRIFT = 0.3
"""By how much what a sensor behind the encoders is off for long changes per sample, relative to its assumed error."""
_MOST = 20_000
_SETTLED = 1e-10


def present_sensors(problem: ControlProblem) -> list[int]:
    """Return which of the sensors there are: m encoders, m accelerometers, m strain gauges."""
    behind = np.concatenate([problem.accelerometers, problem.gauges])
    count = problem.count
    return [*range(count), *(count + int(place) for place in np.flatnonzero(~np.isnan(behind)))]


class KalmanFilter:
    """Estimates state and disturbances of a linear model from the sensors there are.

    ``x+ = A x + B_0 (u_before + d) + B_1 (u_then + d)``, ``d+ = d``, ``y = C x + D (e + d)``,
    torques less the target's.
    Noise acts on the torque, on the disturbance and on each sensor, as ``[control.estimator]`` says. Accelerometers
    and strain gauges of arms by parts are off by something that stays: what a payload that nobody told of weighs, and
    the drift of gauges. It is estimated as well, ``y = C x + D (e + d) + b``, or the arm would rest elsewhere than its
    encoders say. One thing is not
    linear: what the swinging arm's centripetal acceleration adds to accelerometers is taken off their readings.
    All of it counts from the target, or from another place where the arm can rest.

    Parameters
    ----------
    model : LinearModel
        About the target.
    problem : ControlProblem
        Sensors and noise.
    """

    def __init__(self, model: LinearModel, problem: ControlProblem) -> None:
        self.model = model
        self.sensors = present_sensors(problem)
        size, count = model.size, model.count
        self.biased = [] if problem.motors.on_hub else self.sensors[count:]
        more = len(self.biased)
        self.transition = np.eye(size + count + more)
        self.transition[:size, :size] = model.transition
        self.transition[:size, size : size + count] = model.drive
        self.drive = np.vstack([model.drive, np.zeros((count + more, count))])
        biases = np.eye(len(self.sensors))[:, len(self.sensors) - more :]
        self.measure = np.column_stack([model.measure[self.sensors], model.feed[self.sensors], biases])
        self.feed = model.feed[self.sensors]
        self._assumed = problem.estimator
        assumed = self._assumed
        spreads = np.concatenate([assumed.encoder, assumed.accelerometer, assumed.strain])
        self.noise = np.diag(spreads[self.sensors] ** 2)
        self.home, self.start, self.length = model.start_hub, model.start_torque, model.length
        self.gain, self.covariance = self._stationary(tuple(self.sensors))
        self._gains = {tuple(self.sensors): self.gain}
        self.base = Place.of(model)
        self.reset()

    def reset(self) -> None:
        """Start from the scene's initial motion."""
        self.place = self.base
        self.estimate = np.append(self.model.start, np.zeros(self.model.count + len(self.biased)))
        self._direct = self.model.start_torque - self.base.goal.torque

    def stand(self, place: Place) -> None:
        """Take another place to count from; what is estimated of the arm stays."""
        self.estimate[: self.model.size] -= place.state - self.place.state
        self._direct = self._direct - (place.goal.torque - self.place.goal.torque)
        self.place = place

    def turn(self, angle: Array) -> None:
        """Turn hubs by angles, (m,), rad, with all they carry."""
        self.estimate[: self.model.size] += self.model.turned @ angle

    def rest(self, hub: Array, rate: Array) -> None:
        """Start anew from an arm of the target's shape: where its hubs are, rad, how fast they turn, rad/s, (m,)."""
        model = self.model
        turned = model.turned @ (hub - self.place.goal.hub)
        self.estimate = np.append(turned + model.turn @ rate, np.zeros(model.count + len(self.biased)))

    def hubs(self) -> tuple[Array, Array]:
        """Return angles and rates of the hubs, (m,) each, rad and rad/s."""
        model, (state, _) = self.model, self._parts(self.estimate)
        return model.hub @ state + self.place.goal.hub, model.hub_rate @ state

    def holds(self, hub: Array) -> Array:
        """Return the torques that hold an arm with its hubs there, rad, (m,), N m."""
        held = self.model.lift.beside(self.model.goal) + self.model.lift.weight(hub, self.place.more)
        return np.asarray(held - self._parts(self.estimate)[1], float)

    def surprise(self, measured: Array) -> Array:
        """Return how far a measurement is off what is expected, (3 m,), NaN where there is no sensor."""
        model, (state, disturbance) = self.model, self._parts(self.estimate)
        seen = measured - self.place.shown - model.measure @ state - model.feed @ (self._direct + disturbance)
        count, rates = model.count, model.hub_rate @ state
        seen[count : 2 * count] -= model.swept @ rates @ rates
        rate = float(model.tip_rate[0] @ state)
        seen[count] -= rate * rate * float(model.whirl @ state)
        seen[self.biased] -= self.estimate[model.size + count :]
        return np.asarray(seen, float)

    def taken_in(self, sensors: tuple[int, ...]) -> tuple[int, ...]:
        """Return which of the sensors behind the encoders are taken in where these can be: all of them."""
        return sensors

    def correct(self, surprise: Array, sensors: tuple[int, ...], most: Array) -> None:
        """Take in what some sensors are off, (3 m,); disturbances stay within ``most`` N m, (m,), either way."""
        self.estimate = self.estimate + self.gain_of(sensors) @ surprise[list(sensors)]
        _, disturbance = self._parts(self.estimate)
        np.clip(disturbance, -most, most, out=disturbance)

    def noise_of(self, sensors: tuple[int, ...]) -> Array:
        """Return the covariance of the noise of some sensors."""
        places = self._places(sensors)
        return self.noise[np.ix_(places, places)]

    def _places(self, sensors: tuple[int, ...]) -> list[int]:
        return [self.sensors.index(sensor) for sensor in sensors]

    def gain_of(self, sensors: tuple[int, ...]) -> Array:
        """Return the gain of a filter that reads some of the sensors only, (s + m + b, those).

        It is stationary where all encoders are among them. Where one shows nothing, not every disturbance can be told,
        so that there is no such gain: it is that of the first sample without it.
        """
        if sensors not in self._gains:
            lost = set(range(self.model.count)) - set(sensors)
            self._gains[sensors] = self._without(sensors) if lost else self._stationary(sensors)[0]
        return self._gains[sensors]

    @property
    def spread(self) -> Array:
        """Covariance of what sensors are off what is expected, (p, p), where all were read before."""
        return np.asarray(self.measure @ self.covariance @ self.measure.T + self.noise, float)

    def _without(self, sensors: tuple[int, ...]) -> Array:
        """Return the gain for the first sample in which some encoders show nothing, (s + m + b, those that do)."""
        every, inferred = self.inferred(sensors)
        return np.asarray(self.gain_of(every) @ inferred, float)

    def inferred(self, sensors: tuple[int, ...]) -> tuple[tuple[int, ...], Array]:
        """Return some sensors with all encoders, and what these are off by what the former are off, (e, those)."""
        every: tuple[int, ...] = tuple(sorted({*range(self.model.count), *sensors}))
        read, places = self._places(every), [every.index(sensor) for sensor in sensors]
        spread = self.spread[np.ix_(read, read)]
        found = np.linalg.solve(spread[np.ix_(places, places)], spread[places]).T
        return every, np.asarray(found, float)

    def advance(self, torques: Pair, end: Array) -> None:
        """Predict a sample with the torques that act in it, and those at its end, N m."""
        self.estimate = self._after(self.estimate, torques)
        self._direct = end - self.place.goal.torque

    def ahead(self, torques: list[Pair]) -> tuple[Array, Array]:
        """Return state, (s,), and disturbances, (m,), N m, after some more samples."""
        estimate = self.estimate
        for pair in torques:
            estimate = self._after(estimate, pair)
        return self._parts(estimate)

    def _parts(self, estimate: Array) -> tuple[Array, Array]:
        """Return state and disturbances of an estimate, as views of it."""
        size = self.model.size
        return estimate[:size], estimate[size : size + self.model.count]

    def _after(self, estimate: Array, torques: Pair) -> Array:
        before, then = (torque - self.place.goal.torque for torque in torques)
        after = self.transition @ estimate
        after[: self.model.size] += self.model.before @ before + self.model.then @ then
        return np.asarray(after, float)

    def usable(self, limits: Credible) -> bool:
        """Return whether the estimate can be that of an arm: the filter is stable, so that it need be finite only."""
        return bool(np.all(np.isfinite(self.estimate)))

    def driven(self, drive: Array) -> Array:
        """Return what the covariance of the estimate grows by per sample, for columns of the torques."""
        size, assumed = self.model.size, self._assumed
        found = (drive * assumed.torque**2) @ drive.T
        found += np.max(assumed.torque) ** 2 * _TINY * np.eye(len(drive))
        found[:size, :size] += (self.model.turn * assumed.rate**2) @ self.model.turn.T
        biases = _DRIFT**2 * np.diag(self.noise)[len(self.noise) - len(self.biased) :]
        found[size:, size:] += np.diag(np.concatenate([assumed.disturbance**2, biases]))
        return np.asarray(found, float)

    def _stationary(self, sensors: tuple[int, ...]) -> tuple[Array, Array]:
        """Iterate the Riccati equation until it stands; return gain and covariance before a measurement."""
        measure = self.measure[self._places(sensors)]
        noise = self.noise_of(sensors)
        driven = self.driven(self.drive)
        covariance: Array = driven.copy()
        gain: Array = np.zeros((len(driven), len(noise)))
        for _ in range(_MOST):
            seen = measure @ covariance
            new: Array = np.asarray(np.linalg.solve(seen @ measure.T + noise, seen).T, float)
            corrected = covariance - new @ seen
            covariance[:] = self.transition @ (0.5 * (corrected + corrected.T)) @ self.transition.T + driven
            settled = np.max(np.abs(new - gain)) <= _SETTLED * np.max(np.abs(new))
            gain = new
            if settled:
                break
        return gain, covariance
