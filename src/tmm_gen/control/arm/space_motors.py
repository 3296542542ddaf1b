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

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.encoders import behind_gears
from tmm_gen.control.arm.motor_rows import Motor, Motors
from tmm_gen.modal.space.numbers import ArmNumbers
from tmm_gen.modal.space.still import Still
from tmm_gen.scene.each import by_names
from tmm_gen.scene.scene import Scene
from tmm_gen.scene.spatial.arm import Frame
from tmm_gen.scene.spatial.motor_ends import MotorEnds

Array = NDArray[np.float64]


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
        found = np.zeros((len(self.lengths), self.count))
        found[[motor.place for motor in self.each], range(self.count)] = 1.0
        return found

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
    each = tuple(_motor(scene, k, acting[k]) for k in sorted(acting))
    places = [motor.place for motor in each]
    if reference is None and scene.control is not None:
        reference = np.array(by_names(scene.control.reference, tuple(motor.name for motor in each)))
    posture = np.array([joint.rest if joint.stiffness else 0.0 for joint in arm.joints])
    posture[places] = 0.0 if reference is None else reference
    numbers, carried = ArmNumbers(arm), motor_ends(scene, {place + 1: posture[place] for place in places})
    still, rows = Still(numbers, posture, {}), np.zeros((len(each), numbers.size))
    ends: list[Tip | None] = []
    for row, place in zip(rows, places, strict=True):
        row[place] = 1.0
        tip = carried.tip(place + 1)
        ends.append(None)
        if tip is None:
            continue
        moved = still.moved(tip)[0][:, 6:]
        own = moved[:, place]
        given_way = (own @ moved) / (own @ own)
        given_way[[*places, *range(place)]] = 0.0
        row += given_way
        ends[-1] = Tip(tip, still.facing[tip.joint - 1] @ own / np.linalg.norm(own))
    lengths = np.array([math.hypot(*joint.at) for joint in arm.joints])
    return SpaceMotors(each, lengths, on_hub=False, rows=rows, ends=tuple(ends))


def _motor(scene: Scene, number: int, input_name: str) -> Motor:
    """Return the motor that turns a joint, counted from 1."""
    arm = scene.spatial
    assert arm is not None
    joint = arm.joints[number - 1]
    hub: tuple[int, ...] = (number - 1,)
    if joint.name in behind_gears(scene):
        # the gear's spring is a joint of its own, at the motor's outer end
        hub += (next(frame.joint for frame in arm.frames if frame.name == joint.name) - 1,)
    return Motor(joint.name, input_name, place=number - 1, host=-1, end=number, gear=joint.gear, hub=hub)


def motor_ends(scene: Scene, reference: Mapping[int, float]) -> MotorEnds:
    """Return what motors carry.

    Parameters
    ----------
    reference : mapping from int to float
        Angles of their joints, by numbers from 1, rad.
    """
    arm = scene.spatial
    assert arm is not None
    entries = scene.source.data.get("beam", [])
    assert isinstance(entries, list)
    return MotorEnds(arm, tuple(str(entry["name"]) for entry in entries), reference)


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
