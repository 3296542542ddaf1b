"""A linear model of the arm about its target, sampled."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.delay import Delay

Array = NDArray[np.float64]

SENSORS = ("encoder", "accelerometer", "strain")
"""Hub angle; acceleration across the last link at the tip; bending moment at the root."""


@dataclass(frozen=True, eq=False)
class LinearModel:
    """``x+ = A x + B_0 u_before + B_1 u_then``, measured ``y = C x + D e``; all off the target.

    Torques are those that act in a sample, ``e`` at its end; see :class:`~tmm_gen.control.delay.Delay`.

    Parameters
    ----------
    transition : array, (m, m)
        A, over a sample.
    before, then : array, (m,)
        ``B_0`` and ``B_1``.
    tip, tip_rate, hub, hub_rate : array, (m,)
        Rows that give angles and their rates.
    measure : array, (3, m)
        C, rows as `SENSORS`.
    feed : array, (3,)
        D.
    target_sensors : array, (3,)
        What the sensors show at the target.
    target_hub, target_torque : float
        ``hub_s`` (rad) and ``u_s`` (N m).
    whirl : array, (m,)
        Row of what a rate of 1 rad/s throughout adds to the accelerometer: ``L (q_n - tip)``, since the tip, bent out
        of the line of the last link, is pulled inward across it.
    turn : array, (m,)
        What all rates grown by 1 rad/s are in the state.
    turned : array, (m,)
        What all angles grown by 1 rad are in the state.
    start_hub, length : float
        Hub angle at time zero, rad; from hub to tip, m.
    start : array, (m,)
        State at time zero.
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
    target_hub: float
    target_torque: float
    whirl: Array
    turn: Array
    turned: Array
    start_hub: float
    length: float
    start: Array
    delay: Delay

    @property
    def size(self) -> int:
        """Entries of the state, m."""
        return len(self.then)

    def weighed(self, tip: float, hub: float, tip_rate: float, hub_rate: float) -> Array:
        """Return Q of ``x'Q x``, (m, m): the weighed squares of both angles and their rates."""
        found = np.zeros((self.size, self.size))
        for weight, row in (
            (tip, self.tip),
            (hub, self.hub),
            (tip_rate, self.tip_rate),
            (hub_rate, self.hub_rate),
        ):
            found += weight * np.outer(row, row)
        return found

    @property
    def drive(self) -> Array:
        """What a torque does that acts throughout a sample, (m,)."""
        return self.before + self.then
