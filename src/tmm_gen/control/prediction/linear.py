"""A linear model of the arm about its target, sampled."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.prediction.lift import Lift
from tmm_gen.control.task.delay import Delay
from tmm_gen.control.task.terms import Goal

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class LinearModel:
    """``x+ = A x + B_0 u_before + B_1 u_then``, measured ``y = C x + D e``; all off the target.

    Torques are those that act in a sample, ``e`` at its end; see :class:`~tmm_gen.control.task.delay.Delay`. The m
    motors have hubs and tips (:mod:`tmm_gen.control.arm.motors`).

    Parameters
    ----------
    transition : array, (s, s)
        A, over a sample.
    before, then : array, (s, m)
        ``B_0`` and ``B_1``.
    tip, tip_rate, hub, hub_rate : array, (m, s)
        Rows that give angles and their rates.
    measure : array, (3 m, s)
        C: the hubs' angles; accelerations across the last links at the tips; bending moments at the roots.
    feed : array, (3 m, m)
        D.
    target_sensors : array, (3 m,)
        What the sensors show at the target.
    goal : Goal
        Angles (rad) and torques (N m) at the target.
    swept : array, (m, m, m)
        What products of the hubs' rates add to the accelerometers: with elbows bent, one motor's turning is felt at
        another's tip. Zero of an arm on a hub.
    whirl : array, (s,)
        Of an arm on a hub, row of what a rate of 1 rad/s throughout adds to the accelerometer: ``L (q_n - tip)``,
        since the tip, bent out of the line of the last link, is pulled inward across it.
    turn : array, (s, m)
        What is in the state of a hub that turns by 1 rad/s, and all behind it as well.
    turned : array, (s, m)
        What is in the state of a hub turned by 1 rad, and all behind it as well.
    start_hub : array, (m,)
        Hub angles at time zero, rad.
    length : float
        From base to tip, m.
    start : array, (s,)
        State at time zero.
    start_torque : array, (m,)
        Torques before any is chosen, N m.
    lift : Lift
        What holds the arm up.
    delay : Delay
        Which torques are meant.
    """

    transition: Array
    before: Array
    then: Array
    tip: Array
    tip_rate: Array
    hub: Array
    hub_rate: Array
    measure: Array
    feed: Array
    target_sensors: Array
    goal: Goal
    swept: Array
    whirl: Array
    turn: Array
    turned: Array
    start_hub: Array
    length: float
    start: Array
    start_torque: Array
    lift: Lift
    delay: Delay

    @property
    def size(self) -> int:
        """Entries of the state, s."""
        return len(self.then)

    @property
    def count(self) -> int:
        """Number of motors, m."""
        return int(self.then.shape[1])

    def weighed(self, tip: Array, hub: Array, tip_rate: Array, hub_rate: Array) -> Array:
        """Return Q of ``x'Q x``, (s, s): the weighed squares of all angles and their rates; weights are (m,) each."""
        found = np.zeros((self.size, self.size))
        for weights, rows in (
            (tip, self.tip),
            (hub, self.hub),
            (tip_rate, self.tip_rate),
            (hub_rate, self.hub_rate),
        ):
            for weight, row in zip(weights, rows, strict=True):
                found += weight * np.outer(row, row)
        return found

    @property
    def drive(self) -> Array:
        """What torques do that act throughout a sample, (s, m)."""
        return self.before + self.then
