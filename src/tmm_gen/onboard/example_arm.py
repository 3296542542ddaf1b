"""The arm of an emitted controller's example: the first modes of the scene's."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.bench import Bench
from tmm_gen.control.estimators.kalman import present_sensors
from tmm_gen.control.prediction.linear import LinearModel

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
    reference : array, (m,)
        Tip angles to reach, rad.
    on_hub : bool
        Whether the arm stands on one.
    samples : int
        How long the example lasts.
    measure, feed, shown : array, (p, m), (p,) and (p,)
        What the sensors show by the state and by the torque, and at the target.
    """

    model: LinearModel
    reference: Array
    on_hub: bool
    samples: int
    measure: Array
    feed: Array
    shown: Array

    def column(self, values: Array) -> Array:
        """Return the only column alone of an arm on a hub, else all of them."""
        return values[:, 0] if self.on_hub else values

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
        reference=model.goal.tip,
        on_hub=problem.motors.on_hub,
        samples=round(_DURATION / problem.sample_time),
        measure=model.measure[sensors],
        feed=model.feed[sensors],
        shown=model.target_sensors[sensors],
    )
