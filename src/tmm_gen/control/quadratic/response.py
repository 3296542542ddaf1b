"""How a linear model answers over the horizon: to its state, to a constant torque, to each input."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.prediction.linear import LinearModel
from tmm_gen.control.quadratic.condensed import Outputs

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Response:
    """Of tips, their rates, hubs, their rates over N samples, off their targets, and of what is left at the end.

    Parameters
    ----------
    by_state : array, (4 m N + r, s)
        By the state at the start: N rows for each output of each motor, then those of the end.
    by_constant : array, (4 m N + r, m)
        By torques of 1 N m throughout.
    by_last : array, (4 m N + r, m)
        By the torques chosen before the horizon.
    slopes : Outputs
        By the torques of the horizon, (m, N, m N) each, (r, m N) at the end.
    """

    by_state: Array
    by_constant: Array
    by_last: Array
    slopes: Outputs

    def outputs(self, stacked: Array) -> Outputs:
        """Return outputs that are stacked as the rows above."""
        return split_outputs(stacked, self.slopes.tip.shape[:2])


def response(model: LinearModel, horizon: int, end: Array) -> Response:
    """Return how a linear model answers over a horizon.

    Parameters
    ----------
    model : LinearModel
        By links or by modes.
    horizon : int
        N, samples.
    end : array, (r, s + m)
        G, of the state off the target and the last torques (:func:`~tmm_gen.control.quadratic.terminal.end_rows`).
    """
    size, count = model.size, model.count
    outputs = np.vstack([model.tip, model.tip_rate, model.hub, model.hub_rate])
    rows = np.zeros((len(outputs), horizon, size + 2 * count + count * horizon))
    for stage, motion in enumerate(motions(model, horizon)):
        rows[:, stage] = outputs @ motion
    left = end[:, :size] @ motion
    left[:, size : size + count] += end[:, size:]
    left[:, size + 2 * count :].reshape(len(left), count, horizon)[:, :, -1] += end[:, size:]
    rows = np.vstack([*rows, left])
    return Response(
        by_state=rows[:, :size],
        by_constant=rows[:, size : size + count],
        by_last=rows[:, size + count : size + 2 * count],
        slopes=split_outputs(rows[:, size + 2 * count :], (count, horizon)),
    )


def motions(model: LinearModel, horizon: int) -> Iterator[Array]:
    """Yield how the state after each of N samples answers, (s, s + 2 m + m N).

    Columns are the state at the start, torques of 1 N m throughout, those chosen before the horizon, then those of the
    horizon, motor by motor.

    Parameters
    ----------
    model : LinearModel
        By links or by modes.
    horizon : int
        N, samples.
    """
    size, count = model.size, model.count
    state, last, constant = np.eye(size), np.zeros((size, count)), np.zeros((size, count))
    by_torque = np.zeros((size, count, horizon))
    for stage in range(horizon):
        state = model.transition @ state
        last = model.transition @ last + (model.before if stage == 0 else 0.0)
        constant = model.transition @ constant + model.drive
        by_torque = np.tensordot(model.transition, by_torque, 1)
        # a torque acts in its own sample, and before the next one's does
        if stage:
            by_torque[:, :, stage - 1] += model.before
        by_torque[:, :, stage] += model.then
        yield np.column_stack([state, constant, last, by_torque.reshape(size, -1)])


def split_outputs(stacked: Array, shape: tuple[int, ...], walls: int = 0) -> Outputs:
    """Return outputs that are stacked: of each of the four N for each motor, those of the end, then N for each wall.

    Parameters
    ----------
    stacked : array, (4 m N + r + w N, ...)
        Numbers or derivatives.
    shape : (int, int)
        m and N.
    walls : int
        w.
    """
    number = shape[0] * shape[1]
    *outputs, behind = np.split(stacked, number * np.arange(1, 5))
    end, keep = np.split(behind, [len(behind) - walls * shape[1]])
    tip, tip_rate, hub, hub_rate = (each.reshape(*shape, *stacked.shape[1:]) for each in outputs)
    return Outputs(tip, tip_rate, hub, hub_rate, end, keep.reshape(walls, shape[1], *stacked.shape[1:]))
