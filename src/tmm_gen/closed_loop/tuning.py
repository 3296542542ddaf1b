"""Every controller tuned by the same optimiser, on the same objective, with the same number of closed loops.

The logarithms of gains or weights are searched (:mod:`tmm_gen.closed_loop.search`), over ranges; the scene's own
numbers play no part in that, unless they are to be refined. They are one of the candidates, and stay where nothing
better is found. Predictive control without bounds is the regulator of the same
weights, whose loops cost a tenth: so weights and estimator of a regulator are searched first, and predictive control
begins at one of the valleys found there, that which is the best for itself: a regulator by modes bears estimators
that others do not.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.closed_loop.knobs import Tunable, places_of, turned
from tmm_gen.closed_loop.pricing import OneByOne, Pricing
from tmm_gen.closed_loop.search import search_nearby, search_widely
from tmm_gen.closed_loop.tunables import like_lqr
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

EVALUATIONS = 1000
"""Of the objective, for each of what is tuned."""
FEWEST = 20
"""Evaluations below which nothing can be learnt."""


@dataclass(frozen=True)
class Tuned:
    """What came of it.

    Parameters
    ----------
    tunable : Tunable
        What was tuned.
    scene : Scene
        With the numbers found.
    places : array, (knobs,)
        Where these are in their ranges, 0 to 1.
    price, price_before : float
        Of the numbers found and of those the scene had.
    ends : tuple of array, (knobs,)
        Where descents of the search ended; the best first.
    """

    tunable: Tunable
    scene: Scene
    places: Array
    price: float
    price_before: float
    ends: tuple[Array, ...]

    @property
    def kept(self) -> bool:
        """Whether nothing better was found than the numbers the scene had, which stay."""
        return not self.price < self.price_before


def tune(
    scene: Scene,
    tunable: Tunable,
    evaluations: int = EVALUATIONS,
    seed: int = 0,
    advance: Callable[[float], object] | None = None,
    pricing: Pricing | None = None,
    refine: bool = False,
) -> Tuned:
    """Return the best tuning found: that of the scene itself where no other costs less.

    Parameters
    ----------
    scene : Scene
        With ``[control]``.
    tunable : Tunable
        What is tuned.
    evaluations : int
        Of the objective, at least `FEWEST`; half of them go to what is tuned first, if there is such.
    seed : int
        Of the search; the same one finds the same numbers.
    advance : callable, optional
        Called after each evaluation with the lowest price so far.
    pricing : callable, optional
        What finds prices; by default :class:`~tmm_gen.closed_loop.pricing.OneByOne`, of
        :func:`tmm_gen.closed_loop.objective.objective`.
    refine : bool
        Whether to begin at the numbers the scene has, and nowhere else.

    Raises
    ------
    UserError
        If there is no package `cma`.
    """
    pricing = pricing or OneByOne()
    begins = [places_of(scene, tunable)] if refine else []
    if tunable.first is not None and not refine:
        first = tune(scene, tunable.first, evaluations // 2, seed, advance, pricing)
        begins = [_begin(tunable, tunable.first, end) for end in first.ends]
        evaluations -= evaluations // 2
    (before,) = pricing([scene], tunable.controllers, math.inf)
    best = (before, scene, places_of(scene, tunable))

    def prices(points: Sequence[Array], enough: float) -> list[float]:
        nonlocal best
        scenes = [turned(scene, tunable, places) for places in points]
        found = []
        for tried, places, price in zip(
            scenes, points, pricing(scenes, tunable.controllers, enough), strict=True
        ):
            found.append(price)
            if price < best[0]:
                best = (price, tried, places)
            if advance is not None:
                advance(best[0])
        return found

    if begins:
        ends = search_nearby(prices, begins, evaluations, seed)
    else:
        ends = search_widely(prices, len(tunable.knobs), evaluations, seed)
    return Tuned(tunable, best[1], best[2], best[0], before, tuple(ends))


def _begin(tunable: Tunable, first: Tunable, end: Array) -> Array:
    """Return where to begin if what was tuned first ended there; what that does not know is at its low end."""
    places = {knob.key: place for knob, place in zip(first.knobs, end, strict=True)}
    keys = (like_lqr(knob.key) for knob in tunable.knobs)
    return np.array([places.get(key, 0.0) for key in keys])
