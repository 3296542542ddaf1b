"""Nonlinear model predictive control by real-time iteration: one condensed quadratic program per sample.

M. Diehl, H. G. Bock, J. P. Schloeder, A real-time iteration scheme for nonlinear optimization in optimal feedback
control, SIAM J. Control Optim. 43 (2005). Zero-order: H. G. Bock, M. Diehl, E. Kostina, J. P. Schloeder, Constrained
optimal feedback control of systems governed by large differential algebraic equations (2007), level C.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.command import Command, Status
from tmm_gen.control.condensed import Condensed, Outputs
from tmm_gen.control.extended_kalman import ExtendedKalmanFilter, NonlinearFilter
from tmm_gen.control.linear import LinearModel
from tmm_gen.control.links import rest_state, target_state
from tmm_gen.control.model_based import ModelBased
from tmm_gen.control.qp import QuadraticProgram
from tmm_gen.control.response import response
from tmm_gen.control.step_model import StepModel
from tmm_gen.control.target import rest_with
from tmm_gen.control.terminal import end_rows
from tmm_gen.errors import UserError

Array = NDArray[np.float64]


class RealTimeIteration(ModelBased):
    """Nonlinear MPC, one iteration per sample, warm-started by the last solution shifted.

    Parameters
    ----------
    model : StepModel
        The generated step.
    linear : LinearModel
        Of the same step about the target.
    inertia : array, (m,)
        What each motor turns, kg m^2, for the safe law.
    zero_order : bool
        Whether to keep the sensitivities of the linear model, and its filter's gain, instead of computing those
        along the trajectory.
    """

    def __init__(
        self, model: StepModel, linear: LinearModel, inertia: Array, zero_order: bool = False
    ) -> None:
        problem = model.problem
        self.model, self.linear, self.zero_order = model, linear, zero_order
        self.end = end_rows(linear, problem.weights)
        slopes = response(linear, problem.horizon, self.end).slopes
        self.prepared = Condensed(problem, slopes, linear.goal)
        kind = NonlinearFilter if zero_order else ExtendedKalmanFilter
        self._program = QuadraticProgram(self.prepared.hessian, self.prepared.rows, self.prepared.inputs)
        super().__init__(problem, kind(model, linear), model.delay, inertia)

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
        """Forget all measurements, and what was aimed at."""
        self.goal, self.rest, self.moved = self.linear.goal, self.target, False
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
            ``OK``; ``NOT_FINITE``: there is no rest; ``INFEASIBLE``: the motors could not hold it.

        Raises
        ------
        UserError
            If sensitivities are those of the scene's target, or the arm stands on a hub.
        """
        scene = self.model.scene
        if self.zero_order or self.model.motors.on_hub:
            raise UserError(
                f"{scene.source.origin}: only full real-time iteration of motors by name takes another reference; "
                "take the controller 'rti', or write another control.reference."
            )
        if not np.all(np.isfinite(reference)):
            return Status.NOT_FINITE
        try:
            found = rest_with(scene, np.asarray(reference, float), "control.reference")
        except UserError:
            return Status.NOT_FINITE
        low, high = self.problem.torque
        if not np.all((found.goal.torque >= low) & (found.goal.torque <= high)):
            return Status.INFEASIBLE
        self.goal, self.rest, self.moved = found.goal, target_state(self.model, found), True
        return Status.OK

    def _forget(self) -> None:
        self._program.forget()
        self._plan = np.repeat(self.goal.torque[:, None], self.problem.horizon, axis=1)

    def decide(self, state: Array, disturbance: Array, last: Array) -> Command:
        """Solve one quadratic program about the last plan; see :class:`ModelBased`."""
        low, high = (bound[:, None] for bound in self.problem.torque)
        goal, unknown = self.goal, disturbance[:, None]
        plan = np.clip(np.hstack([self._plan[:, 1:], self._plan[:, -1:]]), low, high)
        inputs = np.vstack([np.hstack([last[:, None], plan[:, :-1]]) + unknown, plan + unknown])
        states = np.array(self.model.rollout(state, inputs))
        left = np.append(states[:, -1] - self.rest, plan[:, -1] + disturbance - goal.torque)
        tip, tip_rate, hub, hub_rate = np.split(self.rows @ states, 4)
        along = Outputs(tip, tip_rate, hub, hub_rate, self.end @ left)
        condensed = self.prepared if self.zero_order else self._linearised(state, states, inputs)
        renewed = condensed is not self.prepared
        solution = self._program.solve_softly(
            condensed.gradient(along, plan, last, disturbance),
            *condensed.bounds(
                along, plan, last, self.prepared.stopping, without=("tip",) if self.moved else ()
            ),
            soft=condensed.soft,
            hessian=condensed.hessian if renewed else None,
            rows=condensed.rows if renewed else None,
        )
        if not solution.status.optimal:
            self._plan = np.clip(goal.torque[:, None] - unknown, low, high) + np.zeros_like(plan)
            return Command(np.zeros(len(plan)), solution.status, solution.iterations)
        self._plan = plan + solution.point[: plan.size].reshape(plan.shape)
        return Command(self._plan[:, 0], solution.status, solution.iterations)

    def _linearised(self, state: Array, states: Array, inputs: Array) -> Condensed:
        """Return the quadratic program with sensitivities along a trajectory."""
        count, size, motors = inputs.shape[1], len(state), self.problem.count
        points = np.column_stack([state, states[:, :-1]])
        _, by_state, by_torques = self.model.rollout_slopes(points, inputs)
        transitions = np.array(by_state).reshape(size, count, size).transpose(1, 0, 2)
        drives = np.array(by_torques).reshape(size, count, 2, motors)
        slopes = np.zeros((4 * motors, count, motors, count))
        carried = np.zeros((size, motors, count))
        for stage in range(count):
            carried = np.tensordot(transitions[stage], carried, 1)
            if stage:
                carried[:, :, stage - 1] += drives[:, stage, 0]
            carried[:, :, stage] += drives[:, stage, 1]
            slopes[:, stage] = np.tensordot(self.rows, carried, 1)
        last = np.zeros((motors, motors, count))
        last[:, :, -1] = np.eye(motors)
        left = np.vstack([each.reshape(-1, motors * count) for each in (carried, last)])
        tip, tip_rate, hub, hub_rate = slopes.reshape(4, motors, count, motors * count)
        found = Outputs(tip, tip_rate, hub, hub_rate, self.end @ left)
        return Condensed(self.problem, found, self.goal)
