"""How a linear model follows hubs that move: the states and torques of a motion."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.goals.window import Window
from tmm_gen.control.prediction.linear import LinearModel
from tmm_gen.control.task.terms import Goal, Wanted

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Following:
    """Motions of a linear model whose hubs are evenly accelerated, ``x = X_0 r + X_1 r' + X_2 r''``, ``u`` likewise.

    Put into ``x+ = A x + B u`` with ``r+ = r + T r' + T^2/2 r''`` that is, for each power of the time,

        (I - A) X_0 - B U_0 = 0,   (I - A) X_1 - B U_1 = -T X_0,   (I - A) X_2 - B U_2 = -T^2/2 X_0 - T X_1,

    where the hubs are ``r`` itself.

    Parameters
    ----------
    model : LinearModel
        By links or by modes.
    sample_time : float
        T, s.
    """

    model: LinearModel
    sample_time: float

    @cached_property
    def terms(self) -> tuple[Array, Array]:
        """``X``, (3, s, m), and ``U``, (3, m, m)."""
        model, time = self.model, self.sample_time
        size, count = model.size, model.count
        rows = np.zeros((size + count, size + count))
        rows[:size, :size], rows[:size, size:] = np.eye(size) - model.transition, -model.drive
        rows[size:, :size] = model.hub
        right = np.zeros((size + count, count))
        right[size:] = np.eye(count)
        still = np.linalg.solve(rows, right)
        right[:] = 0.0
        right[:size] = -time * still[:size]
        moving = np.linalg.solve(rows, right)
        right[:size] = -0.5 * time**2 * still[:size] - time * moving[:size]
        growing = np.linalg.solve(rows, right)
        every = np.stack([still, moving, growing])
        return every[:, :size], every[:, size:]

    def at(self, motion: Array) -> tuple[Array, Array]:
        """Return the state off the target, (s,), and the torques, (m,), for a motion of the hubs, (3, m)."""
        states, torques = self.terms
        off = motion.copy()
        off[0] -= self.model.goal.hub
        return (
            np.einsum("ksm,km->s", states, off),
            np.asarray(self.model.goal.torque + np.einsum("kim,km->i", torques, off), float),
        )

    def wanted(self, window: Window, now: int, ahead: int, horizon: int, end: Array, goal: Goal) -> Wanted:
        """Return what is wanted over a horizon, as if the window went through a goal now.

        Beams sag as at rest; accelerations only count in the torques. See :func:`~tmm_gen.control.laws.pose.pose_in`
        for the reason.

        Parameters
        ----------
        window : Window
            What is to be followed.
        now : int
            Which of its samples goes through the goal.
        ahead : int
            How much later the first sample of the horizon is.
        horizon : int
            N.
        end : array, (r, s + m)
            G, of the state off the goal and the last torques.
        goal : Goal
            That the state counts from.
        """
        model, (by_motion, torque_by) = self.model, self.terms
        motions = np.stack([window.at(now + ahead + i) for i in range(horizon)], axis=-1)
        motions[0] -= window.at(now)[0][:, None]
        states = np.einsum("ksm,kmi->si", by_motion[:2], motions[:2])
        torques = np.einsum("kjm,kmi->ji", torque_by, motions)
        return Wanted(
            tip=goal.tip[:, None] + model.tip @ states,
            hub=goal.hub[:, None] + model.hub @ states,
            tip_rate=model.tip_rate @ states,
            hub_rate=model.hub_rate @ states,
            torque=goal.torque[:, None] + torques,
            end=end @ np.append(states[:, -1], torques[:, -1]),
        )
