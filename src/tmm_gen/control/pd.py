"""Proportional-derivative control of the hub, with or without a shaped reference: the baseline without a model."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.command import Command, Status
from tmm_gen.control.problem import ControlProblem
from tmm_gen.control.safe import safe_torque

Array = NDArray[np.float64]


class PdController:
    """``u = u_s + p (reference_k - hub) - d hub'``, clipped; the rate is the encoder's difference.

    Parameters
    ----------
    problem : ControlProblem
        Sample time, bounds, start.
    proportional, derivative : float
        N m/rad, N m s/rad.
    target_hub, target_torque : float
        Where the hub is to go, rad, and the torque that holds the arm there, N m.
    shaper : array, (k,), optional
        Impulses, one per sample, whose sum is 1: the reference is a step convolved with them.
    inertia : float
        Of hub and arm about the hub, kg m^2, for the safe law.
    """

    def __init__(
        self,
        problem: ControlProblem,
        proportional: float,
        derivative: float,
        target_hub: float,
        target_torque: float,
        shaper: Array | None = None,
        inertia: float = 0.0,
    ) -> None:
        self.problem, self.inertia = problem, inertia
        self.proportional, self.derivative = proportional, derivative
        self.target_hub, self.target_torque = target_hub, target_torque
        self.steps = np.cumsum(np.ones(1) if shaper is None else shaper)
        self.reset()

    def reset(self) -> None:
        """Forget all measurements."""
        self._sample, self._hub, self._last, self._start = 0, math.nan, 0.0, math.nan

    def command(self, measured: Array) -> Command:
        """Return the torque for a measurement; see :class:`~tmm_gen.control.command.Controller`."""
        hub, last = float(measured[0]), self._last
        rate = (hub - self._hub) / self.problem.sample_time
        self._hub = hub
        if not math.isfinite(hub):
            self._last = safe_torque(self.problem, self.inertia, math.nan, last)
            return Command(self._last, Status.MEASUREMENT)
        if math.isnan(self._start):
            self._start = hub
        if not math.isfinite(rate):
            rate = 0.0
        share = float(self.steps[min(self._sample, len(self.steps) - 1)])
        wanted = self._start + share * (self.target_hub - self._start)
        self._sample += 1
        torque = self.target_torque + self.proportional * (wanted - hub) - self.derivative * rate
        self._last = self.problem.allowed(torque, last)
        return Command(self._last)
