"""How sure the numbers of a fit are, where its remains are neither alike nor independent.

Noise of a sensor is much the same at all instants. An error of the clock is not: an instant that is off by ``d`` puts
the output off by ``d`` times its rate, in all outputs at once. And what a model cannot follow stays for many samples.
So the covariance is that of the estimating equations themselves (a "sandwich"; White 1980): what remains is taken as it
is at each instant, all outputs of an instant together, and products of neighbouring instants are counted with weights
that fall to zero (Newey & West 1987) over a distance that the remains themselves set (Andrews 1991).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SURE = 1.96
"""Standard deviations to each side that hold 95 % of a normal distribution."""


def deviations(
    jacobian: Array, remains: Array, instants: NDArray[np.intp], reach: float = np.inf
) -> tuple[Array, Array]:
    """Return standard deviations and correlation of fitted numbers.

    The deviations are the larger of two for each number: those that follow if remains are alike and independent,
    ``s^2 (J'J)^-1``, and those that assume neither.

    Parameters
    ----------
    jacobian : array, (m, p)
        Of what remains, by the numbers; of full rank.
    remains : array, (m,)
        What remains at the solution.
    instants : array of int, (m,)
        Which remains belong to one instant: its number, in the order of time.
    reach : float
        Remains beyond it were given no more weight than those at it (Huber's loss).

    Returns
    -------
    deviations : array, (p,)
        Of each number.
    correlation : array, (p, p)
        Of the numbers, if remains are alike and independent.
    """
    m, p = jacobian.shape
    held = np.clip(remains, -reach, reach)
    inside = np.abs(remains) <= reach
    inverse = np.linalg.inv(jacobian[inside].T @ jacobian[inside])
    variance = float(held @ held) / max(m - p, 1) * m / max(int(np.sum(inside)), 1)
    alike = np.sqrt(variance * np.diag(inverse))
    robust = np.sqrt(np.maximum(np.diag(inverse @ _spread(jacobian, held, instants) @ inverse), 0.0))
    scale = np.sqrt(np.diag(inverse))
    return np.maximum(alike, robust), inverse / np.outer(scale, scale)


def _spread(jacobian: Array, held: Array, instants: NDArray[np.intp]) -> Array:
    """Return the covariance of the sum of ``J' r``, of whole instants, neighbours counted."""
    _, order = np.unique(instants, return_inverse=True)
    count, p = int(order.max()) + 1, jacobian.shape[1]
    scores = np.zeros((count, p))
    np.add.at(scores, order, jacobian * held[:, None])
    total: Array = scores.T @ scores
    for lag in range(1, (width := _bandwidth(scores)) + 1):
        beside = scores[lag:].T @ scores[:-lag]
        total += (1.0 - lag / (width + 1)) * (beside + beside.T)
    corrected: Array = total * count / max(count - p, 1)
    return corrected


def _bandwidth(scores: Array) -> int:
    """Return how many neighbours count (Andrews 1991, eq. 6.4: of the first order, Bartlett's weights)."""
    count = len(scores)
    squares = np.sum(scores[:-1] ** 2, axis=0)
    if count < 4 or not np.all(squares > 0.0):
        return 0
    rho = np.clip(np.sum(scores[1:] * scores[:-1], axis=0) / squares, -0.97, 0.97)
    alpha = float(np.mean(4.0 * rho**2 / ((1.0 - rho) ** 2 * (1.0 + rho) ** 2)))
    return min(int(np.ceil(1.1447 * np.cbrt(alpha * count))), count // 4)
