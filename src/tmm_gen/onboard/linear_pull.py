"""What a reference that moves makes of a linear MPC's gradient, by few numbers: the model answers alike at all samples.

The gradient by the torque of motor k in sample j is less, by what is wanted of a motion ``(r, r', r'')``,

    sum_o sum_{i >= j} answer_o,k[i - j] weight_o wanted_o[i]  +  weight_k torque_k[j]  +  (G_u)' G (x, u)[N - 1].
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.laws.linear_mpc import LinearMpc

Array = NDArray[np.float64]

OUTPUTS = ("tip", "hub", "tip_rate", "hub_rate")


@dataclass(frozen=True, eq=False)
class Pull:
    """Its tables; see :class:`~tmm_gen.onboard.linear_data.LinearMpcData`."""

    answers: Array
    pulls: Array
    priced: Array
    end_pulls: Array


def pull_of(controller: LinearMpc) -> Pull:
    """Return the tables of a controller."""
    model, slopes, problem = controller.model, controller.response.slopes, controller.problem
    count, horizon, weights = problem.count, problem.horizon, problem.weights
    by_motion, by_torque = controller.following.terms
    states = np.concatenate([by_motion[0], by_motion[1], np.zeros_like(by_motion[2])], axis=1)
    torques = np.concatenate([*by_torque], axis=1)
    weighed = [
        (name, motor, float(getattr(weights, name)[motor]))
        for name in OUTPUTS
        for motor in range(count)
        if getattr(weights, name)[motor]
    ]
    return Pull(
        answers=np.array([getattr(slopes, name)[motor, :, ::horizon].T for name, motor, _ in weighed]),
        pulls=np.array([weight * getattr(model, name)[motor] @ states for name, motor, weight in weighed]),
        priced=weights.torque[:, None] * torques,
        end_pulls=slopes.end.T @ controller.end @ np.vstack([states, torques]),
    )
