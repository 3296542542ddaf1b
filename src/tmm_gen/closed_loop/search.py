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

from tmm_gen.extras import extra

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


def search_widely(prices: Prices, dimensions: int, evaluations: int, seed: int) -> list[Array]:
    """Evaluate a price so many times: at points spread evenly, then around the best, the next best, and so on.

    These descents end where they will not leave their valley any more; the last evaluations are spent around the best
    point of all. Return the lowest point of each descent, those of the lowest prices first.

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
    ends = _descend(best, begins, evaluations - spread - last, _WIDE, _COARSE, seed)
    ends += _descend(best, best.point[None, :], last, _NEAR, _SETTLED, seed)
    return [end.point for end in sorted(ends, key=lambda end: end.price)]


def search_nearby(prices: Prices, begins: Sequence[Array], evaluations: int, seed: int) -> list[Array]:
    """Evaluate a price so many times, at some points and around the best of them; return the lowest point of all.

    Arguments else as for :func:`search_widely`.
    """
    best = _Best(prices)
    best(begins[:evaluations], math.inf)
    _descend(best, best.point[None, :], evaluations - len(begins), _NEAR, _SETTLED, seed)
    return [best.point]


class _Best:
    """Prices that remember the best point, and what it costs."""

    def __init__(self, prices: Prices) -> None:
        self._prices, self.price = prices, math.inf
        self.point: Array = np.zeros(0)

    def __call__(self, points: Sequence[Array], enough: float) -> list[float]:
        found = list(self._prices(points, enough))
        place = int(np.argmin(found))
        if found[place] < self.price:
            self.price, self.point = found[place], points[place]
        return found


def _descend(prices: Prices, begins: Array, left: int, step: float, end: float, seed: int) -> list[_Best]:
    """Run CMA-ES from one point after the other, and over again, as long as evaluations are left.

    Return what was best of each.
    """
    cma = require_cma()
    random = np.random.default_rng(seed + 1)
    options = {
        "bounds": [0.0, 1.0],
        "randn": lambda *shape: random.standard_normal(shape),
        "seed": seed + 1,
        "tolx": end,
        "verbose": -9,
    }
    ends: list[_Best] = []
    while left > 0:
        strategy = cma.CMAEvolutionStrategy(begins[len(ends) % len(begins)], step, options)
        ends.append(_Best(prices))
        enough = math.inf
        while left > 0 and not strategy.stop():
            points = strategy.ask()
            found = ends[-1](points[:left], enough)
            enough = float(np.median(found))  # half of the next points will cost more and count for little
            left -= len(found)
            if len(found) == len(points):
                strategy.tell(points, found)
    return ends


def require_cma() -> Any:
    """Return the package `cma`.

    Raises
    ------
    UserError
        If it is not installed.
    """
    return extra("mpc", "tuning", "cma")
