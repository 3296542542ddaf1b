"""An arm in space whose base is prescribed, where the base is held at one angle: an arm on a clamp."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.space.elements import bodies, hinges, mounts
from tmm_gen.scene.spatial.arm import ArmInput, ArmOutput, Frame, Revolute, SpatialArm, Turn, Vector

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Turning:
    """How a prescribed base moves by its angle.

    Parameters
    ----------
    joint : Revolute
        What turns as an input says, on ground that stands still.
    angle : float
        At which it is held, rad.
    """

    joint: Revolute
    angle: float

    @property
    def column(self) -> str:
        """Of the input that is its angle."""
        return self.joint.given

    @cached_property
    def coordinates(self) -> Array:
        """How the base moves and turns by a unit of its angle, in its own axes and the world's alike, (6,).

        What it takes about its axis is the product with the force and moment that it takes.
        """
        axis = np.array(self.joint.turn)[:, self.joint.axis]
        return np.concatenate([np.cross(self.joint.at, axis), axis])

    @cached_property
    def body(self) -> Array:
        """Force and moment about the world's origin that the base's own body takes per acceleration, (6, 6)."""
        through = hinges([self.joint.axis], np.array([self.angle]))[0][0] @ mounts([self.joint])[0]
        found: Array = through.T @ bodies([self.joint.body])[0] @ through
        return found


def held_base(arm: SpatialArm, angle: float) -> tuple[SpatialArm, Turning | None]:
    """Return an arm whose base is held at an angle, and how it would move; the arm itself where nothing is prescribed.

    Outputs of the base's angle are those of joint 0; world axes stay what they are.

    Parameters
    ----------
    arm : SpatialArm
        At most one of its joints moves as an input says, and stands on the base.
    angle : float
        Of the base, rad.
    """
    given = next((number for number, joint in enumerate(arm.joints, start=1) if joint.given), 0)
    if not given:
        return arm, None
    base = arm.joints[given - 1]
    turn = np.array(base.turn) @ _about(base.axis, angle)

    def number(old: int) -> int:
        return 0 if old == given else old - (old > given)

    def placed(at: Vector, own: Turn) -> tuple[Vector, Turn]:
        place = np.array(base.at) + turn @ np.array(at)
        return _vector(place), _turn(turn @ np.array(own))

    def joint(old: Revolute) -> Revolute:
        at, own = placed(old.at, old.turn) if old.host == given else (old.at, old.turn)
        return replace(old, host=number(old.host), at=at, turn=own)

    def frame(old: Frame) -> Frame:
        at, own = placed(old.at, old.turn) if old.joint == given else (old.at, old.turn)
        return replace(old, joint=number(old.joint), at=at, turn=own)

    def signal(item: ArmInput) -> ArmInput:
        return replace(item, joint=number(item.joint), frame=item.frame and frame(item.frame))

    def read(item: ArmOutput) -> ArmOutput:
        own = item.frame and frame(item.frame)
        return replace(item, joint=number(item.joint), gear=number(item.gear), frame=own)

    held = replace(
        arm,
        joints=tuple(joint(old) for k, old in enumerate(arm.joints, start=1) if k != given),
        frames=tuple(frame(old) for old in arm.frames),
        inputs=tuple(signal(item) for item in arm.inputs),
        outputs=tuple(read(item) for item in arm.outputs),
    )
    return held, Turning(base, angle)


def _about(axis: int, angle: float) -> Array:
    """Return the turn about a frame axis, (3, 3)."""
    c, s = math.cos(angle), math.sin(angle)
    found = np.eye(3)
    first, second = (axis + 1) % 3, (axis + 2) % 3
    found[first, first] = found[second, second] = c
    found[second, first], found[first, second] = s, -s
    return found


def _vector(values: Array) -> Vector:
    x, y, z = values.tolist()
    return (x, y, z)


def _turn(values: Array) -> Turn:
    one, two, three = values
    return (_vector(one), _vector(two), _vector(three))
