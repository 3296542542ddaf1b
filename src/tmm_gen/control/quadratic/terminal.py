"""What comes after the horizon: the cost that would still arise without bounds, so that the horizon never ends.

With it predictive control is the linear-quadratic regulator wherever no bound is met, for any horizon (P. O. M.
Scokaert, J. B. Rawlings, Constrained linear quadratic regulation, IEEE Trans. Autom. Control 43, 1998).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.prediction.linear import LinearModel
from tmm_gen.control.task.terms import MotorWeights

Array = NDArray[np.float64]

_NOTHING = 1e-13
"""Eigenvalue of the cost to go, relative to the largest, that is rounding."""


def cost_to_go(model: LinearModel, weights: MotorWeights) -> Array:
    """Return P of what is still to come after a sample, ``1/2 s'P s``, (s + m, s + m).

    ``s = (x, u)`` is the state off the target and the torques chosen last, off those that hold it. The sample itself
    is not counted.

    Parameters
    ----------
    model : LinearModel
        By links or by modes.
    weights : MotorWeights
        Of each sample and each torque to come.

    Raises
    ------
    numpy.linalg.LinAlgError
        If the weights leave something without a price that does not come to rest.
    """
    from scipy.linalg import solve_discrete_are  # slow to import

    size, count = model.size, model.count
    transition, drive = np.zeros((size + count, size + count)), np.vstack([model.then, np.eye(count)])
    transition[:size, :size], transition[:size, size:] = model.transition, model.before
    state = np.zeros((size + count, size + count))
    state[:size, :size] = model.weighed(weights.tip, weights.hub, weights.tip_rate, weights.hub_rate)
    step = np.diag(weights.torque_step)
    change = np.vstack([np.zeros((size, count)), step])
    now = state.copy()
    now[size:, size:] += step
    price = np.diag(weights.torque + weights.torque_step)
    value = solve_discrete_are(transition, drive, now, price, s=-change)
    return np.asarray(value - state, float)


def end_rows(model: LinearModel, weights: MotorWeights) -> Array:
    """Return G with ``P = G'G`` for :func:`cost_to_go`, (r, s + m), r its rank."""
    values, vectors = np.linalg.eigh(cost_to_go(model, weights))
    kept = values > _NOTHING * values[-1]
    return np.asarray(np.sqrt(values[kept])[:, None] * vectors[:, kept].T, float)
