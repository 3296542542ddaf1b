"""How a linear model answers over the horizon: to its state, to a constant torque, to each input."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.condensed import Outputs
from tmm_gen.control.linear import LinearModel

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Response:
    """Of tip, tip rate, hub, hub rate over N samples, off their targets, and of what is left at the end.

    Parameters
    ----------
    by_state : array, (4 N + r, m)
        By the state at the start: N rows for each output, then those of the end.
    by_constant : array, (4 N + r,)
        By a torque of 1 N m throughout.
    by_last : array, (4 N + r,)
        By the torque chosen before the horizon.
    slopes : Outputs
        By the torques of the horizon, (N, N) each, (r, N) at the end.
    """

    by_state: Array
    by_constant: Array
    by_last: Array
    slopes: Outputs

    def outputs(self, stacked: Array) -> Outputs:
        """Return outputs that are stacked as the rows above."""
        count = len(self.slopes.tip)
        return Outputs(*np.split(stacked, [count, 2 * count, 3 * count, 4 * count]))


def response(model: LinearModel, horizon: int, end: Array) -> Response:
    """Return how a linear model answers over a horizon.

    Parameters
    ----------
    model : LinearModel
        By links or by modes.
    horizon : int
        N, samples.
    end : array, (r, m + 1)
        G, of the state off the target and the last torque (:func:`~tmm_gen.control.terminal.end_rows`).
    """
    size = model.size
    outputs = np.array([model.tip, model.tip_rate, model.hub, model.hub_rate])
    state, last, constant = np.eye(size), np.zeros(size), np.zeros(size)
    by_torque = np.zeros((size, horizon))
    rows = np.zeros((4, horizon, size + 2 + horizon))
    for stage in range(horizon):
        state = model.transition @ state
        last = model.transition @ last + (model.before if stage == 0 else 0.0)
        constant = model.transition @ constant + model.drive
        by_torque = model.transition @ by_torque
        # a torque acts in its own sample, and before the next one's does
        if stage:
            by_torque[:, stage - 1] += model.before
        by_torque[:, stage] += model.then
        rows[:, stage] = outputs @ np.column_stack([state, constant, last, by_torque])
    left = end[:, :size] @ np.column_stack([state, constant, last, by_torque])
    left[:, size] += end[:, size]
    left[:, -1] += end[:, size]
    rows = np.vstack([*rows, left])
    return Response(
        by_state=rows[:, :size],
        by_constant=rows[:, size],
        by_last=rows[:, size + 1],
        slopes=Outputs(*np.split(rows[:, size + 2 :], horizon * np.arange(1, 5))),
    )
