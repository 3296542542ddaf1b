"""What holds an arm up while its controller's own law cannot be computed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.motors import motors_of
from tmm_gen.control.terms import Goal
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

    def torque(self, goal: Goal, hub: Array) -> Array:
        """Return the torques that hold an arm whose hubs are elsewhere than at the goal; see :func:`held`."""
        return held(self.rows, goal, hub)


def held(holds: Array, goal: Goal, hub: Array) -> Array:
    """Return the torques that hold an arm whose hubs are elsewhere than at the goal, (m,), N m.

    Those at the goal, where beams sag as they do, and what a rigid arm's differ by.

    Parameters
    ----------
    holds : array, (m, m)
        Of :func:`holding`.
    goal : Goal
        Hubs and torques at the goal.
    hub : array, (m,)
        Where hubs are, rad.
    """
    lifted = np.cos(np.cumsum(hub)) - np.cos(np.cumsum(goal.hub))
    return np.asarray(goal.torque + holds @ lifted, float)
