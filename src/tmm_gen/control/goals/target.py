"""Where the arm rests with its tip, or its hubs, at the reference, and the torques that hold it there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.arm import SmallMotions
from tmm_gen.control.arm.arms import arm_of
from tmm_gen.control.arm.motors import motors_of
from tmm_gen.control.task.problem import ControlProblem
from tmm_gen.control.task.terms import Goal
from tmm_gen.control.task.where import where
from tmm_gen.errors import UserError
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

_ITERATIONS = 50
_TOLERANCE = 1e-12


@dataclass(frozen=True, eq=False)
class Target:
    """The arm at rest.

    Parameters
    ----------
    angles : array, (d,)
        Of a hub and the links, rad.
    goal : Goal
        Angles of tips and hubs, torques.
    matrices : SmallMotions
        Of small motion about it.
    """

    angles: Array
    goal: Goal
    matrices: SmallMotions


@dataclass(frozen=True, eq=False)
class Start:
    """How the arm is at time zero.

    Parameters
    ----------
    angles, rates : array, (d,)
        Of a hub and the links, rad and rad/s.
    torque : array, (m,)
        That act before any is chosen, N m.
    """

    angles: Array
    rates: Array
    torque: Array


def find_target(scene: Scene, problem: ControlProblem) -> Target:
    """Return where the arm rests at the reference.

    Raises
    ------
    UserError
        If there is no such position, or the motors cannot hold it.
    """
    target = rest_with(scene, problem.reference, "control.reference")
    require_within(scene, problem, target, "control.reference")
    return target


def find_start(scene: Scene, problem: ControlProblem) -> Start:
    """Return how the arm starts: on a hub as its scene says, else at rest, held by its motors.

    Raises
    ------
    UserError
        If there is no rest at the joint angles of the scene's start, or the motors cannot hold it.
    """
    motors, initial = motors_of(scene), scene.initial
    if motors.on_hub:
        none = np.zeros(scene.hub)
        angles, rates = (np.concatenate([none, values]) for values in (initial.angles, initial.rates))
        return Start(angles, rates, np.zeros(motors.count))
    target = rest_with(scene, motors.hub @ np.array(initial.angles), "initial.angles")
    require_within(scene, problem, target, "initial.angles")
    return Start(target.angles, np.zeros(len(target.angles)), target.goal.torque)


def rest_with(scene: Scene, reference: Array, key: str) -> Target:
    """Return where the arm rests with the angles that a reference is of, (m,), whatever torques that takes.

    Newton's method on the torques out of balance, whose slope is the stiffness matrix of small motion.

    Parameters
    ----------
    key : str
        Where the scene has these angles, for an error.

    Raises
    ------
    UserError
        If there is no such position.
    """
    motors, arm = motors_of(scene), arm_of(scene)
    size, count = len(motors.lengths), motors.count
    angles, torque = motors.turned @ reference, np.zeros(count)
    slope = np.zeros((size + count, size + count))
    slope[:size, size:], slope[size:, :size] = -motors.drive, motors.prescribed
    for _ in range(_ITERATIONS):
        held = arm.held(angles, motors.torques(torque))
        slope[:size, :size] = held.matrices.stiffness
        left = np.concatenate([held.unbalanced, reference - motors.prescribed @ angles])
        try:
            change = np.linalg.solve(slope, left)
        except np.linalg.LinAlgError:
            break
        angles, torque = angles + change[:size], torque + change[size:]
        if not np.all(np.isfinite(angles)):
            break
        if np.max(np.abs(change)) < _TOLERANCE * max(1.0, float(np.max(np.abs(torque)))):
            # of what is prescribed, the reference itself and no rounding of it
            tip, hub = (
                reference if row is motors.prescribed else row @ angles for row in (motors.tip, motors.hub)
            )
            return Target(angles, Goal(tip, hub, torque), held.matrices)
    raise UserError(
        f"{where(scene, key)}: the arm finds no rest with its {_what(scene)} at {_told(reference)} rad. "
        f"Check gravity, stiffness and {key}."
    )


def require_within(scene: Scene, problem: ControlProblem, target: Target, key: str) -> None:
    """Refuse torques that the motors cannot give.

    Raises
    ------
    UserError
        Naming the motor and ``key``, where the scene has the angles.
    """
    motors = problem.motors
    low, high = problem.torque
    for k, (name, torque) in enumerate(zip(motors.names, target.goal.torque, strict=True)):
        if not low[k] <= torque <= high[k]:
            whose = "" if motors.on_hub else f" of motor '{name}'"
            angles = target.goal.tip if motors.on_hub else target.goal.hub
            raise UserError(
                f"{where(scene, key)}: holding the {_what(scene)} at {_told(angles)} rad needs {torque:.4g} N m"
                f"{whose}, beyond the bounds [{low[k]:g}, {high[k]:g}]. Widen control.bounds.torque, or set another "
                f"{key}."
            )


def _what(scene: Scene) -> str:
    # in the short form the reference is of the tip
    return "tip" if scene.base.kind == "motor" else "joints"


def _told(angles: Sequence[float] | Array) -> str:
    return ", ".join(f"{angle:g}" for angle in angles)
