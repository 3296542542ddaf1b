"""What controllers with a model share: estimate, look over the delay, decide, fall back if that fails."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import replace
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.command import Command, Flags, Status, shown
from tmm_gen.control.estimators.credible import PATIENCE, Credible, credible
from tmm_gen.control.goals.window import Window
from tmm_gen.control.laws.safe import safe_torque
from tmm_gen.control.task.delay import Delay, Pair
from tmm_gen.control.task.problem import ControlProblem
from tmm_gen.errors import UserError

Array = NDArray[np.float64]


class Estimator(Protocol):
    """Estimates a model's state and the torques nobody commanded."""

    home: Array
    """Hub angles of the initial motion, (m,), rad."""
    start: Array
    """Torques before any is chosen, (m,), N m."""
    length: float
    """From base to tip, m."""

    def reset(self) -> None:
        """Start from the initial motion."""

    def turn(self, angle: Array) -> None:
        """Turn hubs by angles, (m,), rad, with all they carry."""

    def rest(self, hub: Array, rate: Array) -> None:
        """Start anew from an arm of the target's shape: where its hubs are, rad, how fast they turn, rad/s, (m,)."""

    def hubs(self) -> tuple[Array, Array]:
        """Return angles and rates of the hubs, (m,) each, rad and rad/s."""
        ...

    def holds(self, hub: Array) -> Array:
        """Return the torques that hold an arm with its hubs there, rad, (m,), N m."""
        ...

    def surprise(self, measured: Array) -> Array:
        """Return how far a measurement is off what is expected, (3 m,)."""
        ...

    def taken_in(self, sensors: tuple[int, ...]) -> tuple[int, ...]:
        """Return what tells how sensors behind the encoders are taken in: as before where it is the same."""
        ...

    def correct(self, surprise: Array, sensors: tuple[int, ...], most: Array) -> None:
        """Take in what some sensors are off, (3 m,); disturbances stay within ``most`` N m, (m,), either way."""

    def advance(self, torques: Pair, end: Array) -> None:
        """Predict a sample with the torques that act in it, and those at its end, N m."""

    def ahead(self, torques: list[Pair]) -> tuple[Array, Array]:
        """Return state and disturbances after some more samples, which stay the estimate's secret."""
        ...

    def usable(self, limits: Credible) -> bool:
        """Return whether the estimate can be that of an arm."""
        ...


class ModelBased(ABC):
    """A controller with an estimator.

    The first angles the encoders show say where the arm starts. Afterwards what cannot be is left out
    (:mod:`tmm_gen.control.estimators.credible`), and after a few samples in a row that went wrong the estimate starts
    anew.

    Parameters
    ----------
    problem : ControlProblem
        Sample time, bounds.
    estimator : Estimator
        Of the state the decision needs.
    delay : Delay
        Of the estimator's model.
    inertia : array, (m,)
        What each motor turns, kg m^2, for the safe law.
    """

    def __init__(self, problem: ControlProblem, estimator: Estimator, delay: Delay, inertia: Array) -> None:
        self.problem, self.estimator, self.delay, self.inertia = problem, estimator, delay, inertia
        self._widest = problem.torque
        self.limits = credible(problem, estimator.home, inertia, estimator.length)
        self.reset()

    def reset(self) -> None:
        """Forget all measurements, and what was told since."""
        self.problem = replace(self.problem, torque=self._widest)
        self.estimator.reset()
        self._past = np.tile(self.estimator.start, (self.delay.memory + 1, 1))
        self._hub, self._fresh, self._wrong = np.full(self.problem.count, np.nan), True, 0
        self._foreseen = PATIENCE  # the scene says how the arm starts
        self._moved = np.full(self.problem.count, np.nan)
        self._due = False
        self._window: Window | None = None
        self._passed = 0
        self._read = self.limits.sensors[self.problem.count :]
        self._forget()

    def follow(self, angles: Array) -> Status:
        """Take what the reference is to be over the horizon; see :class:`~tmm_gen.control.command.Controller`.

        Raises
        ------
        UserError
            If the arm stands on a hub.
        """
        self._require_movable()
        if not np.all(np.isfinite(angles)):
            return Status.NOT_FINITE
        self._window, self._passed = Window.of(np.asarray(angles, float), self.problem.sample_time), 0
        return Status.OK

    def _require_movable(self) -> None:
        if self.problem.motors.on_hub:
            raise UserError(
                "only arms whose motors are parts by name take another reference or payload while they run: write the "
                "arm by parts, or other numbers in the scene"
            )

    def limit(self, lower: Array, upper: Array) -> Status:
        """Take other bounds of the torques from the next command on, until :meth:`reset`.

        They are kept from then on, at once: where the last torque is beyond them, a bound of how fast torques change
        gives way. The scene's bounds stay the widest: what is beyond them is cut off.

        Parameters
        ----------
        lower, upper : array, (m,)
            N m.

        Returns
        -------
        Status
            ``OK``; ``NOT_FINITE``: one is not a number; ``INFEASIBLE``: they are crossed, or all beyond the scene's.
            What is not OK leaves the former bounds.
        """
        lower, upper = np.asarray(lower, float), np.asarray(upper, float)
        if not np.all(np.isfinite([lower, upper])):
            return Status.NOT_FINITE
        low, high = np.maximum(lower, self._widest[0]), np.minimum(upper, self._widest[1])
        if np.any(lower > upper) or np.any(low > high):
            return Status.INFEASIBLE
        self.problem = replace(self.problem, torque=(low, high))
        return Status.OK

    @abstractmethod
    def _forget(self) -> None:
        """Forget what was planned."""

    def _shift(self) -> None:  # noqa: B027  most plan nothing
        """Let what was planned move on by a sample."""

    def _look(self) -> None:  # noqa: B027  most prepare nothing
        """Prepare what can be for an estimate that is still to be corrected."""

    def _turned(self) -> None:  # noqa: B027  most have prepared nothing
        """Take note that the estimate is elsewhere than what was prepared is for."""

    @abstractmethod
    def decide(self, state: Array, disturbance: Array, last: Array) -> Command:
        """Return the torques for a state at which they begin to act; on failure their status only.

        Parameters
        ----------
        state : array, (s,)
            As the estimator has it.
        disturbance : array, (m,)
            N m.
        last : array, (m,)
            Torques chosen a sample before, N m.
        """

    def prepare(self) -> None:
        """Predict the next sample; see :class:`~tmm_gen.control.command.Controller`."""
        with np.errstate(all="ignore"):  # what overflows is found by its result
            if self._due:
                self.estimator.advance(self.delay.pair(self._past), self.delay.end(self._past))
                if not self.estimator.usable(self.limits):
                    self.estimator.reset()
                    self._wrong = PATIENCE
                self._due = False
                self._shift()
            self._look()

    def command(self, measured: Array, valid: Flags | None = None) -> Command:
        """Return the torques for a measurement; see :class:`~tmm_gen.control.command.Controller`."""
        self.prepare()
        with np.errstate(all="ignore"):
            return self._command(shown(measured, valid))

    def _command(self, measured: Array) -> Command:
        last, hub = self._past[-1], measured[: self.problem.count]
        moved = hub - self._hub
        steady = self.limits.is_move(self._hub, hub)
        command = self._decided(measured, self._rate(moved, steady), last)
        torque = command.torque
        if not command.status.optimal:
            # a hub that whirls moves too far in a sample, but like in the one before: it is to be braked all the more
            whirls = self.limits.is_move(self._moved, moved)
            torque = self._safe(hub, self._rate(moved, steady | whirls), last)
        self._hub, self._moved = hub, moved
        command = Command(self.problem.allowed(torque, last), command.status, command.iterations)
        self._past = np.vstack([self._past[1:], command.torque])
        self._due = True
        self._passed += 1
        return command

    def _rate(self, moved: Array, believed: Flags) -> Array:
        """Return what hubs have moved by as rates, (m,), rad/s; NaN where that is not to be believed."""
        return np.where(believed, moved, np.nan) / self.problem.sample_time

    def _safe(self, hub: Array, rate: Array, last: Array, wanted: Array | float = 0.0) -> Array:
        """Return the torques of the safe law, for rates that are wanted, (m,), rad/s.

        That of an arm on a hub brakes by the encoder alone. Motors by name hold the arm up as well, and where an
        encoder shows nothing the estimate stands in for it.
        """
        if self.problem.motors.on_hub:
            return safe_torque(self.problem, self.inertia, rate, last)
        there = self.limits.is_place(hub)
        held = self.estimator.holds(self._shown_angles(hub))
        rates = np.where(there, rate, self.estimator.hubs()[1])
        return safe_torque(self.problem, self.inertia, rates, last, held, wanted)

    def _shown_angles(self, hub: Array) -> Array:
        """Return where hubs are by the encoders, and by the estimate where one shows nothing."""
        return np.where(self.limits.is_place(hub), hub, self.estimator.hubs()[0])

    def _decided(self, measured: Array, rate: Array, last: Array) -> Command:
        """Return the torques, by what can be believed of a measurement."""
        count, none = self.problem.count, np.zeros(self.problem.count)
        hub = measured[:count]
        there = self.limits.is_place(hub)
        lost = not np.all(there)
        if not np.any(there) or (lost and (self._fresh or self._wrong >= PATIENCE)):
            return Command(none, Status.MEASUREMENT)
        if not lost:
            self._settle(hub, rate)
        surprise = self.estimator.surprise(measured)
        believed = self.limits.believed(surprise, self._foreseen >= PATIENCE)
        encoders = [sensor for sensor in believed if sensor < count]
        placed = len(encoders) == count
        if self.limits.is_foreseen(surprise):
            self._foreseen = min(self._foreseen + 1, PATIENCE)
        elif placed:
            self._foreseen = 0
        if encoders == list(np.flatnonzero(there)):  # no encoder is off
            self._read = self.estimator.taken_in(believed[len(encoders) :])
            self.estimator.correct(surprise, believed, self.limits.disturbance)
        elif self._wrong >= PATIENCE:  # and an encoder jumps, so that nobody knows where the arm is
            return Command(none, Status.MEASUREMENT)
        command = self._solved(last)
        wrong = not placed or not command.status.optimal
        self._wrong = min(self._wrong + 1, PATIENCE) if wrong else 0
        if command.status.optimal and len(believed) < len(self.limits.sensors):
            return Command(command.torque, Status.REDUCED, command.iterations)
        return command

    def _settle(self, hub: Array, rate: Array) -> None:
        """Start where the encoders say: at first, and when too much went wrong, as soon as they move as hubs do."""
        if self._fresh:
            self.estimator.turn(hub - self.estimator.home)
            self._turned()
            self._fresh = False
        elif self._wrong >= PATIENCE and np.all(np.isfinite(rate)):
            self.estimator.rest(hub, rate)
            self._turned()
            self._forget()
            self._wrong = self._foreseen = 0

    def _solved(self, last: Array) -> Command:
        state, disturbance = self.estimator.ahead(self.delay.known(self._past))
        if not np.all(np.isfinite(state)) or not np.all(np.isfinite(disturbance)):
            return Command(np.zeros(self.problem.count), Status.ESTIMATE)
        return self.decide(state, disturbance, last)
