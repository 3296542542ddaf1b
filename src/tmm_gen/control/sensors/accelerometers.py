"""Accelerometers at the tips of motors: what they feel of how an arm moves.

Each feels along one direction of the part it is on: in a plane across the last link that its motor carries, in space
the way that the tip goes as the motor turns, at the reference. Like all of them it feels what gravity does to its proof
mass, too.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.motor_rows import Motors
from tmm_gen.control.arm.space_frame import SpaceFrame
from tmm_gen.control.arm.space_motors import SpaceMotors
from tmm_gen.scene import Scene
from tmm_gen.scene.spatial.arm import SpatialArm

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class PlanarAccelerometer:
    """Across a link at its outer end; links hang on each other without branches.

    Parameters
    ----------
    lengths : array, (k,)
        Of the links up to that one, m.
    gravity : float
        Along -y, m/s^2.
    """

    lengths: Array
    gravity: float

    def felt(self, angles: Any, rates: Any, growth: Any) -> Any:
        """Return what it feels, m/s^2, by vectors of CasADi: angles of the links and their derivatives."""
        import casadi as ca

        last = angles[len(self.lengths) - 1]
        found = self.gravity * ca.cos(last)
        for i, length in enumerate(self.lengths.tolist()):
            off = angles[i] - last
            found += length * (growth[i] * ca.cos(off) - rates[i] ** 2 * ca.sin(off))
        return found


@dataclass(frozen=True, eq=False)
class SpaceAccelerometer:
    """On a body of an arm in space.

    Parameters
    ----------
    arm : SpatialArm
        On a clamp.
    joints : tuple of int
        On the way to the body, counted from 0, from the base outward.
    at, across : array, (3,)
        Where it is and what it feels along, in the axes of the body: m, and of length 1.
    """

    arm: SpatialArm
    joints: tuple[int, ...]
    at: Array
    across: Array

    @property
    def lifted(self) -> Array:
        """What rest feels like: an acceleration against gravity, (3,), m/s^2."""
        return -np.array(self.arm.gravity)

    def felt(self, angles: Any, rates: Any, growth: Any) -> Any:
        """Return what it feels, m/s^2, by vectors of CasADi: angles of the joints and their derivatives."""
        import casadi as ca

        turning, growing = ca.SX.zeros(3), ca.SX.zeros(3)
        pushed = ca.SX(self.lifted)
        for number in self.joints:
            joint = self.arm.joints[number]
            pushed = _carried(ca, pushed, turning, growing, ca.SX(np.array(joint.at)))
            facing = _about(ca, joint.axis, angles[number]).T @ ca.SX(np.array(joint.turn)).T
            turning, growing, pushed = (facing @ each for each in (turning, growing, pushed))
            spin = ca.SX(np.eye(3)[joint.axis])
            growing += spin * growth[number] + ca.cross(turning, spin * rates[number])
            turning += spin * rates[number]
        return ca.dot(_carried(ca, pushed, turning, growing, ca.SX(self.at)), ca.SX(self.across))


def _carried(ca: Any, pushed: Any, turning: Any, growing: Any, at: Any) -> Any:
    """Return the acceleration of another point of a body."""
    return pushed + ca.cross(growing, at) + ca.cross(turning, ca.cross(turning, at))


def _about(ca: Any, axis: int, angle: Any) -> Any:
    """Return the turn about a coordinate axis, (3, 3)."""
    found, one, two = ca.SX.eye(3), (axis + 1) % 3, (axis + 2) % 3
    found[one, one] = found[two, two] = ca.cos(angle)
    found[two, one], found[one, two] = ca.sin(angle), -ca.sin(angle)
    return found


def accelerometer_of(scene: Scene, motors: Motors, motor: int) -> PlanarAccelerometer | SpaceAccelerometer:
    """Return that at the tip of a motor, counted from 0."""
    if scene.spatial is None:
        return PlanarAccelerometer(motors.lengths[: motors.each[motor].end], scene.model.gravity or 0.0)
    assert isinstance(motors, SpaceMotors)
    tip = motors.ends[motor]
    assert tip is not None  # rules/control_sensors.py sees to it
    frame = SpaceFrame(scene.spatial, tip.frame)
    return SpaceAccelerometer(scene.spatial, frame.joints, np.array(tip.frame.at), tip.across)
