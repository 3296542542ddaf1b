"""What is wanted of an arm in motion: its end where it would be at rest, and the torques that takes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.prediction.step_model import StepModel

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
    """Return what is wanted where hubs have a motion: beams that sag as at rest, and the torques of the motion.

    The arm's end is then wanted where it would be if everything moved slowly, and the hubs may leave their reference to
    make up for beams that bend as the arm accelerates. If beams were wanted bent as they are when the hubs keep to
    their reference, the end would have to swing with them and to stop at once when the hubs do, which it cannot.

    Newton's method on the tangents of the kernel's step, as in the emitted C: first for angles and torques at which the
    arm gains no rates in a step; then one iteration for the torques that give the links the accelerations of a rigid
    arm.

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
    angles = near.state[model.places("angle")]
    angles = angles + motors.turned @ (motion[0] - motors.hub @ angles)
    none = np.zeros(len(motors.lengths))
    rate, growth = (motors.turned @ each for each in motion[1:])
    state, torque = _state(model, angles, none, none), near.torque
    for _ in range(TURNS):
        change = _towards(model, state, torque, motion[0], none)
        if change is None:
            return None
        state[model.places("angle")] += change[: len(none)]
        torque = torque + change[len(none) :]
        if np.max(np.abs(change)) < TOLERANCE:
            break
    else:
        return None
    moving = _state(model, state[model.places("angle")], rate, growth)
    change = _towards(model, moving, torque, motion[0], growth)
    return None if change is None else Pose(moving, torque + change[len(none) :])


def _state(model: StepModel, angles: Array, rates: Array, accelerations: Array) -> Array:
    """Return a state of the kernel, (s,)."""
    state = np.zeros(model.size)
    state[model.places("angle")], state[model.places("rate")] = angles, rates
    if model.accelerations:
        state[model.places("acceleration")] = accelerations
    return state


def _towards(model: StepModel, state: Array, torque: Array, hub: Array, growth: Array) -> Array | None:
    """Return the changes of angles and torques after which rates grow as told, (d + m,); None where there are none."""
    motors, angle, rate = model.motors, model.places("angle"), model.places("rate")
    size, count = len(motors.lengths), motors.count
    after, by_state, by_torque = model.step_slopes(state, torque)
    slope = np.zeros((size + count, size + count))
    slope[:size, :size], slope[:size, size:] = by_state[np.ix_(rate, angle)], by_torque[rate]
    slope[size:, :size] = motors.hub
    gained = state[rate] + model.problem.step * growth - after[rate]
    try:
        change = np.linalg.solve(slope, np.concatenate([gained, hub - motors.hub @ state[angle]]))
    except np.linalg.LinAlgError:
        return None
    return change if np.all(np.isfinite(change)) else None
