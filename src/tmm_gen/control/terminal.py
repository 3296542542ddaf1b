"""What comes after the horizon: the cost that would still arise without bounds, so that the horizon never ends.

With it predictive control is the linear-quadratic regulator wherever no bound is met, for any horizon (P. O. M.
Scokaert, J. B. Rawlings, Constrained linear quadratic regulation, IEEE Trans. Autom. Control 43, 1998).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.linear import LinearModel
from tmm_gen.scene.control import Weights

Array = NDArray[np.float64]

_NOTHING = 1e-13
"""Eigenvalue of the cost to go, relative to the largest, that is rounding."""


def cost_to_go(model: LinearModel, weights: Weights) -> Array:
    """Return P of what is still to come after a sample, ``1/2 s'P s``, (m + 1, m + 1).

    ``s = (x, u)`` is the state off the target and the torque chosen last, off the one that holds it. The sample itself
    is not counted.

    Parameters
    ----------
    model : LinearModel
        By links or by modes.
    weights : Weights
        Of each sample and each torque to come.

    Raises
    ------
    numpy.linalg.LinAlgError
        If the weights leave something without a price that does not come to rest.
    """
    from scipy.linalg import solve_discrete_are  # slow to import

    size = model.size
    transition, drive = np.zeros((size + 1, size + 1)), np.append(model.then, 1.0)
    transition[:size, :size], transition[:size, size] = model.transition, model.before
    state = np.zeros((size + 1, size + 1))
    state[:size, :size] = model.weighed(weights.tip, weights.hub, weights.tip_rate, weights.hub_rate)
    change = np.zeros((size + 1, 1))
    change[size] = weights.torque_step
    now = state.copy()
    now[size, size] += weights.torque_step
    price = np.array([[weights.torque + weights.torque_step]])
    value = solve_discrete_are(transition, drive[:, None], now, price, s=-change)
    return np.asarray(value - state, float)


def end_rows(model: LinearModel, weights: Weights) -> Array:
    """Return G with ``P = G'G`` for :func:`cost_to_go`, (r, m + 1), r its rank."""
    values, vectors = np.linalg.eigh(cost_to_go(model, weights))
    kept = values > _NOTHING * values[-1]
    return np.asarray(np.sqrt(values[kept])[:, None] * vectors[:, kept].T, float)
