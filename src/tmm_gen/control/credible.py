"""What of a measurement is believed: sensors fail, and one wrong number must not spoil what comes after it.

A sensor is left out of a sample if it shows no finite number, or is further off what was expected than the arm can
be. If it is the encoder that stays off, the estimate is wrong and not the sensor: it starts anew from where the
encoder says that the arm is. So whatever was shown before, a few samples after the last wrong one all is well again.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.kalman import present_sensors
from tmm_gen.control.problem import ControlProblem

Array = NDArray[np.float64]

SURPRISE = 0.1
"""By how much the encoder may be off what was expected, rad: a rate wrong by 5 rad/s, at 50 samples per second."""
JUMP = 1.0
"""By how much the hub may turn in a sample, rad."""
FARTHEST = 64.0
"""How far from where the scene starts a hub may be, rad: ten turns."""
PATIENCE = 5
"""After so many samples in a row that went wrong the estimate starts anew."""
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
        Which of encoder, accelerometer and strain gauge there are.
    surprise : tuple of float, (3,)
        Of encoder (rad), accelerometer (m/s^2) and strain gauge (N m) against what was expected.
    home : float
        Hub angle at which the scene starts, rad.
    disturbance : float
        The largest torque nobody commanded that is reckoned with, N m: a larger one could not be held anyway.
    rate : float
        The largest rate of an estimate, rad/s.
    bend : float
        Largest angle between a link and the hub, rad.
    """

    sensors: tuple[int, ...]
    surprise: tuple[float, float, float]
    home: float
    disturbance: float
    rate: float
    bend: float = _LARGEST_BEND

    def is_place(self, hub: float) -> bool:
        """Return whether a hub can be there."""
        return math.isfinite(hub) and abs(hub - self.home) <= FARTHEST

    def is_move(self, before: float, now: float) -> bool:
        """Return whether a hub can go from there to here in a sample."""
        return abs(now - before) <= JUMP

    def believed(self, surprise: Array) -> tuple[int, ...]:
        """Return which sensors to take in, for what they are off what was expected, (3,)."""
        return tuple(i for i in self.sensors if abs(float(surprise[i])) <= self.surprise[i])


def credible(problem: ControlProblem, home: float, inertia: float, length: float) -> Credible:
    """Return what can be believed of an arm.

    Parameters
    ----------
    problem : ControlProblem
        Sensors, bounds of the torque, what the estimator assumes.
    home : float
        Hub angle at which the scene starts, rad.
    inertia : float
        Of hub and arm about the hub, kg m^2.
    length : float
        From hub to tip, m.
    """
    low, high = problem.torque
    largest, assumed = max(abs(low), abs(high)), problem.estimator
    tip = largest * length / inertia if inertia > 0.0 else 0.0
    return Credible(
        sensors=tuple(present_sensors(problem)),
        surprise=(
            max(SURPRISE, _SPREADS * assumed.encoder),
            max(_FORCES * tip, _SPREADS * assumed.accelerometer),
            max(_FORCES * largest, _SPREADS * assumed.strain),
        ),
        home=home,
        disturbance=high - low,
        rate=JUMP / problem.sample_time,
    )
