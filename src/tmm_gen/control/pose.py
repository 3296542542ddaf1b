"""The arm in motion as a rigid one would move: its shape and the torques of its motors, by one step of the kernel."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.step_model import StepModel

Array = NDArray[np.float64]

TURNS = 12
"""Steps of Newton's method."""
TOLERANCE = 1e-9
"""Change of angles (rad) and torques (N m) below which it is there."""


@dataclass(frozen=True, eq=False)
class Pose:
    """A state that is wanted, and the torques that go with it.

    Parameters
    ----------
    state : array, (s,)
        Of the kernel.
    torque : array, (m,)
        N m.
    """

    state: Array
    torque: Array


def pose_in(model: StepModel, motion: Array, near: Pose) -> Pose | None:
    """Return the pose whose hubs have a motion, and whose links gain the rates that they would if nothing bent.

    Newton's method on the tangents of the kernel's step, as the emitted C has it: all links turn as the hubs' rates
    have it, and after a step with the torques they have gained what the hubs' accelerations make; how beams sag, and
    which torques that takes, are the unknowns.

    Parameters
    ----------
    motion : array, (3, m)
        Angles, rates and accelerations of the hubs.
    near : Pose
        Where to begin; its hubs are turned to where they are to be.

    Returns
    -------
    Pose or None
        None where there is none.
    """
    motors = model.motors
    size, count = len(motors.lengths), motors.count
    places = {name: model.places(name) for name in ("angle", "rate")}
    step = model.problem.step
    rate, growth = (motors.turned @ each for each in motion[1:])
    angles = near.state[places["angle"]]
    angles = angles + motors.turned @ (motion[0] - motors.hub @ angles)
    state, torque = np.zeros(model.size), near.torque
    state[places["rate"]] = rate
    if model.accelerations:
        state[model.places("acceleration")] = growth
    slope = np.zeros((size + count, size + count))
    slope[size:, :size] = motors.hub
    for _ in range(TURNS):
        state[places["angle"]] = angles
        after, by_state, by_torque = model.step_slopes(state, torque)
        slope[:size, :size] = by_state[np.ix_(places["rate"], places["angle"])]
        slope[:size, size:] = by_torque[places["rate"]]
        left = np.concatenate([rate + step * growth - after[places["rate"]], motion[0] - motors.hub @ angles])
        try:
            change = np.linalg.solve(slope, left)
        except np.linalg.LinAlgError:
            return None
        angles, torque = angles + change[:size], torque + change[size:]
        if not np.all(np.isfinite(change)):
            return None
        if np.max(np.abs(change)) < TOLERANCE:
            state[places["angle"]] = angles
            return Pose(state, torque)
    return None
