"""The rest of an arm that brings a part of it somewhere."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arms import arm_of
from tmm_gen.control.motors import motors_of
from tmm_gen.control.part_frame import Frame, part_frame
from tmm_gen.control.space_frame import SpaceFrame
from tmm_gen.control.target import Target, rest_with
from tmm_gen.control.terms import Goal
from tmm_gen.control.where import where
from tmm_gen.errors import UserError
from tmm_gen.scene import Scene
from tmm_gen.scene.spatial.reach import way_to

Array = NDArray[np.float64]

_ITERATIONS = 60
_LARGEST = 0.3
"""Largest change of an angle in an iteration, rad: farther the arm is no longer what it was linearised to be."""
_REACHED = 1e-10
"""m."""


def rest_with_frame(scene: Scene, name: str, position: Array, starts: list[Array], key: str) -> Target:
    """Return where the arm rests with a part's outer end somewhere, sagging as it does.

    Newton's method as in :func:`~tmm_gen.control.target.rest_with`; with more motors than two the joints move as little
    as they can.

    Parameters
    ----------
    scene : Scene
        Of an arm whose motors are parts by name.
    name : str
        Of the part.
    position : array, (2,), in space (3,)
        m.
    starts : list of array, (m,)
        Joint angles to begin from, rad; the first that leads there decides which way the arm bends.
    key : str
        Where the scene has the position, for an error.

    Raises
    ------
    UserError
        If it is out of reach.
    """
    frame, nearest = part_frame(scene, name), np.inf
    for start in starts:
        found, left = _searched(scene, frame, position, start, key)
        if found is not None:
            return found
        nearest = min(nearest, left)
    told = ", ".join(f"{each:g}" for each in position)
    raise UserError(
        f"{where(scene, key)}: '{name}' cannot rest at [{told}] m: it came no nearer than "
        f"{nearest:.3g} m. {_advice(scene, frame)}"
    )


def _advice(scene: Scene, frame: Frame) -> str:
    """Return where positions within reach are."""
    if isinstance(frame, SpaceFrame):
        return (
            f"The way along the arm to it is {way_to(frame.arm, frame.frame):g} m: take a position well within that, "
            "which the joints on the way can bring it to."
        )
    carried = [frame.lengths[motor.place : motor.end].sum() for motor in motors_of(scene).each]
    outer = sum(carried)
    inner = max(0.0, 2.0 * max(carried) - outer)
    return f"Take a position well between {inner:g} and {outer:g} m from the base."


def _searched(
    scene: Scene, frame: Frame, position: Array, start: Array, key: str
) -> tuple[Target | None, float]:
    """Return the rest that is found from some joint angles, if any, and how near to the position the search came."""
    motors, arm = motors_of(scene), arm_of(scene)
    size, count = len(motors.lengths), motors.count
    begun = rest_with(scene, start, key)
    angles, torque = begun.angles, begun.goal.torque
    slope = np.zeros((size + len(position), size + count))
    slope[:size, size:], nearest = -motors.drive, np.inf
    for _ in range(_ITERATIONS):
        held = arm.held(angles, motors.torques(torque))
        off = position - frame.place(angles)
        slope[:size, :size], slope[size:, :size] = held.matrices.stiffness, frame.slopes(angles)
        change = np.linalg.lstsq(slope, np.concatenate([held.unbalanced, off]), rcond=None)[0]
        largest = float(np.max(np.abs(change[:size])))
        distance = float(np.linalg.norm(off))
        nearest = min(nearest, distance)
        if distance < _REACHED and largest < _REACHED:
            return Target(angles, Goal(motors.tip @ angles, motors.hub @ angles, torque), held.matrices), 0.0
        share = min(1.0, _LARGEST / largest)
        angles, torque = angles + share * change[:size], torque + share * change[size:]
        if not np.all(np.isfinite(angles)):
            break
    return None, nearest
