"""An arm in space as arrays: what of it does not change with its angles."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.space.elements import bodies, mounts, pushes
from tmm_gen.modal.space.held_base import Turning
from tmm_gen.scene.spatial.arm import SpatialArm
from tmm_gen.scene.spatial.reach import longest_way

Array = NDArray[np.float64]
Indices = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class ArmNumbers:
    """The joints of an arm, base to tips.

    Parameters
    ----------
    arm : SpatialArm
        What they are of; none of its joints moves as an input says.
    turning : Turning or None
        How its base moves, if an input says that; it is held in `arm`.
    """

    arm: SpatialArm
    turning: Turning | None = None

    @property
    def size(self) -> int:
        """Number of joints, n."""
        return len(self.arm.joints)

    @cached_property
    def hosts(self) -> tuple[int, ...]:
        """Index of the joint on whose body each stands; -1 for the base."""
        return tuple(joint.host - 1 for joint in self.arm.joints)

    @cached_property
    def axes(self) -> tuple[int, ...]:
        """Which of its own axes each turns about."""
        return tuple(joint.axis for joint in self.arm.joints)

    @cached_property
    def ways(self) -> NDArray[np.bool_]:
        """Whether a joint is on the way from the base to a body, its own among them, (n, n), by body and joint."""
        found = np.eye(self.size, dtype=bool)
        for number, host in enumerate(self.hosts):
            if host >= 0:
                found[number] |= found[host]
        return found

    @cached_property
    def mounts(self) -> Array:
        """What offset and turn in front of each hinge make of accelerations, (n, 6, 6)."""
        return mounts(self.arm.joints)

    @cached_property
    def pushes(self) -> Array:
        """What each hinge's own acceleration makes of accelerations, (n, 6)."""
        return pushes(self.axes)

    @cached_property
    def rows(self) -> Indices:
        """Which force or moment is that about each joint's axis, (n,)."""
        found: Indices = np.argmax(self.pushes, axis=1)
        return found

    @cached_property
    def bodies(self) -> Array:
        """Force and moment each body takes per acceleration, (n, 6, 6)."""
        return bodies([joint.body for joint in self.arm.joints])

    @property
    def floats(self) -> bool:
        """Whether nothing holds the base, so that it moves along and turns: six coordinates before the joints'."""
        return self.arm.base is not None

    @cached_property
    def base_body(self) -> Array:
        """Force and moment that the base's own body takes per acceleration, (6, 6); zero where it never turns."""
        if self.arm.base:
            own: Array = bodies([self.arm.base.body])[0]
            return own
        return self.turning.body if self.turning else np.zeros((6, 6))

    @cached_property
    def base_facing(self) -> Array:
        """Components in the base's axes by those in the world's, (3, 3)."""
        return np.array(self.arm.base.turn).T if self.arm.base else np.eye(3)

    @cached_property
    def base_place(self) -> Array:
        """Where the base is, (3,), m."""
        return np.array(self.arm.base.at) if self.arm.base else np.zeros(3)

    @cached_property
    def gravity(self) -> Array:
        """What weight is felt of, (3,), m/s^2, in world axes: none by what falls freely."""
        return np.zeros(3) if self.floats else np.array(self.arm.gravity)

    @cached_property
    def stiffness(self) -> Array:
        """Of the joints' springs, (n,), N m/rad."""
        return np.array([joint.stiffness for joint in self.arm.joints])

    @cached_property
    def damping(self) -> Array:
        """Of the joints' dampers, (n,), N m s/rad."""
        return np.array([joint.damping for joint in self.arm.joints])

    @cached_property
    def armature(self) -> Array:
        """Of the joints' rotors, (n,), kg m^2."""
        return np.array([joint.armature for joint in self.arm.joints])

    @cached_property
    def rest(self) -> Array:
        """Angles at which springs are slack, (n,), rad."""
        return np.array([joint.rest for joint in self.arm.joints])

    @cached_property
    def start(self) -> Array:
        """Angles at the scene's start, (n,), rad."""
        return np.array([joint.angle for joint in self.arm.joints])

    @cached_property
    def free(self) -> Indices:
        """Indices of the joints without a spring."""
        return np.flatnonzero(self.stiffness == 0.0)

    @property
    def reach(self) -> float:
        """The longest way along the arm, m; 1 where it has no length."""
        return longest_way(self.arm) or 1.0

    @cached_property
    def weighing(self) -> Array:
        """The most that weight can do about each joint, all levers stretched out, (n,), N m."""
        masses = np.array([joint.body.mass for joint in self.arm.joints])
        levers = np.array([math.hypot(*joint.body.center) for joint in self.arm.joints])
        return self.stretched(float(np.linalg.norm(self.gravity)) * masses, levers)

    def stretched(self, forces: Array, levers: Array) -> Array:
        """Return the most that forces on bodies can do about each joint, (n,), N m.

        Parameters
        ----------
        forces : array, (n,)
            On each body, N.
        levers : array, (n,)
            About the body's own joint, m.
        """
        found, total = forces * levers, np.array(forces, float)
        for number in reversed(range(self.size)):
            host = self.hosts[number]
            if host >= 0:
                total[host] += total[number]
                found[host] += found[number] + total[number] * math.hypot(*self.arm.joints[number].at)
        return found
