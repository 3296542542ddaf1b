"""Proportional-derivative control of the hub, with or without a shaped reference: the baseline without a model."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.command import Command, Status
from tmm_gen.control.credible import FARTHEST, JUMP, PATIENCE
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
        self._wrong, self._gap = PATIENCE, False

    def command(self, measured: Array) -> Command:
        """Return the torque for a measurement; see :class:`~tmm_gen.control.command.Controller`."""
        hub = float(measured[0])
        if not self._believed(hub):
            self._gap = True
            self._last = safe_torque(self.problem, self.inertia, math.nan, self._last)
            return Command(self._last, Status.MEASUREMENT)
        rate = 0.0 if self._gap or math.isnan(self._hub) else (hub - self._hub) / self.problem.sample_time
        self._hub, self._gap = hub, False
        share = float(self.steps[min(self._sample, len(self.steps) - 1)])
        wanted = self._start + share * (self.target_hub - self._start)
        self._sample += 1
        torque = self.target_torque + self.proportional * (wanted - hub) - self.derivative * rate
        self._last = self.problem.allowed(torque, self._last)
        return Command(self._last)

    def _believed(self, hub: float) -> bool:
        """Return whether the hub can be there; what jumped is believed if it stays, and the reference starts anew."""
        if not (math.isfinite(hub) and abs(hub - self.target_hub) <= FARTHEST):
            return False
        if math.isnan(self._hub) or abs(hub - self._hub) > JUMP:
            if self._wrong < PATIENCE:
                self._wrong += 1
                return False
            self._start, self._sample, self._gap = hub, 0, True
        self._wrong = 0
        return True
