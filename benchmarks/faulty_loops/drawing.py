"""Cases drawn by hypothesis, each run once, without a store of its own and without shrinking."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis.strategies import SearchStrategy

Case = TypeVar("Case")
Outcome = TypeVar("Outcome")


def outcomes_of(
    cases: SearchStrategy[Case], run: Callable[[Case], Outcome], count: int, number: int
) -> list[tuple[Case, Outcome]]:
    """Run as many cases as are asked for, the same ones for the same number."""
    found: list[tuple[Case, Outcome]] = []

    @seed(number)
    @settings(
        max_examples=count,
        database=None,
        deadline=None,
        phases=[Phase.generate],
        suppress_health_check=list(HealthCheck),
    )
    @given(case=cases)
    def draw(case: Case) -> None:
        found.append((case, run(case)))

    draw()
    return found
