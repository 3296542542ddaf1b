"""What real-time iteration of zero order keeps: sensitivities about a rest, and the program made of them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.prediction.linear import LinearModel
from tmm_gen.control.prediction.step_model import StepModel
from tmm_gen.control.quadratic.condensed import Condensed
from tmm_gen.control.quadratic.response import Response, motions, response
from tmm_gen.control.quadratic.walls import Wall
from tmm_gen.control.task.problem import ControlProblem

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
    places : tuple of int
        Where the arm's angles are in its state, d of them.
    walls : tuple of Wall
        w of them. How the angles answer is kept; what these make of a distance is that of the motion there is.
    """

    problem: ControlProblem
    linear: LinearModel
    end: Array
    places: tuple[int, ...]
    walls: tuple[Wall, ...]

    @cached_property
    def response(self) -> Response:
        """How outputs answer over the horizon."""
        return response(self.linear, self.problem.horizon, self.end)

    @cached_property
    def condensed(self) -> Condensed:
        """The program, but for its walls, whose rows are zeros."""
        slopes = self.response.slopes
        distances = np.zeros((len(self.walls), *slopes.tip.shape[1:]))
        return Condensed(self.problem, replace(slopes, keep=distances), self.linear.goal)

    @cached_property
    def by_estimate(self) -> Array:
        """What changes of the estimate make of the outputs but for walls, (4 m N + r, s + m)."""
        answer = self.response
        return np.asarray(np.column_stack([answer.by_state, answer.by_constant]) @ self._until, float)

    @property
    def _until(self) -> Array:
        """What changes of the estimate make of it until the horizon begins, (s + m, s + m)."""
        linear = self.linear
        one = np.eye(linear.size + linear.count)
        one[: linear.size] = np.column_stack([linear.transition, linear.drive])
        return np.linalg.matrix_power(one, linear.delay.whole)

    @cached_property
    def swings(self) -> tuple[Array, Array]:
        """How the angles answer after each sample: to the torques, (N, d, m N), and to the estimate, (N, d, s + m)."""
        linear, angles = self.linear, list(self.places)
        every = np.array([motion[angles] for motion in motions(linear, self.problem.horizon)])
        begun = linear.size + linear.count
        return every[:, :, begun + linear.count :], every[:, :, :begun] @ self._until

    def beside_walls(self, angles: Array) -> tuple[Array, Condensed]:
        """Return what the estimate makes of the outputs, and the program, with walls about a motion.

        How near a part is to a wall changes with the angles by what the arm is shaped like there, and these by the
        sensitivities that are kept.

        Parameters
        ----------
        angles : array, (N, d)
            Of the arm after each sample of the motion, rad.

        Returns
        -------
        by_estimate : array, (4 m N + r + w N, s + m)
        condensed : Condensed
        """
        by_torques, by_estimate = self.swings
        normals = [wall.slopes(angles)[:, None] for wall in self.walls]
        nearing = np.array([(normal @ by_torques)[:, 0] for normal in normals])
        found = [(normal @ by_estimate)[:, 0] for normal in normals]
        slopes = replace(self.condensed.slopes, keep=nearing)
        return np.vstack([self.by_estimate, *found]), replace(self.condensed, slopes=slopes)

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
