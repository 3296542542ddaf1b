"""Every controller tuned by the same optimiser, on the same objective, with the same number of closed loops.

CMA-ES (N. Hansen, A. Ostermeier, Evol. Comput. 9, 2001) on the logarithms of gains or weights, by the package `cma`:
settling time has steps, so that nothing smoother will do, and a dozen numbers are too many for a search that does
not learn how they depend on one another. It begins at the best of points spread evenly over the ranges below; the
scene's own numbers play no part.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.bench import Bench
from tmm_gen.control.objective import objective
from tmm_gen.errors import UserError
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

EVALUATIONS = 1000
"""Of the objective, for each of what is tuned."""
FEWEST = 20
"""Evaluations below which nothing can be learnt."""
_SPREAD_EVENLY = 0.25
"""Share of the evaluations spent on points spread evenly over the ranges."""
_STEP = 0.15
"""Standard deviation of the first steps from the best of them, relative to the ranges."""
_FAR = 1.2
"""What costs so many times as much as the best so far need not be tried to the end."""
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
    """

    key: str
    low: float
    high: float


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
    """

    name: str
    title: str
    controllers: tuple[str, ...]
    knobs: tuple[Knob, ...]


@dataclass(frozen=True)
class Tuned:
    """What came of it.

    Parameters
    ----------
    tunable : Tunable
        What was tuned.
    scene : Scene
        With the numbers found.
    price, price_before : float
        Of the numbers found and of those the scene had.
    """

    tunable: Tunable
    scene: Scene
    price: float
    price_before: float


_WEIGHTS = (("hub", -2.0, 1.0), ("tip_rate", -3.0, 0.0), ("hub_rate", -4.0, -1.0), ("torque", -4.0, -1.0))
"""Two or three decades each, as all that follow: a tip weight of one, and time constants below a second."""
_MORE_WEIGHTS = (
    ("torque_step", -5.0, -2.0),
    ("terminal", 0.0, 2.0),
    ("overshoot", 1.0, 4.0),
    ("hub_bound", 0.0, 3.0),
)
_ESTIMATOR = (
    ("encoder", -3.5, -1.5),  # a count of 16384 is 4e-4 rad
    ("accelerometer", -1.5, 0.5),  # of some m/s^2
    ("torque", -3.0, 0.0),  # of 3 N m
    ("disturbance", -3.0, 0.0),
    ("rate", -3.0, 0.0),  # of some rad/s
)


def _knobs(prefix: str, ranges: Sequence[tuple[str, float, float]]) -> tuple[Knob, ...]:
    return tuple(Knob(f"{prefix}.{key}", low, high) for key, low, high in ranges)


def _pd(name: str, title: str) -> Tunable:
    gains = f"control.baselines.{name.replace('-', '_')}"
    return Tunable(name, title, (name,), (Knob(gains, -1.0, 2.0), Knob(gains, -1.5, 1.5)))


TUNABLE: tuple[Tunable, ...] = (
    Tunable(
        "mpc",
        "weights and estimator of predictive control",
        ("mpc-modes", "mpc-links", "rti-zero"),
        _knobs("control.weights", (*_WEIGHTS, *_MORE_WEIGHTS)) + _knobs("control.estimator", _ESTIMATOR),
    ),
    Tunable("lqr", "weights of LQR", ("lqr",), _knobs("control.baselines.lqr", _WEIGHTS)),
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
        value = 10.0 ** (knob.low + (knob.high - knob.low) * float(place))
        values.setdefault(knob.key, []).append(float(f"{value:.{_DIGITS}g}"))
    return scene.replace(**{key: found if len(found) > 1 else found[0] for key, found in values.items()})


def number(scene: Scene, key: str) -> float | tuple[float, ...]:
    """Return a number of a scene, or a list of them, by its dotted key; zeros where the scene has none."""
    value: Any = scene
    for part in key.split("."):
        value = getattr(value, part)
    return (0.0, 0.0) if value is None else value


def tune(
    bench: Bench,
    tunable: Tunable,
    evaluations: int = EVALUATIONS,
    seed: int = 0,
    advance: Callable[[float], object] | None = None,
    cost: Callable[[Bench, float], float] | None = None,
) -> Tuned:
    """Return the best tuning found.

    Parameters
    ----------
    bench : Bench
        Of the scene.
    tunable : Tunable
        What is tuned.
    evaluations : int
        Of the objective, at least `FEWEST`.
    seed : int
        Of the search; the same one finds the same numbers.
    advance : callable, optional
        Called after each evaluation with the lowest price so far.
    cost : callable, optional
        From a bench, and a price that is bad enough, to its price; by default
        :func:`tmm_gen.control.objective.objective` of the tunable's controllers.

    Raises
    ------
    UserError
        If there is no package `cma`.
    """
    judged = cost or (lambda tried, enough: objective(tried, tunable.controllers, enough=enough))
    best = (math.inf, bench)

    def tried(places: Array) -> float:
        nonlocal best
        other = bench.retuned(turned(bench.scene, tunable, places))
        found = judged(other, _FAR * best[0])
        if found < best[0]:
            best = (found, other)
        if advance is not None:
            advance(best[0])
        return found

    before = judged(bench, math.inf)
    _search(tried, len(tunable.knobs), evaluations, seed)
    return Tuned(tunable, best[1].scene, best[0], before)


def _search(cost: Callable[[Array], float], dimensions: int, evaluations: int, seed: int) -> None:
    """Evaluate a function so many times over the unit cube, more and more where it is low."""
    from scipy.stats import qmc  # slow to import

    cma: Any = _cma()
    spread = max(FEWEST // 2, round(_SPREAD_EVENLY * evaluations))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # Sobol's points are best balanced in powers of two
        first = qmc.Sobol(dimensions, seed=seed).random(spread)
    prices = [cost(places) for places in first]
    random = np.random.default_rng(seed + 1)
    options = {
        "bounds": [0.0, 1.0],
        "randn": lambda *shape: random.standard_normal(shape),
        "seed": seed + 1,
        "verbose": -9,
    }
    strategy = cma.CMAEvolutionStrategy(first[int(np.argmin(prices))], _STEP, options)
    left = evaluations - spread
    while left > 0:
        places = strategy.ask()
        found = [cost(place) for place in places[:left]]
        left -= len(found)
        if len(found) == len(places):
            strategy.tell(places, found)


def _cma() -> Any:
    try:
        import cma
    except ImportError:
        raise UserError("tuning needs the package cma: pip install 'tmm-gen[mpc]'") from None
    return cma
