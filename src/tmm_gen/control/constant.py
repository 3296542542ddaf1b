"""What real-time iteration of zero order keeps: sensitivities about a rest, and the program made of them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.condensed import Condensed
from tmm_gen.control.linear import LinearModel
from tmm_gen.control.problem import ControlProblem
from tmm_gen.control.response import Response, response
from tmm_gen.control.step_model import StepModel

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Constant:
    """Sensitivities about an arm at rest.

    Parameters
    ----------
    problem : ControlProblem
        What is to be solved.
    linear : LinearModel
        Of the step there.
    end : array, (r, s + m)
        G of the cost to go.
    walls : int
        w, how many; what is near them is none of what is kept.
    """

    problem: ControlProblem
    linear: LinearModel
    end: Array
    walls: int

    @cached_property
    def response(self) -> Response:
        """How outputs answer over the horizon."""
        return response(self.linear, self.problem.horizon, self.end)

    @cached_property
    def condensed(self) -> Condensed:
        """The program."""
        slopes = self.response.slopes
        distances = np.zeros((self.walls, *slopes.tip.shape[1:]))
        return Condensed(self.problem, replace(slopes, keep=distances), self.linear.goal)

    @cached_property
    def by_estimate(self) -> Array:
        """What changes of the estimate make of the outputs, (4 m N + r, s + m)."""
        linear, answer = self.linear, self.response
        one = np.eye(linear.size + linear.count)
        one[: linear.size] = np.column_stack([linear.transition, linear.drive])
        until = np.linalg.matrix_power(one, linear.delay.whole)
        return np.asarray(np.column_stack([answer.by_state, answer.by_constant]) @ until, float)

    def about(self, model: StepModel, state: Array, torque: Array) -> Constant:
        """Return those of another rest, of an arm that carries something else.

        The cost to go stays: it prices what is left after the horizon, whoever makes it.

        Parameters
        ----------
        model : StepModel
            Of that arm.
        state : array, (s,)
            At rest.
        torque : array, (m,)
            That holds it, N m.
        """
        transition, drives = model.jacobian(state, torque)
        before, then = np.split(drives, 2, axis=1)
        linear = replace(self.linear, transition=transition, before=before, then=then)
        return replace(self, linear=linear)
