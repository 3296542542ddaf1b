"""Linear model predictive control: condensed, free of offset, delay compensated."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.command import Command, Status
from tmm_gen.control.estimators.kalman import KalmanFilter
from tmm_gen.control.goals.window import Window
from tmm_gen.control.laws.following import Following
from tmm_gen.control.laws.model_based import ModelBased
from tmm_gen.control.laws.safe import BRAKE_TIME
from tmm_gen.control.prediction.linear import LinearModel
from tmm_gen.control.prediction.linear_target import Place, Places
from tmm_gen.control.quadratic.condensed import Condensed
from tmm_gen.control.quadratic.qp import QuadraticProgram, Solution
from tmm_gen.control.quadratic.response import response
from tmm_gen.control.quadratic.terminal import end_rows
from tmm_gen.control.task.problem import ControlProblem
from tmm_gen.control.task.terms import Goal, Wanted
from tmm_gen.errors import UserError

Array = NDArray[np.float64]

REACH = 0.5
"""How far from where the arm is a linear model is taken to be good for at least, rad."""
REACH_OF_WAY = 1.25
"""The same, relative to each motor's way from start to target, which the scene asks of it anyway."""

LIGHTER, HEAVIER = 0.85, 1.5
"""Between what inertia of what a motor turns, relative to the model's, it is: a lighter arm vibrates faster, and is
thrown further by what torques are thought to make of it."""
APPROACH_TIME = 4.0 * BRAKE_TIME
"""Time constant with which hubs come near where the model is not good, s: with the brake's critically damped."""


class LinearMpc(ModelBased):
    """Linear MPC with a Kalman filter; everything but a gradient and bounds is prepared once.

    Where motors are parts by name the reference may move and the payload change: the model is the same about any
    place where the arm rests, and it is asked to bring the arm so far only as it does from the scene's start to its
    target. Where the arm is bent otherwise by more than that, or carries so much less or more that it is another one,
    hubs are brought to the reference by the safe law with rates that are wanted: by what a motor feels itself, whatever
    the arm beyond it does.

    Parameters
    ----------
    model : LinearModel
        By links or by modes.
    problem : ControlProblem
        What is to be solved at each sample.
    inertia : array, (m,)
        What each motor turns, kg m^2, for the safe law.
    """

    estimator: KalmanFilter

    def __init__(self, model: LinearModel, problem: ControlProblem, inertia: Array) -> None:
        self.model = model
        self.end = end_rows(model, problem.weights)
        self.response = response(model, problem.horizon, self.end)
        self.following = Following(model, problem.sample_time)
        self.condensed = Condensed(problem, self.response.slopes, model.goal)
        self.reach = np.maximum(REACH, REACH_OF_WAY * np.abs(model.goal.hub - model.start_hub))
        self._program = QuadraticProgram.of(self.condensed)
        super().__init__(problem, KalmanFilter(model, problem), model.delay, inertia)

    def reset(self) -> None:
        """Forget all measurements, what was aimed at and carried."""
        self.reference, self.moved, self._more = self.model.goal.hub, False, 0.0
        self._fits = True
        self.estimator.base = Place.of(self.model)
        super().reset()

    def aim(self, reference: Array) -> Status:
        """Take another reference from the next sample on: a step, or a little at a time.

        Sensitivities and the cost to go stay those of the scene's target, and tips are not bounded any more.

        Parameters
        ----------
        reference : array, (m,)
            Joint angles, rad.

        Returns
        -------
        Status
            ``OK``; ``NOT_FINITE``: one is not a number; ``INFEASIBLE``: the motors could not hold the arm there, or it
            is more than a hundred turns from where the arm starts, where no encoder is believed. What is not OK leaves
            the former reference.

        Raises
        ------
        UserError
            If the arm stands on a hub.
        """
        self._require_movable()
        reference = np.array(reference, float)
        status = self._rests(reference, self._more)
        if status is Status.OK:
            self.reference, self.moved, self._window = reference, True, None
        return status

    def follow(self, angles: Array) -> Status:
        """Take what the reference is to be over the horizon; see :class:`ModelBased` and :meth:`aim`."""
        self._require_movable()
        angles = np.array(angles, float)
        status = self._rests(angles[-1], self._more) if np.all(np.isfinite(angles)) else Status.NOT_FINITE
        if status is Status.OK:
            self.reference, self.moved = angles[-1], True
            self._window, self._passed = Window.of(angles, self.problem.sample_time), 0
        return status

    def carry(self, payload: float) -> Status:
        """Take another payload from the next sample on, until :meth:`reset`: what holds the arm up is that with it.

        Sensitivities, and how beams sag, stay those of the scene's payload.

        Parameters
        ----------
        payload : float
            Mass at the tip, kg.

        Returns
        -------
        Status
            ``OK``; ``NOT_FINITE``: it is negative or not a number; ``INFEASIBLE``: the motors could not hold it where
            the arm is to rest. What is not OK leaves the former payload.

        Raises
        ------
        UserError
            If the arm stands on a hub, or no payload makes a difference to what holds it up.
        """
        self._require_movable()
        lift = self.model.lift
        if lift.payload is None or not lift.carries:
            raise UserError(
                "only arms with one mass at their end, or control.payload_body, that has to be held up tell linear "
                "controllers of another payload: leave it as it is, or take `rti`"
            )
        if not 0.0 <= payload < np.inf:
            return Status.NOT_FINITE
        status = self._rests(self.reference, payload - lift.payload)
        if status is Status.OK:
            self._more = payload - lift.payload
            self._fits = self.payloads[0] <= payload <= self.payloads[1]
            self.estimator.base = self.places.at(self.model.goal.hub, self._more)
            self.estimator.stand(self.places.at(self.estimator.place.goal.hub, self._more))
        return status

    def _rests(self, hub: Array, more: float) -> Status:
        """Return whether the arm can be at rest with hubs there and some more payload."""
        torque, (low, high) = self.places.at(hub, more).goal.torque, self.problem.torque
        if not np.all(np.isfinite(hub)):
            return Status.NOT_FINITE
        held = bool(np.all((torque >= low) & (torque <= high)))
        return Status.OK if held and np.all(self.limits.is_place(hub)) else Status.INFEASIBLE

    @cached_property
    def places(self) -> Places:
        """Where the arm can rest."""
        still, torque = (each[0] for each in self.following.terms)
        return Places.of(self.model, still, torque)

    @cached_property
    def range(self) -> Array:
        """How far from the scene's target hubs may be for the model to be good, (m,), rad; infinite if free."""
        return np.where(self.model.lift.free(self.model.goal.hub), np.inf, self.reach)

    @cached_property
    def payloads(self) -> tuple[float, float]:
        """The least and the largest payload that the model is taken to be good for, kg."""
        return self.model.lift.payloads(self.model.goal.hub, LIGHTER, HEAVIER)

    def _forget(self) -> None:
        self._program.forget()

    def _decided(self, measured: Array, rate: Array, last: Array) -> Command:
        self._seen = measured[: self.problem.count], rate
        return super()._decided(measured, rate, last)

    def _solved(self, last: Array) -> Command:
        if self.problem.motors.on_hub:
            return super()._solved(last)
        self._stand_near()
        hub, rate = self._seen
        angles = self._shown_angles(hub)
        if self._fits and np.all(np.abs(angles - self.model.goal.hub) <= self.range):
            return super()._solved(last)
        self._program.forget()
        return Command(self._safe(hub, rate, last, self._towards(angles)), Status.OK)

    def _towards(self, angles: Array) -> Array:
        """Return the rates that bring hubs to the reference, (m,), rad/s."""
        wanted, rate = self.reference, np.zeros(self.problem.count)
        if self._window is not None:
            wanted, rate, _ = self._window.at(self._passed)
        rate = rate + np.clip(wanted - angles, -self.reach, self.reach) / APPROACH_TIME
        return np.clip(rate, -self.problem.hub_rate, self.problem.hub_rate)

    def _stand_near(self) -> None:
        """Count from where the reference is, or from as near to it as the model is good for from where the arm is."""
        (hub, _), place = self.estimator.hubs(), self.estimator.place
        wanted = self.reference if self._window is None else self._window.at(self._passed)[0]
        if not np.all(np.isfinite(hub)):
            return
        off = wanted - hub
        near = np.where(np.abs(off) <= self.reach, wanted, hub + np.clip(off, -self.reach, self.reach))
        if np.any(near != place.goal.hub):
            self.estimator.stand(self.places.at(near, self._more))

    def decide(self, state: Array, disturbance: Array, last: Array) -> Command:
        """Solve the quadratic program about no torque at all; see :class:`ModelBased`."""
        solution = self.planned(state, disturbance, last)
        if not solution.status.optimal:
            return Command(np.zeros(self.problem.count), solution.status, solution.iterations)
        first = solution.point[: self.condensed.inputs : self.problem.horizon]
        return Command(first, solution.status, solution.iterations)

    def planned(self, state: Array, disturbance: Array, last: Array) -> Solution:
        """Return the torques over the horizon, and the slacks behind them, with arguments as for :meth:`decide`."""
        made, goal = self.response, self.estimator.place.goal
        pushed = disturbance - goal.torque
        found = made.by_state @ state + made.by_constant @ pushed + made.by_last @ last
        along = made.outputs(found + self.offsets(goal))
        nothing = np.zeros((self.problem.count, self.problem.horizon))
        return self._program.solve_softly(
            self.condensed.gradient(along, nothing, last, disturbance, self._wanted(goal)),
            *self.condensed.bounds(
                along, nothing, last, without=("tip",) if self.moved else (), torque=self.problem.torque
            ),
            soft=self.condensed.soft,
        )

    def offsets(self, goal: Goal) -> Array:
        """Return the outputs at a goal, stacked over the horizon, to which those off it are added."""
        still = np.zeros(self.problem.count)
        targets = np.repeat(np.concatenate([goal.tip, still, goal.hub, still]), self.problem.horizon)
        return np.concatenate([targets, np.zeros(len(self.response.slopes.end))])

    def _wanted(self, goal: Goal) -> Wanted:
        """Return what is wanted over the horizon: rest at a goal, or a motion that goes through it now."""
        if self._window is None:
            return Wanted.still(goal)
        ahead, horizon = self.delay.whole, self.problem.horizon
        return self.following.wanted(self._window, self._passed, ahead, horizon, self.end, goal)
