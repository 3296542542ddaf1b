"""Long arrays of few values, written as runs of equal ones: the text does not grow with the arm."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import groupby

_LONG = 64
"""Entries up to which an array is written out: it is read more easily."""


@dataclass(frozen=True)
class Run:
    """Equal neighbours of an array.

    Parameters
    ----------
    value : float
        Of all of them.
    start, stop : int
        The first, and the one behind the last.
    """

    value: float
    start: int
    stop: int


def runs(values: Sequence[float]) -> tuple[Run, ...] | None:
    """Return the runs of an array; None for one that is better written out."""
    if len(values) <= _LONG:
        return None
    found: list[Run] = []
    for value, group in groupby(values):
        start = found[-1].stop if found else 0
        found.append(Run(value, start, start + sum(1 for _ in group)))
    return tuple(found) if 4 * len(found) <= len(values) else None


def python_items(values: Sequence[float], literal: Callable[[float], str] = repr) -> list[str]:
    """Return the entries of a tuple in Python, long runs of equal ones as one item."""
    found = runs(values)
    if found is None:
        return [literal(value) for value in values]
    items: list[str] = []
    for run in found:
        count = run.stop - run.start
        items.append(literal(run.value) if count == 1 else f"*({literal(run.value)},) * {count}")
    return items
