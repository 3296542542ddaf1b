"""What of a measurement is believed: sensors fail, and one wrong number must not spoil what comes after it.

A sensor is left out of a sample if it is not valid, shows no finite number, or is further off what was expected than
the arm can be. If it is an encoder that stays off, the estimate is wrong and not the sensor: it starts anew from where
the encoders say that the arm is. So whatever was shown before, all is well again a few samples after the last wrong
one.

How far an encoder may be off is little while the estimate foresees what it shows. An estimate that has just started
anew does not: nobody told it how the arm is bent, or how fast. What encoders show then is taken in, as long as hubs can
turn so far in a sample. Otherwise a whirling arm would be left without its encoders just when it needs them, started
anew and left without them again, for ever.

Where one of several encoders shows nothing, the others go on for a few samples: what it would be off is inferred from
what they are off. With none left, or for longer, nobody knows where the arm is.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.estimators.kalman import present_sensors
from tmm_gen.control.task.problem import ControlProblem

Array = NDArray[np.float64]

SURPRISE = 0.1
"""By how much the encoder may be off what was expected, rad: a rate wrong by 5 rad/s, at 50 samples per second."""
JUMP = 1.0
"""By how much the hub may turn in a sample, rad; and an encoder be off where the estimate has not proved itself."""
PROOF = 0.5
"""An estimate proves itself by samples in a row in which no encoder is further off than this share of what it may."""
FARTHEST = 640.0
"""How far from where the scene starts a hub may be, rad: a hundred turns. Without gears false encoders may throw one
twenty turns away in a second, and it is to be braked and brought back from there."""
PATIENCE = 5
"""After so many samples in a row that went wrong the estimate starts anew; after as many that went well it has proved
itself."""
_SPREADS = 10.0
"""How many of the standard deviations the estimator assumes of a sensor."""
_FORCES = 10.0
"""How many times as much as the largest torque does to the rigid arm."""
_LARGEST_BEND = 1.5
"""Of a link against the hub, rad: no estimate of an arm that is bent further is of any use."""


@dataclass(frozen=True, eq=False)
class Credible:
    """By how much sensors and estimates may be off.

    Parameters
    ----------
    sensors : tuple of int
        Which there are of m encoders, m accelerometers and m strain gauges.
    surprise : tuple of float, (3 m,)
        Of encoders (rad), accelerometers (m/s^2) and strain gauges (N m) against what was expected.
    home : array, (m,)
        Hub angles at which the scene starts, rad.
    disturbance : array, (m,)
        The largest torques nobody commanded that are reckoned with, N m: larger ones could not be held anyway.
    rate : float
        The largest rate of an estimate, rad/s.
    bend : float
        Largest angle between a link and the hub of the motor that carries it, rad.
    """

    sensors: tuple[int, ...]
    surprise: tuple[float, ...]
    home: Array
    disturbance: Array
    rate: float
    bend: float = _LARGEST_BEND

    def is_place(self, hub: Array) -> NDArray[np.bool_]:
        """Return which hubs, (m,), can be there."""
        return np.asarray(np.isfinite(hub) & (np.abs(hub - self.home) <= FARTHEST))

    def is_move(self, before: Array, now: Array) -> NDArray[np.bool_]:
        """Return which hubs, (m,), can go from there to here in a sample."""
        return np.asarray(np.abs(now - before) <= JUMP)

    def believed(self, surprise: Array, proved: bool) -> tuple[int, ...]:
        """Return which sensors to take in, for what they are off what was expected, (3 m,).

        Encoders may be off by as much as hubs can turn in a sample unless the estimate has proved itself.
        """
        encoders = len(self.home)
        return tuple(
            i
            for i in self.sensors
            if abs(float(surprise[i])) <= self.surprise[i]
            or (not proved and i < encoders and abs(float(surprise[i])) <= JUMP)
        )

    def is_foreseen(self, surprise: Array) -> bool:
        """Return whether all encoders show about what was expected: the estimate is good."""
        return all(abs(float(surprise[i])) <= PROOF * self.surprise[i] for i in range(len(self.home)))


def credible(problem: ControlProblem, home: Array, inertia: Array, length: float) -> Credible:
    """Return what can be believed of an arm.

    Parameters
    ----------
    problem : ControlProblem
        Sensors, bounds of the torque, what the estimator assumes.
    home : array, (m,)
        Hub angles at which the scene starts, rad.
    inertia : array, (m,)
        What each motor turns, kg m^2.
    length : float
        From base to tip, m.
    """
    low, high = problem.torque
    assumed, gears = problem.estimator, problem.motors.gears
    largest = np.maximum(np.abs(low), np.abs(high))
    # all motors together, at the end of the stretched arm
    tip = float(np.sum(np.divide(largest, inertia, out=np.zeros_like(largest), where=inertia > 0.0))) * length
    surprise = np.concatenate(
        [
            np.maximum(SURPRISE, _SPREADS * assumed.encoder),
            np.maximum(_FORCES * tip, _SPREADS * assumed.accelerometer),
            np.maximum(_FORCES * largest * gears, _SPREADS * assumed.strain),
        ]
    )
    return Credible(
        sensors=tuple(present_sensors(problem)),
        surprise=tuple(surprise.tolist()),
        home=home,
        disturbance=high - low,
        rate=JUMP / problem.sample_time,
    )
