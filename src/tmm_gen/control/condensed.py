"""The condensed quadratic program: of the inputs and one slack per stage and soft bound.

What it says is stated in :mod:`tmm_gen.control.problem`; here are its arrays.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.problem import ControlProblem

Array = NDArray[np.float64]

BEYOND = 0.1
"""A soft bound that the arm is so far beyond, or will be even if it brakes, is left out until it is back, rad: it would
be passed at nearly every sample of the horizon, whatever the torques, and pull where the reference pulls already."""


@dataclass(frozen=True, eq=False)
class Outputs:
    """Tip and hub over the horizon, or how they depend on the inputs.

    Parameters
    ----------
    tip, tip_rate, hub, hub_rate : array, (N,) or (N, N)
        After samples 1 to N: rad and rad/s; or their derivatives by ``u[0], ..., u[N-1]``.
    end : array, (r,) or (r, N)
        ``G s_N``, what is left at the end: half its square is the cost to go; or its derivatives.
    """

    tip: Array
    tip_rate: Array
    hub: Array
    hub_rate: Array
    end: Array


@dataclass(frozen=True, eq=False)
class Condensed:
    """Arrays of the quadratic program in ``z = (u - u^, s, r)`` for given sensitivities.

    Parameters
    ----------
    problem : ControlProblem
        What is to be solved.
    slopes : Outputs
        Derivatives by the inputs, (N, N) each, those of the end (r, N).
    target_hub, target_torque : float
        ``hub_s`` (rad), ``u_s`` (N m).
    """

    problem: ControlProblem
    slopes: Outputs
    target_hub: float
    target_torque: float

    @property
    def size(self) -> int:
        """Number of variables."""
        return len(self.hessian)

    @cached_property
    def difference(self) -> Array:
        """``D``, (N, N): changes of the inputs are ``D u - e_0 u[-1]``."""
        count = self.problem.horizon
        return np.eye(count) - np.eye(count, k=-1)

    @cached_property
    def input_hessian(self) -> Array:
        """The part of the inputs, (N, N), Gauss-Newton."""
        weights, slopes = self.problem.weights, self.slopes
        found = weights.torque * np.eye(self.problem.horizon)
        found += weights.torque_step * self.difference.T @ self.difference + slopes.end.T @ slopes.end
        for weight, slope in (
            (weights.tip, slopes.tip),
            (weights.hub, slopes.hub),
            (weights.tip_rate, slopes.tip_rate),
            (weights.hub_rate, slopes.hub_rate),
        ):
            if weight:
                found += weight * slope.T @ slope
        return found

    @cached_property
    def hessian(self) -> Array:
        """H, with the slacks behind the inputs."""
        weights, problem = self.problem.weights, self.problem
        slack = [weights.overshoot] * problem.horizon if problem.tip else []
        slack += [weights.hub_bound] * problem.horizon if problem.hub else []
        count = problem.horizon
        found = np.diag(np.concatenate([np.zeros(count), slack]))
        found[:count, :count] = self.input_hessian
        return found

    @cached_property
    def rows(self) -> Array:
        """A: changes of the torque, tip, hub; those present, N rows each."""
        problem, count = self.problem, self.problem.horizon
        width = len(self.hessian)
        blocks = []
        if problem.torque_rate is not None:
            blocks.append(np.hstack([self.difference, np.zeros((count, width - count))]))
        column = count
        for present, slope in ((problem.tip, self.slopes.tip), (problem.hub, self.slopes.hub)):
            if present is not None:
                block = np.zeros((count, width))
                block[:, :count] = slope
                block[:, column : column + count] = -np.eye(count)
                column += count
                # two-sided with one slack: low - s <= y <= high + s needs a row for each finite side
                if np.isfinite(present[1]):
                    blocks.append(block)
                if np.isfinite(present[0]):
                    lower = block.copy()
                    lower[:, count:] *= -1.0
                    blocks.append(lower)
        return np.vstack(blocks) if blocks else np.zeros((0, width))

    def gradient(self, along: Outputs, inputs: Array, last: float, disturbance: float) -> Array:
        """Return f.

        Parameters
        ----------
        along : Outputs
            Predicted with the inputs below, (N,) each, (r,) at the end.
        inputs : array, (N,)
            ``u^``, N m.
        last : float
            ``u[-1]``, N m.
        disturbance : float
            ``d``, N m.
        """
        weights, slopes = self.problem.weights, self.slopes
        changes = self.difference @ inputs
        changes[0] -= last
        found = weights.torque * (inputs - self.target_torque + disturbance)
        found += weights.torque_step * (changes @ self.difference) + along.end @ slopes.end
        for weight, slope, error in (
            (weights.tip, slopes.tip, along.tip - self.problem.reference),
            (weights.hub, slopes.hub, along.hub - self.target_hub),
            (weights.tip_rate, slopes.tip_rate, along.tip_rate),
            (weights.hub_rate, slopes.hub_rate, along.hub_rate),
        ):
            if weight:
                found += weight * error @ slope
        return np.concatenate([found, np.zeros(self.size - len(found))])

    def bounds(
        self, along: Outputs, inputs: Array, last: float, stopping: float | None = None
    ) -> tuple[Array, Array]:
        """Return lower and upper bounds of the inputs and of the rows, with arguments as for :meth:`gradient`.

        Soft ones that the arm is far beyond at the first sample, or will be even if it brakes, are infinite;
        ``stopping`` is that of the target unless it is given.
        """
        stopping = self.stopping if stopping is None else stopping
        problem, count = self.problem, self.problem.horizon
        low, high = [problem.torque[0] - inputs], [problem.torque[1] - inputs]
        if problem.torque_rate is not None:
            change = problem.torque_rate * problem.sample_time
            changes = self.difference @ inputs
            changes[0] -= last
            low.append(-change - changes)
            high.append(change - changes)
        none = np.full(count, np.inf)
        for present, value in ((problem.tip, along.tip), (problem.hub, along.hub)):
            if present is None:
                continue
            way = float(value[1] - value[0]) if count > 1 else 0.0
            ahead = value[0] + np.copysign(stopping * way**2, way)
            near = min(value[0], ahead) >= present[0] - BEYOND and max(value[0], ahead) <= present[1] + BEYOND
            if np.isfinite(present[1]):
                low.append(-none)
                high.append(present[1] - value if near else none)
            if np.isfinite(present[0]):
                low.append(present[0] - value if near else -none)
                high.append(none)
        return np.concatenate(low), np.concatenate(high)

    @property
    def stopping(self) -> float:
        """Half the angle in which the largest torque stops the arm, if it turned by 1 rad per sample, rad.

        From how far a torque throughout turns the hub in the horizon: the rigid arm by half its acceleration times
        the time squared. Half, since the arm vibrates.
        """
        count = self.problem.horizon
        largest = max(abs(bound) for bound in self.problem.torque)
        turned = largest * abs(float(np.sum(self.slopes.hub[-1])))
        return 0.25 * count**2 / (2.0 * turned) if turned > 0.0 else 0.0

    @cached_property
    def soft(self) -> NDArray[np.bool_]:
        """Which of the bounds are soft."""
        hard = self.problem.horizon * (1 if self.problem.torque_rate is None else 2)
        return np.arange(self.problem.horizon + len(self.rows)) >= hard
