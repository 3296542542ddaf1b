"""What holds an arm up while its controller's own law cannot be computed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.motors import motors_of
from tmm_gen.modal.rest import rest_at
from tmm_gen.scene import Scene

Array = NDArray[np.float64]


def holding(scene: Scene) -> Array:
    """Return the torques of the motors, row by row, that hold up what each of them carries, laid level, (m, m), N m.

    Nothing bends, and each carries the links up to the next motor. Zero where nothing falls, and for an arm on a hub.

    Parameters
    ----------
    scene : Scene
        With ``[control]``.
    """
    motors = motors_of(scene)
    found = np.zeros((motors.count, motors.count))
    if motors.on_hub or not scene.model.gravity:
        return found
    level = np.zeros(len(motors.lengths))
    weights = rest_at(scene, level, gravity=0.0).unbalanced - rest_at(scene, level).unbalanced
    carried = np.array([weights[motor.place : motor.end].sum() for motor in motors.each])
    return np.asarray(np.triu(found + carried) / motors.gears[:, None], float)


@dataclass(frozen=True, eq=False)
class LevelHolding:
    """What holds up an arm in a plane.

    Parameters
    ----------
    rows : array, (m, m)
        Of :func:`holding`.
    """

    rows: Array

    def weight(self, hub: Array) -> Array:
        """Return the torques that hold up an arm that does not bend, with its hubs there, rad, (m,), N m."""
        return np.asarray(self.rows @ np.cos(np.cumsum(hub)), float)
