"""Measuring times on a machine that others use too: by turns, medians, and how far measurements are apart."""

from __future__ import annotations

import statistics
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

Key = TypeVar("Key")

ROUNDS = 9


@dataclass(frozen=True)
class Cost:
    """Time of one step.

    Parameters
    ----------
    ns_per_step : float
        Median over the rounds.
    spread : float
        Half the distance between the quartiles, over the median.
    rounds : int
        How many.
    """

    ns_per_step: float
    spread: float
    rounds: int


def by_turns(
    timers: Mapping[Key, Callable[[], float]],
    rounds: int = ROUNDS,
    advance: Callable[[float], None] | None = None,
) -> dict[Key, Cost]:
    """Call functions that measure nanoseconds, all of them in each round: what slows the machine slows all of them.

    Parameters
    ----------
    timers : mapping to callable
        What measures once.
    rounds : int
        Measurements of each.
    advance : callable, optional
        Called with 1 after each round.
    """
    found: dict[Key, list[float]] = {key: [] for key in timers}
    for _ in range(rounds):
        for key, measure in timers.items():
            found[key].append(measure())
        if advance is not None:
            advance(1)
    return {key: cost_of(samples) for key, samples in found.items()}


def cost_of(samples: Sequence[float]) -> Cost:
    """Return what some measurements tell, in nanoseconds."""
    median = statistics.median(samples)
    if len(samples) < 2:
        return Cost(median, 0.0, len(samples))
    low, _, high = statistics.quantiles(samples, n=4, method="inclusive")
    return Cost(median, 0.5 * (high - low) / median, len(samples))
