"""How many iterations a controller's quadratic program may take: the same in Python and in emitted C."""

from __future__ import annotations

import numpy as np

from tmm_gen.control.task.problem import ControlProblem

PER_INPUT = 5
"""Iterations of the solver a sample may take, per input, and for each wall per three samples of the horizon."""
PER_RATE = 10
"""The same, per sample of the horizon and hub whose rate is bounded: such bounds are met along most of a way, and the
solver goes to and fro between them and those of torques and of their changes."""


def iteration_limit(problem: ControlProblem) -> int:
    """Return how many iterations a sample may take, those without soft bounds included."""
    count = problem.horizon
    rates = int(np.count_nonzero(np.isfinite(problem.hub_rate)))
    inputs = problem.count * count + len(problem.keeps) * count / 3.0
    return round(PER_INPUT * inputs + PER_RATE * rates * count)


def at_first(limit: int) -> int:
    """Return how many of these may go into the search with soft bounds, so that some are left for one without them."""
    return limit * 2 // 3
