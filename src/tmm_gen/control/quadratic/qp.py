"""Quadratic programs by DAQP.

Chosen because it measures best here: a dual active-set method in C with warm starts, microseconds for some tens of
variables, an exact solution, and MIT-licensed sources without allocation that run on microcontrollers as well.
D. Arnstroem, A. Bemporad, D. Axehill, A dual active-set solver for embedded quadratic programming using recursive
LDL' updates, IEEE TAC 67 (2022).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.command import Status
from tmm_gen.control.quadratic.condensed import Condensed
from tmm_gen.control.quadratic.iterations import at_first, iteration_limit
from tmm_gen.extras import extra

Array = NDArray[np.float64]

INFINITE = 1e30
"""DAQP's infinity."""
_FEASIBLE = 1e-4
"""By how much a row may be off, relative to 1 and its bounds, before the answer is not believed."""
_SOLVED, _NO_SOLUTION = 1, -1


def require_daqp() -> Any:
    """Return the package `daqp`.

    Raises
    ------
    UserError
        If it is not installed.
    """
    return extra("mpc", "predictive control")


@dataclass(frozen=True, eq=False)
class Solution:
    """Of a quadratic program.

    Parameters
    ----------
    point : array, (n,)
        Meaningful where the status is ``OK``.
    status : Status
        Outcome.
    iterations : int
        Changes of the active set.
    """

    point: Array
    status: Status
    iterations: int


class QuadraticProgram:
    """``min 1/2 z'H z + f'z`` under ``low <= (z, A z) <= high``; keeps its workspace and active set.

    The first entries of the bounds are those of the first variables.

    Parameters
    ----------
    hessian : array, (n, n)
        Positive definite.
    rows : array, (m, n)
        A.
    bounded : int
        Number of variables with bounds of their own, the first ones.
    limit : int
        Changes of the active set that a solution may take; see :mod:`tmm_gen.control.quadratic.iterations`.
    """

    def __init__(self, hessian: Array, rows: Array, bounded: int, limit: int) -> None:
        daqp = require_daqp()
        self._rows = rows
        self._bounded = bounded
        self._limit = limit
        self._allowed = 0
        # variables without bounds of their own, slacks, in units in which they weigh 1: however much they weigh, pivots
        # are then of one size, and none is taken for zero
        self._units = np.ones(len(hessian))
        self._units[bounded:] = np.diag(hessian)[bounded:] ** -0.5
        self._solver: Any = daqp.Model()
        width = bounded + len(rows)
        self._cold = True
        self._left_out = np.ones(2 * width, bool)
        flag, _ = self._solver.setup(
            np.ascontiguousarray(hessian * np.outer(self._units, self._units)),
            np.zeros(len(hessian)),
            np.ascontiguousarray(rows * self._units),
            np.full(width, INFINITE),
            np.full(width, -INFINITE),
            np.zeros(width, dtype=np.int32),
        )
        if flag < 0:
            raise ArithmeticError(
                f"DAQP finds no positive definite Hessian, flag {flag}: weights of [control] are too far apart"
            )

    @classmethod
    def of(cls, condensed: Condensed) -> QuadraticProgram:
        """Return that of a controller, with as many iterations as its problem has."""
        limit = iteration_limit(condensed.problem)
        return cls(condensed.hessian, condensed.rows, condensed.inputs, limit)

    def forget(self) -> None:
        """Start the next solution from no active set."""
        self._cold = True

    def solve_softly(
        self,
        gradient: Array,
        low: Array,
        high: Array,
        soft: NDArray[np.bool_],
        hessian: Array | None = None,
        rows: Array | None = None,
    ) -> Solution:
        """Solve, and if that fails once more without the bounds that are soft: ``RELAXED`` if that works."""
        found = self._solved(at_first(self._limit), gradient, low, high, hessian, rows)
        if found.status in (Status.OK, Status.NOT_FINITE):
            return found
        left = self._limit - found.iterations
        again = self._solved(left, gradient, np.where(soft, -np.inf, low), np.where(soft, np.inf, high))
        status = Status.RELAXED if again.status is Status.OK else again.status
        return Solution(again.point, status, found.iterations + again.iterations)

    def solve(
        self,
        gradient: Array,
        low: Array,
        high: Array,
        hessian: Array | None = None,
        rows: Array | None = None,
    ) -> Solution:
        """Solve with a new gradient and new bounds, and a new Hessian or new rows where given."""
        return self._solved(self._limit, gradient, low, high, hessian, rows)

    def _solved(
        self,
        limit: int,
        gradient: Array,
        low: Array,
        high: Array,
        hessian: Array | None = None,
        rows: Array | None = None,
    ) -> Solution:
        if rows is not None:
            self._rows = rows
        nothing = np.full(len(gradient), np.nan)
        parts = (gradient, *(part for part in (hessian, rows) if part is not None))
        if (
            not all(np.all(np.isfinite(part)) for part in parts)
            or np.isnan(low).any()
            or np.isnan(high).any()
        ):
            return Solution(nothing, Status.NOT_FINITE, 0)
        if np.any(low > high):
            return Solution(nothing, Status.INFEASIBLE, 0)
        left_out = np.abs(np.concatenate([low, high])) >= INFINITE
        # no bound that is left out may stay active
        self._cold = self._cold or bool(np.any(left_out != self._left_out))
        self._left_out = left_out
        flag = self._solver.update(
            H=None if hessian is None else np.ascontiguousarray(hessian * np.outer(self._units, self._units)),
            f=gradient * self._units,
            A=np.ascontiguousarray(rows * self._units)
            if rows is not None and len(rows)
            else None,  # fails at none
            bupper=np.minimum(high, INFINITE),
            blower=np.maximum(low, -INFINITE),
            # without it the active set of the last solution stays: a warm start
            sense=np.zeros(len(low), dtype=np.int32) if self._cold else None,
        )
        if flag < 0:
            self._cold = True
            return Solution(nothing, Status.NOT_FINITE, 0)
        if limit != self._allowed:
            self._solver.settings = {"iter_limit": limit}
            self._allowed = limit
        point, _, flag, information = self._solver.solve()
        point, iterations = self._units * np.asarray(point, float), int(information["iterations"])
        status = self._judged(flag, point, low, high)
        self._cold = status is not Status.OK
        return Solution(point, status, iterations)

    def _judged(self, flag: int, point: Array, low: Array, high: Array) -> Status:
        """Return the status of what the solver returned: its word is not enough."""
        if flag == _NO_SOLUTION:
            return Status.INFEASIBLE
        if flag != _SOLVED:
            return Status.ITERATIONS
        if not np.all(np.isfinite(point)):
            return Status.NOT_FINITE
        values = np.concatenate([point[: self._bounded], self._rows @ point])
        room = _FEASIBLE * (1.0 + np.abs(values))
        return Status.OK if np.all((values >= low - room) & (values <= high + room)) else Status.INFEASIBLE
