"""Proportional-derivative control of the hubs, along a step, a shaped one, or a way with torques known beforehand."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.command import Command, Flags, Status, shown
from tmm_gen.control.estimators.credible import FARTHEST, JUMP, PATIENCE
from tmm_gen.control.goals.way import Way
from tmm_gen.control.laws.safe import safe_torque
from tmm_gen.control.task.problem import ControlProblem
from tmm_gen.control.task.terms import Goal

Array = NDArray[np.float64]


class PdController:
    """``u = u_k + p (reference_k - hub) + d (reference_k' - hub')`` for each motor, clipped.

    Rates are the encoders' differences.

    Parameters
    ----------
    problem : ControlProblem
        Sample time, bounds, start.
    proportional, derivative : array, (m,)
        N m/rad, N m s/rad.
    goal : Goal
        Where the hubs are to go, rad, and the torques that hold the arm there, N m.
    way : Way
        How the reference goes there, and the torques along it.
    inertia : array, (m,)
        What each motor turns, kg m^2, for the safe law.
    start : array, (m,), optional
        Torques that act before the first, N m; by default none.
    """

    def __init__(
        self,
        problem: ControlProblem,
        proportional: Array,
        derivative: Array,
        goal: Goal,
        way: Way,
        inertia: Array,
        start: Array | None = None,
    ) -> None:
        self.problem, self.inertia, self.goal = problem, inertia, goal
        self.proportional, self.derivative = proportional, derivative
        self.way = way
        self.start = np.zeros(problem.count) if start is None else start
        self.reset()

    def reset(self) -> None:
        """Forget all measurements."""
        nowhere = np.full(self.problem.count, math.nan)
        self._sample, self._hub, self._last, self._start = 0, nowhere, self.start, nowhere
        self._wrong, self._gap, self._clock = PATIENCE, False, 0

    def follow(self, angles: Array) -> Status:
        """Do nothing: the whole way is known beforehand, since shapers and quintics need it."""
        return Status.OK

    def prepare(self) -> None:
        """Do nothing: there is nothing to prepare."""

    def command(self, measured: Array, valid: Flags | None = None) -> Command:
        """Return the torques for a measurement; see :class:`~tmm_gen.control.command.Controller`."""
        with np.errstate(all="ignore"):  # what is not finite is not believed
            return self._command(shown(measured, valid)[: self.problem.count])

    def _command(self, hub: Array) -> Command:
        self._clock += 1
        if not self._believed(hub):
            self._gap = True
            unknown = np.full(len(hub), math.nan)
            self._last = safe_torque(self.problem, self.inertia, unknown, self._last)
            return Command(self._last, Status.MEASUREMENT)
        unknown_rate = self._gap or bool(np.any(np.isnan(self._hub)))
        rate = np.zeros(len(hub)) if unknown_rate else (hub - self._hub) / self.problem.sample_time
        self._hub, self._gap = hub, False
        share, speed, torque = self.way.at(self._clock - 1 if self.way.absolute else self._sample)
        begin, along = self._start, self.goal.hub - self._start
        if self.way.absolute:
            begin, along = np.zeros(len(hub)), np.ones(len(hub))
        self._sample += 1
        torque = torque + self.proportional * (begin + share * along - hub)
        torque = torque + self.derivative * (speed * along - rate)
        self._last = self.problem.allowed(torque, self._last)
        return Command(self._last)

    def _believed(self, hub: Array) -> bool:
        """Return whether hubs can be there; what jumped is believed if it stays, and the reference starts anew."""
        if not np.all(np.isfinite(hub) & (np.abs(hub - self.goal.hub) <= FARTHEST)):
            return False
        if np.any(np.isnan(self._hub)) or np.any(np.abs(hub - self._hub) > JUMP):
            if self._wrong < PATIENCE:
                self._wrong += 1
                return False
            self._start, self._sample, self._gap = hub, 0, True
        self._wrong = 0
        return True
