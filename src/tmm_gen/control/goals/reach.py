"""The rest of an arm that brings a part of it somewhere."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.arms import arm_of
from tmm_gen.control.arm.motors import motors_of
from tmm_gen.control.arm.part_frame import Frame, part_frame
from tmm_gen.control.arm.plane_frame import PlaneFrame
from tmm_gen.control.arm.space_frame import SpaceFrame
from tmm_gen.control.goals.target import Target, rest_with
from tmm_gen.control.task.terms import Goal
from tmm_gen.control.task.where import where
from tmm_gen.errors import UserError
from tmm_gen.scene import Scene
from tmm_gen.scene.spatial.reach import way_to

Array = NDArray[np.float64]

_ITERATIONS = 60
_LARGEST = 0.3
"""Largest change of an angle in an iteration, rad: farther the arm is no longer what it was linearised to be."""
_REACHED = 1e-10
"""m, and rad of its orientation."""


@dataclass(frozen=True, eq=False)
class Somewhere:
    """Where a part's outer end is to be.

    Parameters
    ----------
    name : str
        Of the part.
    position : array, (2,), in space (3,)
        m.
    orientation : array, (1,), in space (4,), or None
        An angle, rad, or a quaternion (w, x, y, z); None where it may stand as it likes.
    """

    name: str
    position: Array
    orientation: Array | None = None

    def off(self, frame: Frame, angles: Array) -> Array:
        """Return what the end is off, m, and then rad."""
        off = self.position - frame.place(angles)
        if self.orientation is None:
            return np.asarray(off, float)
        return np.concatenate([off, frame.turn_to(angles, self.orientation)])

    def slopes(self, frame: Frame, angles: Array) -> Array:
        """Return how the end moves, and turns, as each angle grows."""
        moves = frame.slopes(angles)
        return moves if self.orientation is None else np.concatenate([moves, frame.turns(angles)])

    def told(self, off: Array) -> str:
        """Write how far the end is off."""
        moved, turned = np.split(off, [len(self.position)])
        said = f"{np.linalg.norm(moved):.3g} m"
        return said if self.orientation is None else f"{said} and {np.linalg.norm(turned):.3g} rad"


def rest_with_frame(scene: Scene, there: Somewhere, starts: list[Array], key: str) -> Target:
    """Return where the arm rests with a part's outer end somewhere, sagging as it does.

    Newton's method as in :func:`~tmm_gen.control.goals.target.rest_with`; where motors are more than what is asked for
    the joints move as little as they can.

    Parameters
    ----------
    scene : Scene
        Of an arm whose motors are parts by name.
    there : Somewhere
        What is asked for.
    starts : list of array, (m,)
        Joint angles to begin from, rad; the first that leads there decides which way the arm bends.
    key : str
        Where the scene has it, for an error.

    Raises
    ------
    UserError
        If it is out of reach.
    """
    frame, nearest = part_frame(scene, there.name), np.array([np.inf])
    for start in starts:
        found, off = _searched(scene, frame, there, start, key)
        if found is not None:
            return found
        nearest = min(nearest, off, key=lambda each: float(np.linalg.norm(each)))
    told = ", ".join(f"{each:g}" for each in there.position)
    raise UserError(
        f"{where(scene, key)}: '{there.name}' cannot rest at [{told}] m"
        f"{'' if there.orientation is None else ' like that'}: it came no nearer than {there.told(nearest)}. "
        f"{_advice(scene, frame, there)}"
    )


def _advice(scene: Scene, frame: Frame, there: Somewhere) -> str:
    """Return where positions within reach are."""
    count, asked = motors_of(scene).count, len(there.position) + (1 if isinstance(frame, PlaneFrame) else 3)
    if there.orientation is not None and count < asked:
        return f"Position and orientation are {asked} numbers, for {count} motors: leave out `orientation`."
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
    scene: Scene, frame: Frame, there: Somewhere, start: Array, key: str
) -> tuple[Target | None, Array]:
    """Return the rest that is found from some joint angles, if any, and what the search came nearest to."""
    motors, arm = motors_of(scene), arm_of(scene)
    size, count = len(motors.lengths), motors.count
    begun = rest_with(scene, start, key)
    angles, torque = begun.angles, begun.goal.torque
    nearest = off = there.off(frame, angles)
    slope = np.zeros((size + len(off), size + count))
    slope[:size, size:] = -motors.drive
    for _ in range(_ITERATIONS):
        held, off = arm.held(angles, motors.torques(torque)), there.off(frame, angles)
        slope[:size, :size], slope[size:, :size] = held.matrices.stiffness, there.slopes(frame, angles)
        change = np.linalg.lstsq(slope, np.concatenate([held.unbalanced, off]), rcond=None)[0]
        largest, distance = float(np.max(np.abs(change[:size]))), float(np.linalg.norm(off))
        nearest = min(nearest, off, key=lambda each: float(np.linalg.norm(each)))
        if distance < _REACHED and largest < _REACHED:
            return Target(angles, Goal(motors.tip @ angles, motors.hub @ angles, torque), held.matrices), off
        share = min(1.0, _LARGEST / largest)
        angles, torque = angles + share * change[:size], torque + share * change[size:]
        if not np.all(np.isfinite(angles)):
            break
    return None, nearest
