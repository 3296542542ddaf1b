"""Nonlinear model predictive control by real-time iteration: one condensed quadratic program per sample.

M. Diehl, H. G. Bock, J. P. Schloeder, A real-time iteration scheme for nonlinear optimization in optimal feedback
control, SIAM J. Control Optim. 43 (2005). Zero-order: H. G. Bock, M. Diehl, E. Kostina, J. P. Schloeder, Constrained
optimal feedback control of systems governed by large differential algebraic equations (2007), level C.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.command import Command, Status
from tmm_gen.control.estimators.extended_kalman import ExtendedKalmanFilter, NonlinearFilter
from tmm_gen.control.laws.movable import Movable
from tmm_gen.control.prediction.linear import LinearModel
from tmm_gen.control.prediction.step_model import StepModel
from tmm_gen.control.quadratic.condensed import Condensed
from tmm_gen.control.quadratic.constant import Constant
from tmm_gen.control.quadratic.prepared import Prepared
from tmm_gen.control.quadratic.qp import QuadraticProgram
from tmm_gen.control.quadratic.response import Response, split_outputs
from tmm_gen.control.quadratic.terminal import end_rows
from tmm_gen.control.quadratic.walls import Wall
from tmm_gen.control.task.delay import Pair

Array = NDArray[np.float64]

AWAY = 0.05
"""Sensitivities of zero order are renewed where a joint is to rest so much elsewhere, rad."""
FAR = 1.5
"""Where a joint is so far from where it is to rest, they are taken about where the arm is, rad: an arm without gears,
if folded, may turn so much more easily that it would be thrown from side to side for ever."""
FAR_AT_WALLS = 0.75
"""The same where there are walls: an arm that meets one there must be known as it is there, or swings before it."""
TURNED = 0.5
"""How far a joint may turn meanwhile before they are taken anew, rad."""
MOVING = 1e-3
"""What a reference moves by in a sample that is not about to rest, rad."""


class RealTimeIteration(Movable):
    """Nonlinear MPC, one iteration per sample, warm-started by the last solution shifted.

    All but a few sums and the quadratic program comes before the measurement, about the motion that the predicted
    estimate makes along the last plan. What the measurement changes of the estimate is then taken in by its
    sensitivities: those along that motion, or of zero order those of the linear model. Where the estimate starts anew,
    reads other sensors than before or is at its limits, the motion is rolled out once more.

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
        along the trajectory. They are renewed where the arm is told to carry something else, or to rest elsewhere,
        and while it is far from there: what a torque does to an arm so much lighter, or folded, would be taken for a
        fraction of it, and iterations would overshoot ever more.
    """

    def __init__(
        self, model: StepModel, linear: LinearModel, inertia: Array, zero_order: bool = False
    ) -> None:
        problem = model.problem
        self.model = self.unchanged = model
        self.linear, self.zero_order = linear, zero_order
        self.end = end_rows(linear, problem.weights)
        self.walls = tuple(Wall.of(model.scene, keep) for keep in problem.keeps)
        self._unladen = Constant(problem, linear, self.end, tuple(model.places("angle")), self.walls)
        self._use(self._unladen)
        kind = NonlinearFilter if zero_order else ExtendedKalmanFilter
        super().__init__(problem, kind(model, linear), model.delay, inertia)

    def _use(self, constant: Constant) -> None:
        """Take sensitivities of zero order, and the program that is made of them."""
        self.constant = constant
        self._program = QuadraticProgram.of(constant.condensed)

    @property
    def prepared(self) -> Condensed:
        """The program at the target, with what is carried."""
        return self.constant.condensed

    @property
    def response(self) -> Response:
        """How outputs answer there."""
        return self.constant.response

    @property
    def by_estimate(self) -> Array:
        """What changes of the estimate make of the outputs there but for walls, (4 m N + r, s + m)."""
        return self.constant.by_estimate

    def reset(self) -> None:
        """Forget all measurements, what was aimed at and carried."""
        if self.constant is not self._unladen:
            self._use(self._unladen)
        self._renewed_at = self._aimed = self.linear.goal.hub
        super().reset()

    def carry(self, payload: float) -> Status:
        """Take another payload; see :class:`Movable`."""
        status = super().carry(payload)
        if status is Status.OK and self.zero_order:
            self._renew()
        return status

    def _renew(self, hub: Array | None = None) -> None:
        """Take sensitivities of zero order about the rest that is aimed at, or that of the same shape elsewhere."""
        state, hub = self.rest.copy(), self.goal.hub if hub is None else hub
        state[self.model.places("angle")] += self.model.motors.turned @ (hub - self.goal.hub)
        self._use(self._unladen.about(self.model, state, self.goal.torque))
        self._renewed_at = hub

    def _keep_up(self) -> None:
        """Renew sensitivities of zero order where the reference has come to rest elsewhere, or moves slowly.

        While the arm is far from there, take them about where it is.
        """
        goal, (hub, _) = self.goal.hub, self.estimator.hubs()
        moving = np.max(np.abs(goal - self._aimed)) > MOVING
        self._aimed = goal
        if np.max(np.abs(hub - goal)) > (FAR_AT_WALLS if self.walls else FAR):
            if np.max(np.abs(hub - self._renewed_at)) > TURNED:
                self._renew(hub)
        elif not moving and np.max(np.abs(goal - self._renewed_at)) > AWAY:
            self._renew()

    def _forget(self) -> None:
        self._program.forget()
        self._plan = np.repeat(self.goal.torque[:, None], self.problem.horizon, axis=1)
        self._turned()

    def _turned(self) -> None:
        self._about: Prepared | None = None

    def _shift(self) -> None:
        if self.zero_order and (self.model.carries or self.walls):
            self._keep_up()
        low, high = (bound[:, None] for bound in self.problem.torque)
        self._plan = np.clip(np.hstack([self._plan[:, 1:], self._plan[:, -1:]]), low, high)
        self._turned()

    def _look(self) -> None:
        if self._about is None:
            self._about = self._rolled_out()

    def _rolled_out(self) -> Prepared:
        """Return what the program needs, about the motion from the estimate as it is."""
        known = self.delay.known(self._past)
        along, by_estimate, condensed = self._along(*self.estimator.ahead(known), self._past[-1])
        if not self.zero_order:
            by_estimate = by_estimate @ self._until(known)
        return Prepared(np.append(*self.estimator.ahead([])), self._read, along, by_estimate, condensed)

    def _until(self, known: list[Pair]) -> Array:
        """Return what changes of the estimate make of it until the plan begins to act, (s + m, s + m)."""
        size, count = self.model.size, self.problem.count
        found = np.eye(size + count)
        for number, pair in enumerate(known):
            state, disturbance = self.estimator.ahead(known[:number])
            acting = np.concatenate([torque + disturbance for torque in pair])
            _, by_state, by_torques = (np.array(item) for item in self.model.sample_slopes(state, acting))
            one = np.eye(size + count)
            one[:size] = np.column_stack([by_state, by_torques[:, :count] + by_torques[:, count:]])
            found = one @ found
        return found

    def _solved(self, last: Array) -> Command:
        state, disturbance = self.estimator.ahead([])
        now = np.append(state, disturbance)
        if not np.all(np.isfinite(now)):
            return Command(np.zeros(self.problem.count), Status.ESTIMATE)
        about = self._about
        at_limit = np.any(np.abs(disturbance) >= self.limits.disturbance)
        if about is None or at_limit or about.read != self._read or not np.all(np.isfinite(about.along)):
            about = self._about = self._rolled_out()
        along = about.along + about.by_estimate @ (now - about.estimate)
        return self._optimal(about.condensed, along, disturbance, last)

    def decide(self, state: Array, disturbance: Array, last: Array) -> Command:
        """Solve one quadratic program about the last plan; see :class:`ModelBased`."""
        self._shift()
        along, _, condensed = self._along(state, disturbance, last)
        return self._optimal(condensed, along, disturbance, last)

    def _optimal(self, condensed: Condensed, stacked: Array, disturbance: Array, last: Array) -> Command:
        """Solve a quadratic program about the plan, along which the outputs are these."""
        low, high = (bound[:, None] for bound in self.problem.torque)
        plan, along = self._plan, split_outputs(stacked, self._plan.shape, len(self.walls))
        renewed = condensed is not self.prepared
        solution = self._program.solve_softly(
            condensed.gradient(along, plan, last, disturbance, self._wanted()[0]),
            *condensed.bounds(
                along,
                plan,
                last,
                self._unladen.condensed.stopping,
                without=("tip",) if self.moved else (),
                torque=self.problem.torque,
            ),
            soft=condensed.soft,
            hessian=condensed.hessian if renewed else None,
            rows=condensed.rows if renewed else None,
        )
        if not solution.status.optimal:
            held = self.goal.torque - disturbance
            self._plan = np.clip(held[:, None], low, high) + np.zeros_like(plan)
            return Command(np.zeros(len(plan)), solution.status, solution.iterations)
        self._plan = plan + solution.point[: plan.size].reshape(plan.shape)
        return Command(self._plan[:, 0], solution.status, solution.iterations)

    def _along(self, state: Array, disturbance: Array, last: Array) -> tuple[Array, Array, Condensed]:
        """Roll out along the plan from a state at which it begins to act; with arguments as for :meth:`decide`.

        Returns
        -------
        along : array, (4 m N + r + w N,)
            Outputs, stacked.
        by_start : array, (4 m N + r + w N, s + m)
            What changes of state and disturbance make of them; of zero order, of the estimate before the look over the
            delay.
        condensed : Condensed
            With the sensitivities by the torques.
        """
        plan, unknown = self._plan, disturbance[:, None]
        inputs = np.vstack([np.hstack([last[:, None], plan[:, :-1]]) + unknown, plan + unknown])
        states = np.array(self.model.rollout(state, inputs))
        _, end = self._wanted()
        left = np.append(states[:, -1] - end.state, plan[:, -1] + disturbance - end.torque)
        angles = states[self.model.places("angle")].T
        along = np.concatenate(
            [(self.rows @ states).ravel(), self.end @ left, *(wall.along(angles) for wall in self.walls)]
        )
        if self.zero_order:
            kept = self.constant
            return along, *(kept.beside_walls(angles) if self.walls else (kept.by_estimate, kept.condensed))
        return along, *self._linearised(state, states, inputs)

    def _linearised(self, state: Array, states: Array, inputs: Array) -> tuple[Array, Condensed]:
        """Return sensitivities along a trajectory: by state and disturbance, and the program with those by torques."""
        count, size, motors = inputs.shape[1], len(state), self.problem.count
        points = np.column_stack([state, states[:, :-1]])
        _, by_state, by_torques = self.model.rollout_slopes(points, inputs)
        transitions = np.array(by_state).reshape(size, count, size).transpose(1, 0, 2)
        drives = np.array(by_torques).reshape(size, count, 2, motors)
        width = motors * count + size + motors
        slopes = np.zeros((4 * motors, count, width))
        places = self.model.places("angle")
        normals = [wall.slopes(states[places].T) for wall in self.walls]
        distances = np.zeros((len(normals), count, width))
        carried = np.zeros((size, width))
        by_plan = carried[:, : motors * count].reshape(size, motors, count)
        by_start, by_unknown = carried[:, motors * count : -motors], carried[:, -motors:]
        by_start[:] = np.eye(size)
        for stage in range(count):
            carried[:] = transitions[stage] @ carried
            before, then = drives[:, stage, 0], drives[:, stage, 1]
            if stage:
                by_plan[:, :, stage - 1] += before
            by_plan[:, :, stage] += then
            by_unknown += before + then
            slopes[:, stage] = self.rows @ carried
            for distance, normal in zip(distances, normals, strict=True):
                distance[stage] = normal[stage] @ carried[places]
        last = np.zeros((motors, width))
        last[:, count - 1 : motors * count : count] = last[:, -motors:] = np.eye(motors)
        every = np.vstack(
            [
                slopes.reshape(-1, width),
                self.end @ np.vstack([carried, last]),
                distances.reshape(-1, width),
            ]
        )
        found = split_outputs(every[:, : motors * count], (motors, count), len(normals))
        return every[:, motors * count :], Condensed(self.problem, found, self.goal)
