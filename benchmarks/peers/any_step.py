"""A peer's step of any length about an arm under a torque that changes between steps."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cached_property
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from peers.articulated import Articulated
from peers.joint_arm import JointArm

Array = NDArray[np.float64]
_SAMPLE = 2000


class AnyStep:
    """A step about articulated bodies, compiled once for all lengths; and once more for the one that is measured.

    Parameters
    ----------
    arm : JointArm
    torque : callable
        Of the motors during a step, N m, (inputs,), by the time at its middle, s.
    step : callable
        Makes the function that is compiled, and takes ``any_step``.
    keeps : int
        How many kinds of motion it carries: 3 with accelerations, or 2.
    exact : array, (10, 2)
        The tip at 0.1, 0.2 ... 1 s, m.
    """

    def __init__(
        self,
        arm: JointArm,
        torque: Callable[[float], Array],
        step: Callable[..., ca.Function],
        keeps: int,
        exact: Array,
    ) -> None:
        self._arm, self._torque, self._step, self._keeps, self._exact = arm, torque, step, keeps, exact

    @cached_property
    def _stepping(self) -> Articulated:
        def of_any_length(arm: JointArm) -> ca.Function:
            return self._step(arm, any_step=True)

        return Articulated(self._arm, self._torque(0.0), of_any_length)

    def _started(self, angles: Array, rates: Array, torque: Array) -> Array:
        return self._stepping.started(angles, rates, torque)[: self._keeps * len(angles)]

    def error(self, per_interval: int) -> float:
        """Return the largest error of the tip at the checkpoints, m, with so many steps between them.

        Accelerations are found anew where the torque has jumped.
        """
        n, h = len(self._arm.lengths), 0.1 / per_interval
        motion, torque, worst = np.zeros(2 * n), None, 0.0
        for index, (x, y) in enumerate(self._exact):
            now = self._torque(0.1 * (index + 0.5))
            if torque is None or not np.array_equal(now, torque):
                torque, motion = now, self._started(motion[:n], motion[n : 2 * n], now)
            motion, _ = self._stepping.advance(motion, per_interval, np.append(torque, h))
            turned = np.cumsum(motion[:n])
            tip = np.array([np.cos(turned) @ self._arm.lengths, np.sin(turned) @ self._arm.lengths])
            off = float(np.linalg.norm(tip - [x, y]))
            worst = max(worst, off) if np.isfinite(off) else np.inf
        return worst

    def timer(self, per_interval: int) -> Callable[[], float]:
        """Return what measures the steps of one second, s of this thread; their length is part of the code."""
        n, torque = len(self._arm.lengths), 0.01 * self._torque(0.0)
        arm: Any = replace(self._arm, step=0.1 / per_interval)
        fixed = Articulated(arm, torque, self._step)
        start = self._started(np.zeros(n), np.zeros(n), torque)

        def measured() -> float:
            _, taken = fixed.advance(start, _SAMPLE)
            return taken / _SAMPLE * 10 * per_interval

        return measured
