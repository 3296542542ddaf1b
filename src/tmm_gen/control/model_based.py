"""What controllers with a model share: estimate, look over the delay, decide, fall back if that fails."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.command import Command, Status
from tmm_gen.control.credible import PATIENCE, Credible, credible
from tmm_gen.control.delay import Delay, Pair
from tmm_gen.control.problem import ControlProblem
from tmm_gen.control.safe import safe_torque

Array = NDArray[np.float64]


class Estimator(Protocol):
    """Estimates a model's state and the torque nobody commanded."""

    home: float
    """Hub angle of the scene's initial motion, rad."""
    length: float
    """From hub to tip, m."""

    def reset(self) -> None:
        """Start from the scene's initial motion."""

    def turn(self, angle: float) -> None:
        """Turn the whole arm by an angle, rad."""

    def rest(self, hub: float, rate: float) -> None:
        """Start anew from an arm of the target's shape: where its hub is, rad, and how fast it turns, rad/s."""

    def surprise(self, measured: Array) -> Array:
        """Return how far a measurement is off what is expected, (3,)."""
        ...

    def correct(self, surprise: Array, sensors: tuple[int, ...], most: float) -> None:
        """Take in what some sensors are off, (3,); the disturbance stays within ``most`` N m either way."""

    def advance(self, torques: Pair, end: float) -> None:
        """Predict a sample with the torques that act in it, and the one at its end, N m."""

    def ahead(self, torques: list[Pair]) -> tuple[Array, float]:
        """Return state and disturbance after some more samples, which stay the estimate's secret."""
        ...

    def usable(self, limits: Credible) -> bool:
        """Return whether the estimate can be that of an arm."""
        ...


class ModelBased(ABC):
    """A controller with an estimator.

    The first angle the encoder shows says where the arm starts. Afterwards what cannot be is left out
    (:mod:`tmm_gen.control.credible`), and after a few samples in a row that went wrong the estimate starts anew.

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
        self.limits = credible(problem, estimator.home, inertia, estimator.length)
        self.reset()

    def reset(self) -> None:
        """Forget all measurements."""
        self.estimator.reset()
        self._past = np.zeros(self.delay.memory + 1)
        self._hub, self._fresh, self._wrong = math.nan, True, 0
        self._forget()

    @abstractmethod
    def _forget(self) -> None:
        """Forget what was planned."""

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
            return self._command(np.asarray(measured, float))

    def _command(self, measured: Array) -> Command:
        last, hub = float(self._past[-1]), float(measured[0])
        moved = hub - self._hub if self.limits.is_move(self._hub, hub) else math.nan
        rate = moved / self.problem.sample_time
        command = self._decided(measured, rate, last)
        torque = command.torque
        if not command.status.optimal:
            torque = safe_torque(self.problem, self.inertia, rate, last)
        self._hub = hub
        command = Command(self.problem.allowed(torque, last), command.status, command.iterations)
        self._past = np.append(self._past[1:], command.torque)
        self.estimator.advance(self.delay.pair(self._past), self.delay.end(self._past))
        if not self.estimator.usable(self.limits):
            self.estimator.reset()
            self._wrong = PATIENCE
        return command

    def _decided(self, measured: Array, rate: float, last: float) -> Command:
        """Return the torque, by what can be believed of a measurement."""
        if not self.limits.is_place(float(measured[0])):
            return Command(0.0, Status.MEASUREMENT)
        self._settle(float(measured[0]), rate)
        surprise = self.estimator.surprise(measured)
        believed = self.limits.believed(surprise)
        if 0 in believed:
            self.estimator.correct(surprise, believed, self.limits.disturbance)
        elif self._wrong >= PATIENCE:  # and the encoder jumps, so that nobody knows where the arm is
            return Command(0.0, Status.MEASUREMENT)
        command = self._solved(last)
        wrong = 0 not in believed or not command.status.optimal
        self._wrong = min(self._wrong + 1, PATIENCE) if wrong else 0
        if command.status.optimal and len(believed) < len(self.limits.sensors):
            return Command(command.torque, Status.REDUCED, command.iterations)
        return command

    def _settle(self, hub: float, rate: float) -> None:
        """Start where the encoder says: at first, and when too much went wrong, as soon as it moves as a hub does."""
        if self._fresh:
            self.estimator.turn(hub - self.estimator.home)
            self._fresh = False
        elif self._wrong >= PATIENCE and math.isfinite(rate):
            self.estimator.rest(hub, rate)
            self._forget()
            self._wrong = 0

    def _solved(self, last: float) -> Command:
        state, disturbance = self.estimator.ahead(self.delay.known(self._past))
        if not np.all(np.isfinite(state)) or not math.isfinite(disturbance):
            return Command(0.0, Status.ESTIMATE)
        return self.decide(state, disturbance, last)
