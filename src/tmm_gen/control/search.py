"""A search for the lowest price over the unit cube, where prices have ridges and the dimensions are a dozen.

CMA-ES (N. Hansen, A. Ostermeier, Evol. Comput. 9, 2001), by the package `cma`: such prices need a search that learns
how the dimensions depend on one another. Points come in batches, whose prices may be found side by side, and with the
question how bad is bad enough: trying what is worse is broken off.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import UserError

Array = NDArray[np.float64]
Prices = Callable[[Sequence[Array], float], Sequence[float]]
"""From a batch of points, and a price that is bad enough, to their prices."""

_EVENLY, _FINALLY = 0.2, 0.3
"""Shares of the evaluations spent on points spread evenly, and on the last descent."""
_BATCH = 16
"""How many points come at once where they are spread."""
_WIDE, _NEAR = 0.2, 0.05
"""Standard deviation of the first steps: from the best of these points, or from one that is known to be good."""
_COARSE, _SETTLED = 0.02, 3e-3
"""Standard deviation of the steps below which a descent will find no other valley, and below which they make no
difference."""
_FAR = 1.5
"""Of points spread evenly, what costs so many times as much as the best so far is bad enough."""


def search_widely(prices: Prices, dimensions: int, evaluations: int, seed: int) -> None:
    """Evaluate a price so many times: at points spread evenly, then around the best, the next best, and so on.

    These descents end where they will not leave their valley any more; the last evaluations are spent around the best
    point of all.

    Parameters
    ----------
    prices : callable
        Of a batch of points.
    dimensions : int
        Of the cube.
    evaluations : int
        How many.
    seed : int
        Of random numbers; the same one leads to the same points.

    Raises
    ------
    UserError
        If there is no package `cma`.
    """
    from scipy.stats import qmc  # slow to import

    best = _Best(prices)
    spread, last = max(1, round(_EVENLY * evaluations)), round(_FINALLY * evaluations)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # Sobol's points are best balanced in powers of two
        points = qmc.Sobol(dimensions, seed=seed).random(spread)
    found: list[float] = []
    for begin in range(0, spread, _BATCH):
        found += best(points[begin : begin + _BATCH], _FAR * min(found, default=math.inf))
    begins = points[np.argsort(found, kind="stable")]
    _descend(best, begins, evaluations - spread - last, _WIDE, _COARSE, seed)
    search_nearby(best, best.point, last, seed)


def search_nearby(prices: Prices, begin: Array, evaluations: int, seed: int) -> None:
    """Evaluate a price so many times around a point; arguments as for :func:`search_widely`."""
    _descend(prices, begin[None, :], evaluations, _NEAR, _SETTLED, seed)


class _Best:
    """Prices that remember the best point."""

    def __init__(self, prices: Prices) -> None:
        self._prices, self._lowest = prices, math.inf
        self.point: Array = np.zeros(0)

    def __call__(self, points: Sequence[Array], enough: float) -> Sequence[float]:
        found = self._prices(points, enough)
        place = int(np.argmin(found))
        if found[place] < self._lowest:
            self._lowest, self.point = found[place], points[place]
        return found


def _descend(prices: Prices, begins: Array, left: int, step: float, end: float, seed: int) -> None:
    """Run CMA-ES from one point after the other, and over again, as long as evaluations are left."""
    cma = _cma()
    random = np.random.default_rng(seed + 1)
    options = {
        "bounds": [0.0, 1.0],
        "randn": lambda *shape: random.standard_normal(shape),
        "seed": seed + 1,
        "tolx": end,
        "verbose": -9,
    }
    run = 0
    while left > 0:
        strategy = cma.CMAEvolutionStrategy(begins[run % len(begins)], step, options)
        enough = math.inf
        while left > 0 and not strategy.stop():
            points = strategy.ask()
            found = list(prices(points[:left], enough))
            enough = float(np.median(found))  # half of the next points will cost more and count for little
            left -= len(found)
            if len(found) == len(points):
                strategy.tell(points, found)
        run += 1


def _cma() -> Any:
    try:
        import cma
    except ImportError:
        raise UserError("tuning needs the package cma: pip install 'tmm-gen[mpc]'") from None
    return cma
