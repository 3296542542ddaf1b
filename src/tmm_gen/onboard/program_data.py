"""A condensed quadratic program as DAQP's core wants it: a least-distance problem with normalised rows.

With ``H = R' R`` and ``v = R^-T f`` the problem in ``y = R u + v`` is: smallest ``|y|`` under ``low <= M y <= high``
shifted by ``M v``, where ``M = A R^-1``. Soft rows need no slack variables: a quadratic penalty ``W s^2 / 2`` adds
``1 / W`` to the diagonal of the dual problem (Arnstroem, Bemporad and Axehill 2022).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.quadratic.condensed import Condensed
from tmm_gen.control.quadratic.iterations import iteration_limit
from tmm_gen.control.task.problem import ControlProblem

Array = NDArray[np.float64]

INFINITE = 1e30
"""DAQP's infinity."""
ACTIVE_PER_INPUT = 2.4
"""How many bounds per input may be active at once: soft rows can be more, where hard ones could not. All of them would
be three per input, and half as much memory again. Where more would be, soft ones are passed at nearly every sample
anyway, and give way."""


@dataclass(frozen=True, eq=False)
class ProgramData:
    """Tables of a quadratic program of m N inputs with bounds and some rows.

    Parameters
    ----------
    horizon, motors : int
        N and m.
    inverse : array, (m N, m N)
        ``R^-1``, upper triangular.
    rows : array, (r, m N)
        ``A``.
    low, high : array, (m N + r,)
        Bounds of inputs and rows, infinite as `INFINITE`.
    softness : array, (m N + r,)
        ``1 / W`` of soft rows, zero of hard ones.
    stopping : array, (m,)
        See :attr:`~tmm_gen.control.quadratic.condensed.Condensed.stopping`.
    capacity, iteration_limit : int
        How many bounds may be active at once; how many iterations a solution may take.
    """

    horizon: int
    motors: int
    inverse: Array
    rows: Array
    low: Array
    high: Array
    softness: Array
    stopping: Array
    capacity: int
    iteration_limit: int

    @property
    def inputs(self) -> int:
        """Number of inputs, m N."""
        return len(self.inverse)

    @property
    def scaling(self) -> Array:
        """What normalises the rows of ``R^-1`` and ``A R^-1``, (m N + r,); one for rows of zeros."""
        lengths = np.linalg.norm(np.vstack([self.inverse, self.rows @ self.inverse]), axis=1)
        return np.asarray(1.0 / np.where(lengths > 0.0, lengths, 1.0), float)


def program_data(problem: ControlProblem, condensed: Condensed) -> ProgramData:
    """Return the tables of a condensed problem; its slopes must be those of the controller."""
    count, kinds = problem.horizon, condensed.kinds
    upper = np.linalg.cholesky(condensed.input_hessian).T
    low = [*problem.torque[0], *(kind.low for kind in kinds)]
    high = [*problem.torque[1], *(kind.high for kind in kinds)]
    soft = [0.0] * problem.count + [1.0 / kind.weight for kind in kinds]
    # in each sample a motor has three kinds of bounds, a wall one, and a hub's rate: without room for them the solver
    # begins cold again
    walls, rates = len(problem.keeps), int(np.count_nonzero(np.isfinite(problem.hub_rate)))
    met = condensed.inputs + (walls + rates) * count / 3.0
    return ProgramData(
        horizon=count,
        motors=problem.count,
        inverse=np.linalg.inv(upper),
        rows=condensed.input_rows,
        low=np.maximum(np.repeat(low, count), -INFINITE),
        high=np.minimum(np.repeat(high, count), INFINITE),
        softness=np.repeat(soft, count),
        stopping=condensed.stopping,
        capacity=round(ACTIVE_PER_INPUT * met),
        iteration_limit=iteration_limit(problem),
    )
