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
    """Of tip, tip rate, hub, hub rate over N samples.

    Parameters
    ----------
    by_state : array, (4, N, m)
        By the state at the start.
    by_constant : array, (4, N)
        By a torque of 1 N m throughout.
    by_last : array, (4, N)
        By the torque chosen before the horizon.
    slopes : Outputs
        By the torques of the horizon, (N, N) each.
    """

    by_state: Array
    by_constant: Array
    by_last: Array
    slopes: Outputs


def response(model: LinearModel, horizon: int) -> Response:
    """Return how a linear model answers over a horizon."""
    rows = np.array([model.tip, model.tip_rate, model.hub, model.hub_rate])
    states, earlier, later = (
        np.zeros((4, horizon, model.size)),
        np.zeros((4, horizon)),
        np.zeros((4, horizon)),
    )
    for stage in range(horizon):
        earlier[:, stage], later[:, stage] = rows @ model.before, rows @ model.then
        rows = rows @ model.transition
        states[:, stage] = rows
    # a torque acts in its own sample, and before the next one's does
    impulses = later + np.hstack([np.zeros((4, 1)), earlier[:, :-1]])
    slopes = np.zeros((4, horizon, horizon))
    for stage in range(horizon):
        slopes[:, stage:, stage] = impulses[:, : horizon - stage]
    return Response(states, np.cumsum(earlier + later, axis=1), earlier, Outputs(*slopes))
