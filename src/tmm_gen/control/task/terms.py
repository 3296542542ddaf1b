"""What a control problem is made of: weights, what an estimator assumes, goals, kinds of rows, motor by motor."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.task.unsaid import DISTURBANCE, RATE, TORQUE, TORQUE_STEP, UNKNOWN_TORQUE, Told
from tmm_gen.scene.control import Estimator, Weights
from tmm_gen.scene.each import by_names

Array = NDArray[np.float64]
Pair = tuple[float, float]


@dataclass(frozen=True, eq=False)
class MotorWeights:
    """Weights of the cost, (m,) each; see :class:`~tmm_gen.scene.control.Weights`."""

    tip: Array
    hub: Array
    tip_rate: Array
    hub_rate: Array
    torque: Array
    torque_step: Array
    overshoot: Array
    hub_bound: Array
    hub_rate_bound: Array

    @classmethod
    def of(cls, weights: Weights, told: Told) -> MotorWeights:
        """Return the weights of some motors."""
        unsaid = {"torque": TORQUE, "torque_step": TORQUE_STEP}
        found = {
            item.name: np.array(by_names(getattr(weights, item.name), told.names))
            for item in fields(cls)
            if item.name not in unsaid
        }
        return cls(**found, **{name: told.of(getattr(weights, name), of) for name, of in unsaid.items()})


@dataclass(frozen=True, eq=False)
class Assumed:
    """What the Kalman filter assumes; see :class:`~tmm_gen.scene.control.Estimator`.

    Parameters
    ----------
    encoder, torque, disturbance, rate, accelerometer, strain : array, (m,)
        Of each motor: rad, N m, N m, rad/s, m/s^2, N m.
    """

    encoder: Array
    torque: Array
    disturbance: Array
    rate: Array
    accelerometer: Array
    strain: Array

    @classmethod
    def of(cls, estimator: Estimator, told: Told) -> Assumed:
        """Return what is assumed of some motors."""
        unsaid = {"torque": UNKNOWN_TORQUE, "disturbance": DISTURBANCE, "rate": RATE}
        found = {
            name: np.array(by_names(getattr(estimator, name), told.names))
            for name in ("encoder", "accelerometer", "strain")
        }
        return cls(**found, **{name: told.of(getattr(estimator, name), of) for name, of in unsaid.items()})


@dataclass(frozen=True, eq=False)
class Goal:
    """What the arm is to come to, (m,) each: angles of tips and hubs, rad, and the torques that hold it, N m."""

    tip: Array
    hub: Array
    torque: Array


@dataclass(frozen=True, eq=False)
class Wanted:
    """What the cost compares the horizon with, (m, N) each, or (m, 1) where it is the same throughout.

    Parameters
    ----------
    tip, hub, tip_rate, hub_rate : array
        After samples 1 to N: rad, rad/s.
    torque : array
        In samples 0 to N - 1, N m.
    end : array, (r,)
        ``G s_N`` of what is wanted at the end, off what it is reckoned from.
    """

    tip: Array
    hub: Array
    tip_rate: Array
    hub_rate: Array
    torque: Array
    end: Array

    @classmethod
    def still(cls, goal: Goal) -> Wanted:
        """Return that the arm rests at a goal, from which its end is reckoned."""
        none = np.zeros((len(goal.hub), 1))
        return cls(goal.tip[:, None], goal.hub[:, None], none, none, goal.torque[:, None], np.zeros(1))


@dataclass(frozen=True)
class Kind:
    """N rows of the quadratic program, one per sample.

    Parameters
    ----------
    what : {"rate", "tip", "hub", "hub_rate", "keep"}
        Change of a torque, an angle, a hub's rate, or how far a part is along the normal of a wall.
    motor : int
        Whose; or which of the walls.
    low, high : float
        N m, rad, rad/s or m.
    weight : float
        Of passing it; infinite where it is hard.
    """

    what: Literal["rate", "tip", "hub", "hub_rate", "keep"]
    motor: int
    low: float
    high: float
    weight: float = math.inf

    @property
    def soft(self) -> bool:
        """Whether it may be passed."""
        return math.isfinite(self.weight)
