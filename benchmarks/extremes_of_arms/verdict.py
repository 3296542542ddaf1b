"""What became of an extreme arm, and when a run is honest about it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from tmm_gen.simulate.simulation import Simulation

SAYS = 5.0
"""How many times larger than a run says its error may be; mostly it is what it says."""

LEAST = 1e-6
"""Share of the motion below which nothing is promised."""

_SMALLEST = 1e-7
"""Motion below rounding of the length is none."""


@dataclass(frozen=True)
class Verdict:
    """What became of an extreme.

    Parameters
    ----------
    status : str
        "right", "right by energies" or "right by a finer run" (the reference takes too long), "refused", "out of time"
        or "wrong".
    error : float
        Share of the largest motion, or of the energy that moves; zero where refused.
    bound : float
        What the integrator's order explains of it.
    accuracy, sensitivity, sweeps : float
        What the run says of its error, and how; zero where refused.
    unsolved, step_error, imbalance : float
        What the sweeps left of the equations, what the step leaves by itself (:mod:`tmm_gen.simulate.tolerance`), and
        of the balance of energies; zero where refused.
    substeps : int
        Per step.
    said : str
        The refusal, or what was compared.
    """

    status: str
    error: float = 0.0
    bound: float = 0.0
    accuracy: float = 0.0
    sensitivity: float = 0.0
    sweeps: float = 0.0
    unsolved: float = 0.0
    step_error: float = 0.0
    imbalance: float = 0.0
    substeps: int = 0
    said: str = ""


def honest(error: float, run: Simulation) -> bool:
    """Return whether an error is what a run says of itself, within :data:`SAYS` times."""
    assert run.accuracy is not None
    return error <= SAYS * run.accuracy.error + LEAST


def checkpoints(run: Simulation, count: int) -> np.ndarray:
    """Return indices of instants spread over a run, its begin and end among them."""
    return np.unique(np.round(np.linspace(0, run.steps, count + 1)).astype(int))


def off(run: Simulation, wanted: Mapping[str, np.ndarray], shown: np.ndarray) -> float:
    """Return how far a place is from where it should be at some instants, as a share of how far it goes."""
    apart = np.linalg.norm([run.outputs[name][shown] - wanted[name] for name in wanted], axis=0)
    moved = np.linalg.norm([values - values[0] for values in wanted.values()], axis=0)
    return float(np.max(apart) / max(np.max(moved), _SMALLEST))
