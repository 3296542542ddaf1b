"""The longest step with which each family keeps an error bound."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from tmm_gen.study.configuration import Configuration, Family
from tmm_gen.study.outcome import Result

FEWEST = 10
"""Steps over the whole time at least; with fewer there would be nothing to look at."""

_FINEST = 16
"""Halvings of the longest step tried before a family is given up."""

_BISECTIONS = 5
_SURE = 2
"""So many steps in a row, each half of the one before, have to be good: one may be by chance."""

Evaluate = Callable[[Configuration], Result]


@dataclass(frozen=True)
class Searched:
    """A family's longest good step, or its best.

    Parameters
    ----------
    configuration : Configuration
        With that step.
    result : Result
        At that step.
    good : bool
        Whether it is within the bound.
    beyond : tuple of (Configuration, Result), optional
        The longer step next to it that is not good any more.
    """

    configuration: Configuration
    result: Result
    good: bool
    beyond: tuple[Configuration, Result] | None = None


def longest_step(
    family: Family, bound: float, until: float, evaluate: Evaluate, shortest: float = 0.0
) -> Searched | None:
    """Search the longest step of a family that keeps a bound.

    Steps are halved until two in a row are good; between the longer of these and the one before, the interval is
    halved in logarithms, and the step found is rounded down to two digits.

    Parameters
    ----------
    family : Family
        What is generated.
    bound : float
        On the time error, relative.
    until : float
        s; the longest step tried is the `FEWEST`-th part of it.
    evaluate : callable
        Runs a configuration.
    shortest : float
        s; shorter steps are not worth trying.

    Returns
    -------
    Searched or None
        None where no run finished.
    """
    tried: list[tuple[Configuration, Result]] = []
    for k in range(_FINEST + 1):
        step = until / (FEWEST * 2**k)
        if step < shortest and k:
            break
        tried.append(_at(family, step, evaluate))
        if all(_good(result, bound) for _, result in tried[-_SURE:]) and len(tried) >= _SURE:
            return _refined(family, bound, tried, evaluate)
    finished = [(c, r) for c, r in tried if r.error is not None]
    if not finished:
        return None
    configuration, result = min(finished, key=lambda item: item[1].error or 0.0)
    return Searched(configuration, result, _good(result, bound))


def rounded_down(step: float) -> float:
    """Return a step with two digits, not longer."""
    digits = 1 - math.floor(math.log10(step))
    scaled = math.floor(step * 10.0**digits * (1.0 + 1e-12))
    return float(f"{scaled}e{-digits}")


def _refined(
    family: Family, bound: float, tried: list[tuple[Configuration, Result]], evaluate: Evaluate
) -> Searched:
    good = tried[-_SURE]
    if len(tried) == _SURE:  # good from the start
        return Searched(*good, good=True)
    bad = tried[-_SURE - 1]
    for _ in range(_BISECTIONS):
        middle = math.sqrt(good[0].step * bad[0].step)
        candidate = _at(family, middle, evaluate)
        good, bad = (candidate, bad) if _good(candidate[1], bound) else (good, candidate)
    neat = _at(family, rounded_down(good[0].step), evaluate)
    return Searched(*(neat if _good(neat[1], bound) else good), good=True, beyond=bad)


def _at(family: Family, step: float, evaluate: Evaluate) -> tuple[Configuration, Result]:
    configuration = Configuration(family, step)
    return configuration, evaluate(configuration)


def _good(result: Result, bound: float) -> bool:
    return result.error is not None and result.error <= bound
