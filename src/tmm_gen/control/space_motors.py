"""The motors of an arm in space, and what is weighed of the frames that they carry.

The arm's angles are those of its joints, each against what it stands on, so that a hub's angle is one of them. A
motor's *tip* is the end of the longest way along what it carries. Its angle is that joint angle at which the arm, were
it rigid behind the motor, would have its tip as far round the motor's axis: with ``J_j`` the velocity of the tip as
joint ``j`` turns,

    tip = hub + sum_j (J_hub . J_j) / (J_hub . J_hub) q_j

over the joints behind the motor that no motor turns. That is taken where the arm is at its reference and straight, and
so is linear; where a tip is near the motor's axis, only the hub counts.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.motor_rows import Motor, Motors
from tmm_gen.modal.space.numbers import ArmNumbers
from tmm_gen.modal.space.still import Still
from tmm_gen.scene.each import by_names
from tmm_gen.scene.scene import Scene
from tmm_gen.scene.spatial.arm import Frame, SpatialArm

Array = NDArray[np.float64]

_NEAR = 0.05
"""A tip nearer to its motor's axis than that, relative to the way along the arm, has no angle about it."""


@dataclass(frozen=True, eq=False)
class Tip:
    """A motor's tip that goes round its axis.

    Parameters
    ----------
    frame : Frame
        Where it is.
    across : array, (3,)
        Which way it goes as the motor turns, at the reference, in the axes of the body it is on; of length 1.
    """

    frame: Frame
    across: Array


@dataclass(frozen=True, eq=False)
class SpaceMotors(Motors):
    """The m motors of an arm in space of d joints; `lengths` are what joints are apart along it, m.

    Parameters
    ----------
    rows : array, (m, d)
        That give the tips' angles.
    ends : tuple of Tip or None, length m
        The tips; None where one is near its motor's axis.
    """

    rows: Array
    ends: tuple[Tip | None, ...]

    @cached_property
    def tip(self) -> Array:
        """Rows that give the tips' angles, (m, d)."""
        return self.rows

    @cached_property
    def turned(self) -> Array:
        """What the angles grow by where a hub turns by 1 rad and nothing bends, (d, m)."""
        return self.hub.T

    def inertia(self, mass: Array) -> Array:
        """Return what each motor would turn if nothing bent and no other turned, (m,), by its own torque, kg m^2."""
        places = [motor.place for motor in self.each]
        return np.asarray(np.diag(mass)[places] / self.gears, float)

    def bent(self, angles: Array) -> float:
        """Return the largest angle of a joint that no motor turns, rad."""
        return float(np.max(np.abs(np.delete(angles, [motor.place for motor in self.each])), initial=0.0))


def space_motors(scene: Scene, reference: Array | None = None) -> SpaceMotors:
    """Return the motors of an arm in space, from the base outward.

    Parameters
    ----------
    reference : array, (m,), optional
        Hub angles at which tips are taken, rad; by default that of ``[control]``.
    """
    arm = scene.spatial
    assert arm is not None
    acting = {item.joint: item.name for item in arm.inputs if item.acts == "torque"}
    each = tuple(
        Motor(arm.joints[k - 1].name, acting[k], place=k - 1, host=-1, end=k, gear=arm.joints[k - 1].gear)
        for k in sorted(acting)
    )
    places = [motor.place for motor in each]
    if reference is None and scene.control is not None:
        reference = np.array(by_names(scene.control.reference, tuple(motor.name for motor in each)))
    posture = np.array([joint.rest if joint.stiffness else 0.0 for joint in arm.joints])
    posture[places] = 0.0 if reference is None else reference
    numbers = ArmNumbers(arm)
    still, ways, rows = Still(numbers, posture, {}), _ways(arm), np.zeros((len(each), numbers.size))
    ends: list[Tip | None] = []
    for row, place in zip(rows, places, strict=True):
        row[place] = 1.0
        ends.append(None)
        carried = [frame for frame in arm.frames if frame.joint and numbers.ways[frame.joint - 1, place]]
        # of frames as far away the last is on what is outermost
        tip = max(reversed(carried), key=lambda frame: ways[frame.joint] + _length(frame.at), default=None)
        if tip is None:
            continue
        moved = still.moved(tip)[0][:, 6:]
        own = moved[:, place]
        if np.linalg.norm(own) > _NEAR * numbers.reach:
            given_way = (own @ moved) / (own @ own)
            given_way[[*places, *range(place)]] = 0.0
            row += given_way
            ends[-1] = Tip(tip, still.facing[tip.joint - 1] @ own / np.linalg.norm(own))
    lengths = np.array([_length(joint.at) for joint in arm.joints])
    return SpaceMotors(each, lengths, on_hub=False, rows=rows, ends=tuple(ends))


def outer_bodies(scene: Scene) -> tuple[str, ...]:
    """Return the names of the ``[[body]]`` of an arm in space that hang on joints which carry no others."""
    arm = scene.spatial
    assert arm is not None
    carrying = {joint.host for joint in arm.joints}
    joints = {frame.name: frame.joint for frame in arm.frames}
    entries = scene.source.data.get("body", [])
    assert isinstance(entries, list)
    names = (str(entry["name"]) for entry in entries)
    return tuple(name for name in names if joints[name] and joints[name] not in carrying)


def _ways(arm: SpatialArm) -> list[float]:
    """Return how far it is along the arm to each joint, m; first to the base."""
    found = [0.0]
    for joint in arm.joints:
        found.append(found[joint.host] + _length(joint.at))
    return found


def _length(vector: tuple[float, float, float]) -> float:
    return float(np.linalg.norm(vector))
