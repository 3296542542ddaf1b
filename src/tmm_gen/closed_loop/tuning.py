"""Every controller tuned by the same optimiser, on the same objective, with the same number of closed loops.

The logarithms of gains or weights are searched (:mod:`tmm_gen.closed_loop.search`), over ranges; the scene's own
numbers play no part, unless they are to be refined. Predictive control without bounds is the regulator of the same
weights, whose loops cost a tenth: so weights and estimator of a regulator are searched first, and predictive control
begins at one of the valleys found there, that which is the best for itself: a regulator by modes bears estimators
that others do not.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.closed_loop.pricing import OneByOne, Pricing
from tmm_gen.closed_loop.search import search_nearby, search_widely
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

EVALUATIONS = 1000
"""Of the objective, for each of what is tuned."""
FEWEST = 20
"""Evaluations below which nothing can be learnt."""
_DIGITS = 3


@dataclass(frozen=True)
class Knob:
    """A number to be tuned.

    Parameters
    ----------
    key : str
        In the scene, dotted; the same key twice makes a list.
    low, high : float
        Decimal logarithms of its range.
    grid : float, optional
        What its values are multiples of; by default they have three digits.
    """

    key: str
    low: float
    high: float
    grid: float | None = None

    def place(self, value: float) -> float:
        """Return where a value is in its range, 0 to 1; the nearer end for what is out of it."""
        logarithm = math.log10(value) if value > 0.0 else -math.inf
        return min(max((logarithm - self.low) / (self.high - self.low), 0.0), 1.0)

    def value(self, place: float) -> float:
        """Return what it is turned to at a place in its range, 0 to 1."""
        value = 10.0 ** (self.low + (self.high - self.low) * place)
        if self.grid is not None:
            value = self.grid * round(value / self.grid)
        return float(f"{value:.{_DIGITS}g}")


@dataclass(frozen=True)
class Tunable:
    """What is tuned together.

    Parameters
    ----------
    name : str
        As on the command line.
    title : str
        A few words.
    controllers : tuple of str
        Whose objectives count, all with one tuning.
    knobs : tuple of Knob
        What may be turned.
    first : Tunable, optional
        What is tuned before, and where the search then begins.
    """

    name: str
    title: str
    controllers: tuple[str, ...]
    knobs: tuple[Knob, ...]
    first: Tunable | None = None


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


_WEIGHTS = (("hub", -1.0, 2.0), ("tip_rate", -2.0, 1.0), ("hub_rate", -4.0, -1.0), ("torque", -4.0, -1.0))
"""Three decades each, as most that follow: a tip weight of one, and time constants of about a second or less."""
_MORE_WEIGHTS = (
    ("torque_step", -5.0, -2.0),
    ("overshoot", 0.0, 3.0),
    ("hub_bound", 0.0, 3.0),
)
_ESTIMATOR = (
    ("encoder", -4.0, -1.5),  # from a count of good encoders
    ("accelerometer", -1.5, 1.0),  # of some tens of m/s^2
    ("torque", -3.0, 0.0),  # of 3 N m
    ("disturbance", -3.0, 0.0),
    ("rate", -2.5, 0.5),  # of some rad/s
)


_PAYLOAD = Knob("control.payload", 0.0, math.log10(1.4), grid=0.05)
"""Of what is tried the heaviest carries half as much again. A grid, since models are made anew for each value."""


def _knobs(prefix: str, ranges: Sequence[tuple[str, float, float]]) -> tuple[Knob, ...]:
    return tuple(Knob(f"{prefix}.{key}", low, high) for key, low, high in ranges)


def _pd(name: str, title: str) -> Tunable:
    gains = f"control.baselines.{name.replace('-', '_')}"
    return Tunable(name, title, (name,), (Knob(gains, -1.0, 2.0), Knob(gains, -1.5, 1.5)))


_OF_MPC, _OF_LQR = "control.weights", "control.baselines.lqr"
_ESTIMATING = (*_knobs("control.estimator", _ESTIMATOR), _PAYLOAD)
_REGULATOR = Tunable(
    "regulator",
    "weights and estimator of a regulator",
    ("lqr",),
    (*_knobs(_OF_LQR, _WEIGHTS), *_ESTIMATING),
)

TUNABLE: tuple[Tunable, ...] = (
    Tunable(
        "mpc",
        "weights and estimator of predictive control",
        ("mpc-modes", "mpc-links", "rti-zero", "rti"),
        (*_knobs(_OF_MPC, (*_WEIGHTS, *_MORE_WEIGHTS)), *_ESTIMATING),
        _REGULATOR,
    ),
    Tunable("lqr", "weights of LQR", ("lqr",), _knobs(_OF_LQR, _WEIGHTS)),
    _pd("pd", "gains of PD"),
    _pd("pd-zv", "gains of PD, ZV shaper"),
    _pd("pd-zvd", "gains of PD, ZVD shaper"),
)
"""In this order, since LQR takes the estimator that was found for predictive control."""


def turned(scene: Scene, tunable: Tunable, places: Array) -> Scene:
    """Return a scene with its knobs turned, numbers rounded to three digits.

    Parameters
    ----------
    scene : Scene
        Any.
    tunable : Tunable
        Whose knobs.
    places : array, (knobs,)
        In the ranges, 0 to 1.
    """
    values: dict[str, list[float]] = {}
    for knob, place in zip(tunable.knobs, places, strict=True):
        values.setdefault(knob.key, []).append(knob.value(float(place)))
    return scene.replace(**{key: found if len(found) > 1 else found[0] for key, found in values.items()})


def number(scene: Scene, key: str) -> float | tuple[float, ...]:
    """Return a number of a scene, or a list of them, by its dotted key; zeros where the scene has none."""
    value: Any = scene
    for part in key.split("."):
        value = getattr(value, part)
    return (0.0, 0.0) if value is None else value


def places_of(scene: Scene, tunable: Tunable) -> Array:
    """Return where a scene's numbers are in the ranges of the knobs, (knobs,), 0 to 1."""
    values = np.hstack([number(scene, key) for key in dict.fromkeys(knob.key for knob in tunable.knobs)])
    return np.array([knob.place(float(value)) for knob, value in zip(tunable.knobs, values, strict=True)])


def tune(
    scene: Scene,
    tunable: Tunable,
    evaluations: int = EVALUATIONS,
    seed: int = 0,
    advance: Callable[[float], object] | None = None,
    pricing: Pricing | None = None,
    refine: bool = False,
) -> Tuned:
    """Return the best tuning found.

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
    best = (math.inf, scene, np.zeros(0))

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

    (before,) = pricing([scene], tunable.controllers, math.inf)
    if refine:  # what is there already is not given up for something worse
        best = (before, scene, places_of(scene, tunable))
    if begins:
        ends = search_nearby(prices, begins, evaluations, seed)
    else:
        ends = search_widely(prices, len(tunable.knobs), evaluations, seed)
    return Tuned(tunable, best[1], best[2], best[0], before, tuple(ends))


def _begin(tunable: Tunable, first: Tunable, end: Array) -> Array:
    """Return where to begin if what was tuned first ended there; what that does not know is at its low end."""
    places = {knob.key: place for knob, place in zip(first.knobs, end, strict=True)}
    keys = (knob.key.replace(_OF_MPC, _OF_LQR) for knob in tunable.knobs)
    return np.array([places.get(key, 0.0) for key in keys])
