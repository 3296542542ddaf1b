"""What moves at run time: the reference, by a step or as it is to be over the horizon; and the payload."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.command import Status
from tmm_gen.control.estimators.extended_kalman import NonlinearFilter
from tmm_gen.control.goals.target import rest_with
from tmm_gen.control.goals.window import Window
from tmm_gen.control.laws.model_based import ModelBased
from tmm_gen.control.laws.pose import Pose, pose_in
from tmm_gen.control.prediction.linear import LinearModel
from tmm_gen.control.prediction.links import rest_state, target_state
from tmm_gen.control.prediction.step_model import StepModel
from tmm_gen.control.task.terms import Goal, Wanted
from tmm_gen.errors import UserError

Array = NDArray[np.float64]


class Movable(ModelBased):
    """A controller that predicts with the generated step, and aims at what it is told.

    Attributes
    ----------
    goal : Goal
        Where the arm is to rest in the end.
    rest : array, (s,)
        The state there.
    moved : bool
        Whether that is another than the scene's, or there is a way to it.
    """

    model: StepModel
    unchanged: StepModel
    linear: LinearModel
    estimator: NonlinearFilter

    @cached_property
    def rows(self) -> Array:
        """Rows that give tips, tip rates, hubs, hub rates from the state, (4 m, s)."""
        model, motors = self.model, self.model.motors
        return np.vstack(
            [
                model.rows(rows, quantity)
                for rows in (motors.tip, motors.hub)
                for quantity in ("angle", "rate")
            ]
        )

    @property
    def target(self) -> Array:
        """The state at the target of the scene, (s,)."""
        return rest_state(self.model, self.linear)

    def reset(self) -> None:
        """Forget all measurements, what was aimed at and carried."""
        self.model = self.unchanged
        self.estimator.carry(self.model, 0.0)
        self.goal, self.rest, self.moved = self.linear.goal, self.target, False
        self._poses: list[Pose] = []
        super().reset()

    def aim(self, reference: Array) -> Status:
        """Take another reference from the next sample on: a step, or a little at a time.

        The cost to go stays that of the scene's target, and tips are not bounded any more: nobody knows what would be
        beyond. Where the arm finds no rest there, or the motors cannot hold it, the former reference stays.

        Parameters
        ----------
        reference : array, (m,)
            Joint angles, rad.

        Returns
        -------
        Status
            ``OK``; ``NOT_FINITE``: there is no rest; ``INFEASIBLE``: the motors could not hold it, or it is more than
            a hundred turns from where the arm starts, where no encoder is believed.

        Raises
        ------
        UserError
            If the arm stands on a hub.
        """
        self._require_movable()
        scene = self.model.scene
        if not np.all(np.isfinite(reference)):
            return Status.NOT_FINITE
        try:
            found = rest_with(scene, np.asarray(reference, float), "control.reference")
        except UserError:
            return Status.NOT_FINITE
        status = self._rest_in(Pose(target_state(self.model, found), found.goal.torque))
        if status is Status.OK:
            self._window, self._poses = None, []
        return status

    def follow(self, angles: Array) -> Status:
        """Take what the reference is to be over the horizon; see :class:`ModelBased` and :meth:`aim`.

        Sags and torques are those of the motion, by the kernel (:func:`~tmm_gen.control.laws.pose.pose_in`); poses that
        were found for the sample before are not sought again.
        """
        self._require_movable()
        if not np.all(np.isfinite(angles)):
            return Status.NOT_FINITE
        window = Window.of(np.asarray(angles, float), self.problem.sample_time)
        former, former_poses, passed = self._window, self._poses, self._passed
        poses: list[Pose] = []
        near = Pose(self.rest, self.goal.torque)
        for i in range(window.count):
            motion, known = window.at(i), former is not None and i + passed < former.count
            if known:
                near = former_poses[i + passed]
            if known and former is not None and np.array_equal(former.at(i + passed), motion):
                poses.append(near)
                continue
            found = pose_in(self.model, motion, near)
            if found is None:
                return Status.NOT_FINITE
            poses.append(found)
            near = found
        status = self._rest_in(pose_in(self.model, window.at(window.count), near))
        if status is Status.OK:
            self._window, self._poses, self._passed = window, poses, 0
        return status

    def carry(self, payload: float) -> Status:
        """Take another payload from the next sample on, until :meth:`reset`: predict, aim and hold the arm with it.

        What is aimed at, and the way there, stay; sags and torques are found anew, and sensitivities of zero order
        about the rest that is aimed at. The gains of a filter that has constant ones and the cost to go stay those of
        the scene's payload.

        Parameters
        ----------
        payload : float
            Mass at the tip, or of ``control.payload_body``, kg.

        Returns
        -------
        Status
            ``OK``; ``NOT_FINITE``: it is negative or not a number, or there is no rest with it; ``INFEASIBLE``: the
            motors could not hold it where the arm is to rest. What is not OK leaves the former payload.

        Raises
        ------
        UserError
            If the arm stands on a hub, or has no one mass at its end and says of none that it is the payload.
        """
        self._require_movable()
        if not self.model.carries:
            raise UserError(
                f"{self.model.scene.source.origin}: only arms with one [[body]] at their end, and with a mass, take "
                'another payload. Of several say which: `payload_body = "..."` in [control].'
            )
        if not 0.0 <= payload < np.inf:
            return Status.NOT_FINITE
        try:
            model = self.unchanged.carrying(payload)
        except UserError:  # no mass that a scene may have
            return Status.NOT_FINITE
        poses = list(self._poses)
        for i in range(self._passed, len(poses)):
            assert self._window is not None
            found = pose_in(model, self._window.at(i), poses[i])
            if found is None:
                return Status.NOT_FINITE
            poses[i] = found
        still = np.zeros((3, self.problem.count))
        still[0] = self.goal.hub
        status = self._rest_in(pose_in(model, still, Pose(self.rest, self.goal.torque)))
        if status is Status.OK:
            self.model, self._poses = model, poses
            assert self.linear.lift.payload is not None
            self.estimator.carry(model, payload - self.linear.lift.payload)
            if self._fresh:
                self._begin_at_rest()
        return status

    def _begin_at_rest(self) -> None:
        """Start from rest with what is carried: nothing has been measured yet."""
        still, size = np.zeros((3, self.problem.count)), self.model.size
        still[0] = self.estimator.home
        found = pose_in(self.model, still, Pose(self.estimator.estimate[:size], self._past[-1]))
        if found is not None and self._holds(found):
            self.estimator.begin(found.state)
            self._past[:] = found.torque

    def _holds(self, pose: Pose) -> bool:
        """Return whether motors can hold the arm in a pose, within the bounds in force."""
        low, high = self.problem.torque
        return bool(np.all((pose.torque >= low) & (pose.torque <= high)))

    def _rest_in(self, still: Pose | None) -> Status:
        """Aim at rest in a pose in the end, if there is such and the motors can hold it."""
        if still is None:
            return Status.NOT_FINITE
        if not self._holds(still):
            return Status.INFEASIBLE
        tip, _, hub, _ = np.split(self.rows @ still.state, 4)
        if not np.all(self.limits.is_place(hub)):
            return Status.INFEASIBLE
        self.goal, self.rest, self.moved = Goal(tip, hub, still.torque), still.state, True
        self._turned()
        return Status.OK

    def _require_movable(self) -> None:
        try:
            super()._require_movable()
        except UserError as error:
            raise UserError(f"{self.model.scene.source.origin}: {error}") from None

    def _wanted(self) -> tuple[Wanted, Pose]:
        """Return what is wanted over the horizon, its end reckoned from the pose that is wanted there."""
        still = Pose(self.rest, self.goal.torque)
        if self._window is None:
            return Wanted.still(self.goal), still
        first = self.delay.whole + self._passed
        poses = (self._poses[first:] + [still] * self.problem.horizon)[: self.problem.horizon]
        outputs = self.rows @ np.column_stack([pose.state for pose in poses])
        tip, tip_rate, hub, hub_rate = np.split(outputs, 4)
        torque = np.column_stack([pose.torque for pose in poses])
        return Wanted(tip, hub, tip_rate, hub_rate, torque, np.zeros(1)), poses[-1]
