"""The condensed quadratic program: of the inputs and one slack per stage and soft bound.

What it says is stated in :mod:`tmm_gen.control.task.problem`; here are its arrays.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.task.problem import ControlProblem
from tmm_gen.control.task.terms import Goal, Kind, Wanted

Array = NDArray[np.float64]

BEYOND = 0.1
"""A soft bound that the arm is so far beyond, or will be even if it brakes, is left out until it is back, rad: it would
be passed at nearly every sample of the horizon, whatever the torques, and pull where the reference pulls already."""


@dataclass(frozen=True, eq=False)
class Outputs:
    """Tips and hubs over the horizon, or how they depend on the inputs.

    Parameters
    ----------
    tip, tip_rate, hub, hub_rate : array, (m, N) or (m, N, m N)
        After samples 1 to N: rad and rad/s; or their derivatives by the inputs, motor by motor.
    end : array, (r,) or (r, m N)
        ``G s_N``, what is left at the end: half its square is the cost to go; or its derivatives.
    keep : array, (w, N) or (w, N, m N)
        How far parts are along the normals of w walls, m; or their derivatives.
    """

    tip: Array
    tip_rate: Array
    hub: Array
    hub_rate: Array
    end: Array
    keep: Array = field(default_factory=lambda: np.zeros((0, 0)))


@dataclass(frozen=True, eq=False)
class Condensed:
    """Arrays of the quadratic program in ``z = (u - u^, s, r)`` for given sensitivities.

    Parameters
    ----------
    problem : ControlProblem
        What is to be solved.
    slopes : Outputs
        Derivatives by the inputs, (m, N, m N) each, those of the end (r, m N).
    goal : Goal
        ``tip_s``, ``hub_s`` (rad), ``u_s`` (N m).
    """

    problem: ControlProblem
    slopes: Outputs
    goal: Goal

    @property
    def size(self) -> int:
        """Number of variables."""
        return len(self.hessian)

    @property
    def inputs(self) -> int:
        """Number of inputs, m N."""
        return self.problem.count * self.problem.horizon

    @cached_property
    def kinds(self) -> tuple[Kind, ...]:
        """The rows of A, N for each."""
        return self.problem.kinds(self.goal)

    @cached_property
    def difference(self) -> Array:
        """``D``, (N, N): changes of a motor's inputs are ``D u - e_0 u[-1]``."""
        count = self.problem.horizon
        return np.eye(count) - np.eye(count, k=-1)

    @cached_property
    def input_hessian(self) -> Array:
        """The part of the inputs, (m N, m N), Gauss-Newton."""
        weights, slopes = self.problem.weights, self.slopes
        price = np.kron(np.diag(weights.torque), np.eye(self.problem.horizon))
        change = np.kron(np.diag(weights.torque_step), self.difference.T @ self.difference)
        found = price + change + slopes.end.T @ slopes.end
        for every, slope in (
            (weights.tip, slopes.tip),
            (weights.hub, slopes.hub),
            (weights.tip_rate, slopes.tip_rate),
            (weights.hub_rate, slopes.hub_rate),
        ):
            for weight, each in zip(every, slope, strict=True):
                if weight:
                    found += weight * each.T @ each
        return np.asarray(found, float)

    @cached_property
    def hessian(self) -> Array:
        """H, with the slacks behind the inputs."""
        slack = np.repeat([kind.weight for kind in self.kinds if kind.soft], self.problem.horizon)
        found = np.diag(np.concatenate([np.zeros(self.inputs), slack]))
        found[: self.inputs, : self.inputs] = self.input_hessian
        return found

    @cached_property
    def input_rows(self) -> Array:
        """A without slacks: what the inputs make of each kind of rows, (N kinds, m N)."""
        count = self.problem.horizon
        found = np.zeros((len(self.kinds), count, self.inputs))
        for rows, kind in zip(found, self.kinds, strict=True):
            if kind.what == "rate":
                rows[:, kind.motor * count : (kind.motor + 1) * count] = self.difference
            else:
                rows[:] = getattr(self.slopes, kind.what)[kind.motor]
        return found.reshape(-1, self.inputs)

    @cached_property
    def rows(self) -> Array:
        """A: changes of the torques, tips, hubs; those present, N rows for each finite side."""
        count, column = self.problem.horizon, self.inputs
        width = len(self.hessian)
        blocks = []
        for number, kind in enumerate(self.kinds):
            block = np.zeros((count, width))
            block[:, : self.inputs] = self.input_rows[number * count : (number + 1) * count]
            if not kind.soft:
                blocks.append(block)
                continue
            block[:, column : column + count] = -np.eye(count)
            column += count
            # two-sided with one slack: low - s <= y <= high + s needs a row for each finite side
            if np.isfinite(kind.high):
                blocks.append(block)
            if np.isfinite(kind.low):
                lower = block.copy()
                lower[:, self.inputs :] *= -1.0
                blocks.append(lower)
        return np.vstack(blocks) if blocks else np.zeros((0, width))

    def gradient(
        self,
        along: Outputs,
        inputs: Array,
        last: Array,
        disturbance: Array,
        wanted: Wanted | None = None,
    ) -> Array:
        """Return f.

        Parameters
        ----------
        along : Outputs
            Predicted with the inputs below, (m, N) each, (r,) at the end.
        inputs : array, (m, N)
            ``u^``, N m.
        last : array, (m,)
            ``u[-1]``, N m.
        disturbance : array, (m,)
            ``d``, N m.
        wanted : Wanted, optional
            By default rest at the goal.
        """
        weights, slopes = self.problem.weights, self.slopes
        wanted = Wanted.still(self.goal) if wanted is None else wanted
        changes = np.diff(inputs, axis=1, prepend=last[:, None])
        torques = inputs - wanted.torque + disturbance[:, None]
        priced = weights.torque[:, None] * torques
        priced += weights.torque_step[:, None] * (changes @ self.difference)
        found = priced.ravel() + (along.end - wanted.end) @ slopes.end
        for every, slope, error in (
            (weights.tip, slopes.tip, along.tip - wanted.tip),
            (weights.hub, slopes.hub, along.hub - wanted.hub),
            (weights.tip_rate, slopes.tip_rate, along.tip_rate - wanted.tip_rate),
            (weights.hub_rate, slopes.hub_rate, along.hub_rate - wanted.hub_rate),
        ):
            for weight, rows, off in zip(every, slope, error, strict=True):
                if weight:
                    found += weight * off @ rows
        return np.concatenate([found, np.zeros(self.size - len(found))])

    def bounds(
        self,
        along: Outputs,
        inputs: Array,
        last: Array,
        stopping: Array | None = None,
        without: tuple[str, ...] = (),
        torque: tuple[Array, Array] | None = None,
    ) -> tuple[Array, Array]:
        """Return lower and upper bounds of the inputs and of the rows, with arguments as for :meth:`gradient`.

        Soft ones that the arm is far beyond at the first sample, or will be even if it brakes, are infinite;
        ``stopping`` is that of the target unless it is given. Kinds of rows ``without`` which it is to be are infinite.
        Bounds of ``torque``, (m,) each, are the problem's unless others are given. Where the last torque is beyond them
        its first change may be as large as they ask for.
        """
        stopping = self.stopping if stopping is None else stopping
        problem, count = self.problem, self.problem.horizon
        lowest, highest = problem.torque if torque is None else torque
        low, high = ([(bound[:, None] - inputs).ravel()] for bound in (lowest, highest))
        changes = np.diff(inputs, axis=1, prepend=last[:, None])
        none = np.full(count, np.inf)
        for kind in self.kinds:
            if kind.what == "rate":
                down, up = np.full(count, kind.low), np.full(count, kind.high)
                down[0] = min(kind.low, highest[kind.motor] - last[kind.motor])
                up[0] = max(kind.high, lowest[kind.motor] - last[kind.motor])
                low.append(down - changes[kind.motor])
                high.append(up - changes[kind.motor])
                continue
            value = getattr(along, kind.what)[kind.motor]
            way = float(value[1] - value[0]) if count > 1 else 0.0
            braked = 0.0 if kind.what in ("keep", "hub_rate") else float(stopping[kind.motor])
            ahead = value[0] + np.copysign(braked * way**2, way)
            near = kind.what not in without
            if kind.what != "hub_rate":  # a hub that is too fast can be slowed down at once
                near &= min(value[0], ahead) >= kind.low - BEYOND
                near &= max(value[0], ahead) <= kind.high + BEYOND
            if np.isfinite(kind.high):
                low.append(-none)
                high.append(kind.high - value if near else none)
            if np.isfinite(kind.low):
                low.append(kind.low - value if near else -none)
                high.append(none)
        return np.concatenate(low), np.concatenate(high)

    @property
    def stopping(self) -> Array:
        """Half the angle in which a motor's largest torque stops it, if it turned by 1 rad per sample, (m,), rad.

        From how far a torque throughout turns the hub in the horizon: the rigid arm by half its acceleration times
        the time squared. Half, since the arm vibrates.
        """
        count = self.problem.horizon
        found = np.zeros(self.problem.count)
        for motor, largest in enumerate(np.max(np.abs(self.problem.torque), axis=0)):
            slope = self.slopes.hub[motor, -1, motor * count : (motor + 1) * count]
            turned = float(largest) * abs(float(np.sum(slope)))
            found[motor] = 0.25 * count**2 / (2.0 * turned) if turned > 0.0 else 0.0
        return found

    @cached_property
    def soft(self) -> NDArray[np.bool_]:
        """Which of the bounds are soft."""
        hard = self.inputs + self.problem.horizon * sum(not kind.soft for kind in self.kinds)
        return np.arange(self.inputs + len(self.rows)) >= hard
