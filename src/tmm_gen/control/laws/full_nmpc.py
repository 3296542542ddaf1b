"""Nonlinear model predictive control to convergence, by CasADi: the reference of the real-time iterations.

Multiple shooting, stage by stage: torques, a slack for each soft bound, and the state after them, with the last torques
as more states, since their changes are weighed. fatrop exploits the stages (L. Vanroye, A. Sathya, J. De Schutter,
W. Decre, FATROP, 2023); IPOPT takes the same problem as a sparse one.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.command import Command, Status
from tmm_gen.control.estimators.extended_kalman import ExtendedKalmanFilter
from tmm_gen.control.laws.movable import Movable
from tmm_gen.control.prediction.linear import LinearModel
from tmm_gen.control.prediction.step_model import StepModel
from tmm_gen.control.quadratic.terminal import end_rows
from tmm_gen.control.quadratic.walls import Wall
from tmm_gen.control.task.terms import Kind

Array = NDArray[np.float64]
Solver = Literal["fatrop", "ipopt"]

_OPTIONS: dict[str, dict[str, Any]] = {
    "fatrop": {
        "structure_detection": "auto",
        "expand": True,
        "print_time": False,
        "fatrop": {"print_level": 0, "tol": 1e-10, "max_iter": 200},
    },
    "ipopt": {
        "expand": True,
        "print_time": False,
        "ipopt": {"print_level": 0, "sb": "yes", "tol": 1e-10, "max_iter": 200},
    },
}


_OUTPUTS = ("tip", "tip_rate", "hub", "hub_rate")
"""In the order of :attr:`Movable.rows`."""


@dataclass(frozen=True, eq=False)
class _Programme:
    """The nonlinear programme of a model as CasADi takes it, and its bounds; rows ``of_tips`` bound tips."""

    model: StepModel
    solve: Any
    low: Array
    high: Array
    low_rows: Array
    high_rows: Array
    of_tips: NDArray[np.bool_]


class FullNmpc(Movable):
    """Solves the nonlinear problem to convergence at every sample.

    Parameters
    ----------
    model : StepModel
        The generated step.
    linear : LinearModel
        Of the same step about the target.
    inertia : array, (m,)
        What each motor turns, kg m^2, for the safe law.
    solver : {"fatrop", "ipopt"}
        What solves it.
    """

    def __init__(
        self, model: StepModel, linear: LinearModel, inertia: Array, solver: Solver = "fatrop"
    ) -> None:
        self.model = self.unchanged = model
        self.linear, self.solver = linear, solver
        self.walls = tuple(Wall.of(model.scene, keep) for keep in model.problem.keeps)
        self.end = end_rows(linear, model.problem.weights)
        self.kinds = model.problem.kinds(linear.goal)
        self.slacks = tuple(kind for kind in self.kinds if kind.soft)
        self._guess: Array | None = None
        self._built: _Programme | None = None
        super().__init__(model.problem, ExtendedKalmanFilter(model, linear), model.delay, inertia)

    def _forget(self) -> None:
        self._guess = None

    @cached_property
    def width(self) -> int:
        """Variables of a stage: the state with the last torques, then torques and slacks."""
        return self.model.size + 2 * self.problem.count + len(self.slacks)

    @property
    def programme(self) -> _Programme:
        """The nonlinear programme of what is carried now."""
        if self._built is None or self._built.model is not self.model:
            self._built = self._programme()
        return self._built

    def _programme(self) -> _Programme:
        import casadi as ca

        problem, size = self.model.problem, self.model.size
        weights, count, motors = problem.weights, problem.horizon, problem.count
        wide = size + motors
        state = [ca.MX.sym(f"x{k}", wide) for k in range(count + 1)]
        free = [ca.MX.sym(f"u{k}", motors + len(self.slacks)) for k in range(count)]
        given = ca.MX.sym("given", wide + motors)  # state, last torques, disturbances
        wanted = ca.MX.sym("wanted", 5 * motors, count)  # outputs, then torques
        rest = ca.MX.sym("rest", wide)
        disturbance = given[wide:]
        acting = ca.vertcat(disturbance, disturbance)
        weighed = np.concatenate([getattr(weights, name) for name in _OUTPUTS])
        softly = np.array([kind.weight for kind in self.slacks])
        rows: list[Any] = [state[0] - given[:wide]]
        low_rows, high_rows, of_tips, equality = [0.0] * wide, [0.0] * wide, [False] * wide, [True] * wide
        cost: Any = 0.0
        for k in range(count):
            torque, slacks = free[k][:motors], free[k][motors:]
            change = torque - state[k][size:]
            after = self.model.sample(state[k][:size], ca.vertcat(state[k][size:], torque) + acting)
            rows.append(state[k + 1] - ca.vertcat(after, torque))
            low_rows += [0.0] * wide
            high_rows += [0.0] * wide
            of_tips += [False] * wide
            equality += [True] * wide
            seen = ca.mtimes(ca.DM(self.rows), after)
            cost += _weighed(weights.torque, torque - wanted[4 * motors :, k] + disturbance)
            cost += _weighed(weights.torque_step, change) + _weighed(softly, slacks)
            cost += _weighed(weighed, seen - wanted[: 4 * motors, k])
            for kind in self.kinds:
                slack = slacks[self.slacks.index(kind)] if kind.soft else 0.0
                value = change[kind.motor] if kind.what == "rate" else self._bounded(kind, seen, after)
                for bound, upper in ((kind.low, False), (kind.high, True)):
                    if np.isfinite(bound):
                        rows.append(value - slack if upper else value + slack)
                        low_rows.append(-np.inf if upper else bound)
                        high_rows.append(bound if upper else np.inf)
                        of_tips.append(kind.what == "tip")
                        equality.append(False)
        left = state[-1] - rest + ca.vertcat(np.zeros(size), disturbance)
        cost += 0.5 * ca.sumsqr(ca.mtimes(self.end, left))
        variables = [part for pair in zip(state, free, strict=False) for part in pair] + [state[-1]]
        low, high = np.full((count, self.width), -np.inf), np.full((count, self.width), np.inf)
        unbounded = np.full(wide, np.inf)
        options = dict(_OPTIONS[self.solver])
        if self.solver == "fatrop":
            options["equality"] = equality
        told = {
            "x": ca.vertcat(*variables),
            "f": cost,
            "g": ca.vertcat(*rows),
            "p": ca.vertcat(given, ca.vec(wanted), rest),
        }
        return _Programme(
            self.model,
            ca.nlpsol("nmpc", self.solver, told, options),
            np.concatenate([low.ravel(), -unbounded]),
            np.concatenate([high.ravel(), unbounded]),
            np.array(low_rows),
            np.array(high_rows),
            np.array(of_tips),
        )

    def _bounded(self, kind: Kind, seen: Any, state: Any) -> Any:
        """Return what a kind of rows bounds after a sample: one of the outputs, or how far a part is from a wall."""
        import casadi as ca

        if kind.what != "keep":
            return seen[_OUTPUTS.index(kind.what) * self.problem.count + kind.motor]
        angles = ca.SX.sym("angles", len(self.model.motors.lengths))
        along = self.walls[kind.motor].along_of(ca.vertsplit(angles))
        return ca.Function("along", [angles], [along])(state[self.model.places("angle")])

    def decide(self, state: Array, disturbance: Array, last: Array) -> Command:
        """Solve the nonlinear problem from the last solution shifted; see :class:`ModelBased`."""
        size, count, built = self.model.size, self.problem.count, self.programme
        none = np.zeros(count)
        guess = self._first(state, last) if self._guess is None else self._guess
        low, high = built.low.copy(), built.high.copy()
        for bounds, torque in ((low, self.problem.torque[0]), (high, self.problem.torque[1])):
            stages = bounds[: self.problem.horizon * self.width].reshape(-1, self.width)
            stages[:, size + count : size + 2 * count] = torque
        unbounded = built.of_tips & self.moved
        wanted, still = self._wanted()
        each = (wanted.tip, wanted.tip_rate, wanted.hub, wanted.hub_rate, wanted.torque)
        stacked = np.vstack([np.broadcast_to(rows, (count, self.problem.horizon)) for rows in each])
        found = built.solve(
            x0=guess,
            p=np.concatenate([state, last, disturbance, stacked.ravel("F"), still.state, still.torque]),
            lbx=low,
            ubx=high,
            lbg=np.where(unbounded, -np.inf, built.low_rows),
            ubg=np.where(unbounded, np.inf, built.high_rows),
        )
        statistics = built.solve.stats()
        point = np.array(found["x"]).ravel()
        iterations = int(statistics.get("iter_count", 0))
        if not np.all(np.isfinite(point)):
            self._guess = None
            return Command(none, Status.NOT_FINITE, iterations)
        if not statistics["success"]:
            self._guess = None
            return Command(none, Status.ITERATIONS, iterations)
        self._guess = np.concatenate([point[self.width :], point[-self.width :]])[: len(point)]
        return Command(point[size + count : size + 2 * count], Status.OK, iterations)

    def _first(self, state: Array, last: Array) -> Array:
        """Return a first guess: the arm stays where it is."""
        count = self.problem.count
        stage = np.concatenate([state, last, self.goal.torque, np.zeros(len(self.slacks))])
        return np.concatenate([np.tile(stage, self.problem.horizon), stage[: self.model.size + count]])


def _weighed(weights: Array, values: Any) -> Any:
    """Return half the weighed sum of squares."""
    import casadi as ca

    return 0.5 * ca.dot(ca.DM(weights), values**2)
