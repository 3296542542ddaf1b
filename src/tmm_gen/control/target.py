"""Where the arm rests with its tip at the reference, and the torque that holds it there."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.problem import ControlProblem
from tmm_gen.errors import UserError
from tmm_gen.modal.arm import linear_arm
from tmm_gen.modal.matrices import Matrices, matrices
from tmm_gen.modal.rest import rest_at
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

_ITERATIONS = 50
_TOLERANCE = 1e-12


@dataclass(frozen=True, eq=False)
class Target:
    """The arm at rest with its tip at the reference.

    Parameters
    ----------
    angles : array, (n + 1,)
        Of hub and links, rad.
    torque : float
        Of the hub, N m.
    matrices : Matrices
        Of small motion about it.
    """

    angles: Array
    torque: float
    matrices: Matrices


def find_target(scene: Scene, problem: ControlProblem) -> Target:
    """Return where the arm rests with its tip at the reference.

    Newton's method on the torques out of balance, whose slope is the stiffness matrix of small motion.

    Parameters
    ----------
    scene : Scene
        Of kind "planar" on a motor.
    problem : ControlProblem
        Gives reference and bounds of the torque.

    Raises
    ------
    UserError
        If there is no such position, or the motor cannot hold it.
    """
    lengths = np.array([0.0, *(link.length for link in scene.links)])
    tip = lengths / lengths.sum()
    count = len(tip)
    angles, torque = np.full(count, problem.reference), 0.0
    slope = np.zeros((count + 1, count + 1))
    for _ in range(_ITERATIONS):
        rest = rest_at(scene, angles, inputs={problem.input_name: torque})
        linear = matrices(linear_arm(scene, rest))
        slope[:count, :count] = linear.stiffness
        slope[0, count], slope[count, :count] = -1.0, tip
        left = np.concatenate([rest.unbalanced, [problem.reference - tip @ angles]])
        try:
            change = np.linalg.solve(slope, left)
        except np.linalg.LinAlgError:
            break
        angles, torque = angles + change[:count], torque + float(change[count])
        if not np.all(np.isfinite(angles)):
            break
        if np.max(np.abs(change)) < _TOLERANCE * max(1.0, abs(torque)):
            return Target(angles, _within(scene, problem, torque), linear)
    raise UserError(
        f"{scene.source.origin}: the arm finds no rest with its tip at {problem.reference:g} rad. "
        "Check gravity, stiffness and control.reference."
    )


def _within(scene: Scene, problem: ControlProblem, torque: float) -> float:
    """Return a torque the motor can give."""
    low, high = problem.torque
    if low <= torque <= high:
        return torque
    raise UserError(
        f"{scene.source.origin}: holding the tip at {problem.reference:g} rad needs {torque:.4g} N m, beyond the "
        f"bounds [{low:g}, {high:g}]. Widen control.bounds.torque, or set another reference."
    )
