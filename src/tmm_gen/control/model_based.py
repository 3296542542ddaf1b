"""What controllers with a model share: estimate, look over the delay, decide, fall back if that fails."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.command import Command, Status
from tmm_gen.control.delay import Delay, Pair
from tmm_gen.control.problem import ControlProblem
from tmm_gen.control.safe import safe_torque

Array = NDArray[np.float64]


class Estimator(Protocol):
    """Estimates a model's state and the torque nobody commanded."""

    sensors: list[int]
    """Which of encoder, accelerometer and strain gauge it reads."""

    def reset(self) -> None:
        """Start from the scene's initial motion."""

    def correct(self, measured: Array) -> None:
        """Take a measurement in, (3,)."""

    def advance(self, torques: Pair, end: float) -> None:
        """Predict a sample with the torques that act in it, and the one at its end, N m."""

    def ahead(self, torques: list[Pair]) -> tuple[Array, float]:
        """Return state and disturbance after some more samples, which stay the estimate's secret."""
        ...

    def finite(self) -> bool:
        """Return whether the estimate can be used."""
        ...


class ModelBased(ABC):
    """A controller with an estimator.

    Parameters
    ----------
    problem : ControlProblem
        Sample time, bounds.
    estimator : Estimator
        Of the state the decision needs.
    delay : Delay
        Of the estimator's model.
    inertia : float
        Of hub and arm about the hub, kg m^2, for the safe law.
    """

    def __init__(self, problem: ControlProblem, estimator: Estimator, delay: Delay, inertia: float) -> None:
        self.problem, self.estimator, self.delay, self.inertia = problem, estimator, delay, inertia
        self._start()

    def _start(self) -> None:
        self.estimator.reset()
        self._past = np.zeros(self.delay.memory + 1)
        self._hub = math.nan

    def reset(self) -> None:
        """Forget all measurements."""
        self._start()

    @abstractmethod
    def decide(self, state: Array, disturbance: float, last: float) -> Command:
        """Return the torque for a state at which it begins to act; on failure its status only.

        Parameters
        ----------
        state : array, (m,)
            As the estimator has it.
        disturbance : float
            N m.
        last : float
            Torque chosen a sample before, N m.
        """

    def command(self, measured: Array) -> Command:
        """Return the torque for a measurement; see :class:`~tmm_gen.control.command.Controller`."""
        with np.errstate(all="ignore"):  # what overflows is found by its result
            return self._command(measured)

    def _command(self, measured: Array) -> Command:
        last, hub = float(self._past[-1]), float(measured[0])
        rate, self._hub = (hub - self._hub) / self.problem.sample_time, hub
        command = self._decided(measured, last)
        torque = command.torque
        if command.status is not Status.OK:
            torque = safe_torque(self.problem, self.inertia, rate, last)
        command = Command(self.problem.allowed(torque, last), command.status, command.iterations)
        self._past = np.append(self._past[1:], command.torque)
        self.estimator.advance(self.delay.pair(self._past), self.delay.end(self._past))
        if not self.estimator.finite():
            self.estimator.reset()
        return command

    def _decided(self, measured: Array, last: float) -> Command:
        if not np.all(np.isfinite(measured[self.estimator.sensors])):
            return Command(0.0, Status.MEASUREMENT)
        self.estimator.correct(measured)
        state, disturbance = self.estimator.ahead(self.delay.known(self._past))
        if not np.all(np.isfinite(state)) or not math.isfinite(disturbance):
            return Command(0.0, Status.ESTIMATE)
        return self.decide(state, disturbance, last)
