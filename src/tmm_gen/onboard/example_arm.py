"""The arm of an emitted controller's example: the first modes of the scene's."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.bench import Bench
from tmm_gen.control.kalman import present_sensors
from tmm_gen.control.linear import LinearModel

Array = NDArray[np.float64]

_DURATION = 3.0
"""s."""


@dataclass(frozen=True, eq=False)
class ExampleArm:
    """What the example moves.

    Parameters
    ----------
    model : LinearModel
        By modes.
    reference : float
        Tip angle to reach, rad.
    samples : int
        How long the example lasts.
    measure, feed, shown : array, (p, m), (p,) and (p,)
        What the sensors show by the state and by the torque, and at the target.
    """

    model: LinearModel
    reference: float
    samples: int
    measure: Array
    feed: Array
    shown: Array

    @property
    def past(self) -> int:
        """Torques the arm remembers: those on their way."""
        return self.model.delay.memory + 1


def example_arm(bench: Bench) -> ExampleArm:
    """Return such an arm for a scene that is controlled."""
    problem, model = bench.problem, bench.modes
    sensors = present_sensors(problem)
    return ExampleArm(
        model=model,
        reference=problem.reference,
        samples=round(_DURATION / problem.sample_time),
        measure=model.measure[sensors],
        feed=model.feed[sensors],
        shown=model.target_sensors[sensors],
    )
