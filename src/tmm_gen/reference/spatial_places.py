"""Where the bodies of an arm in space are and how they move, in world axes.

Every vector is in the axes of the base. What turns a body are all joints on the way to it, so that sums over a way are
products with one matrix of ones: ``w = A (z v)``, and a point moves by what each of these joints turns it about itself,

    x' = sum_j z_j v_j x (x - p_j),    x'' = sum_j (z_j v_j)' x (x - p_j) + z_j v_j x (x' - p_j').

The arrays may be complex, so that derivatives can be had by complex steps.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.scene.spatial.arm import Frame, SpatialArm

Array = NDArray[np.float64]
Values = NDArray[Any]
"""Real, or complex where a derivative is taken."""

_NEXT, _LAST = [1, 2, 0], [2, 0, 1]


def cross(a: Values, b: Values) -> Values:
    """Return the vector products of arrays ``(..., 3)``."""
    product: Values = a[..., _NEXT] * b[..., _LAST] - a[..., _LAST] * b[..., _NEXT]
    return product


def applied(matrices: Values, vectors: Values) -> Values:
    """Return matrices ``(..., 3, 3)`` times vectors ``(..., 3)``."""
    product: Values = (matrices @ vectors[..., None])[..., 0]
    return product


@dataclass(frozen=True, eq=False)
class Places:
    """Where the joints are.

    Parameters
    ----------
    turn : array, (..., n, 3, 3)
        Columns are the axes of each body in those of the world.
    point : array, (..., n, 3)
        Points of the joints, m.
    axis : array, (..., n, 3)
        What each joint turns about.
    """

    turn: Values
    point: Values
    axis: Values

    def frame(self, frame: Frame) -> tuple[Values, Values]:
        """Return a frame's axes as columns, (..., 3, 3), and its point, (..., 3), m."""
        at, turn = np.array(frame.at), np.array(frame.turn)
        if not frame.joint:
            batch = self.point.shape[:-2]
            return np.broadcast_to(turn, (*batch, 3, 3)), np.broadcast_to(at, (*batch, 3))
        body = self.turn[..., frame.joint - 1, :, :]
        return body @ turn, self.point[..., frame.joint - 1, :] + body @ at


@dataclass(frozen=True, eq=False)
class Motions:
    """How the bodies move.

    Parameters
    ----------
    spin, spinning : array, (..., n, 3)
        Angular velocities and accelerations of the bodies, rad/s and rad/s^2.
    speed, pull : array, (..., n, 3)
        Velocities and accelerations of the joints' points, m/s and m/s^2.
    """

    spin: Values
    spinning: Values
    speed: Values
    pull: Values

    def carried(self, arm: Values) -> tuple[Values, Values]:
        """Return velocity and acceleration of points fixed to the bodies, ``arm`` from their joints, (..., n, 3)."""
        turned = cross(self.spin, arm)
        return self.speed + turned, self.pull + cross(self.spinning, arm) + cross(self.spin, turned)


@dataclass(frozen=True, eq=False)
class Tree:
    """The joints of an arm as arrays.

    Parameters
    ----------
    arm : SpatialArm
    """

    arm: SpatialArm

    @cached_property
    def ways(self) -> Array:
        """One where joint j is on the way from the base to body b, its own included, (n, n), by b and j."""
        n = len(self.arm.joints)
        ways = np.eye(n)
        for number, joint in enumerate(self.arm.joints):
            if joint.host:
                ways[number] += ways[joint.host - 1]
        return ways

    @cached_property
    def _turns(self) -> tuple[Array, Array, Array]:
        """A joint's turn as ``still + cos(q) even + sin(q) odd``, (n, 3, 3) each."""
        axes = np.eye(3)[[joint.axis for joint in self.arm.joints]]
        constant = np.array([joint.turn for joint in self.arm.joints])
        still = constant @ (axes[:, :, None] * axes[:, None, :])
        odd = constant @ cross(axes[:, None, :], np.eye(3)[None]).transpose(0, 2, 1)
        return still, constant - still, odd

    @cached_property
    def _axes(self) -> NDArray[np.intp]:
        return np.array([joint.axis for joint in self.arm.joints])

    @cached_property
    def _at(self) -> Array:
        return np.array([joint.at for joint in self.arm.joints])

    def places(self, q: Values) -> Places:
        """Return where the joints are at angles ``(..., n)``, rad."""
        still, even, odd = self._turns
        own = still + np.cos(q)[..., None, None] * even + np.sin(q)[..., None, None] * odd
        turn, point = np.empty_like(own), np.empty_like(own[..., 0])
        for number, joint in enumerate(self.arm.joints):
            at = self._at[number]
            if joint.host:
                host = joint.host - 1
                turn[..., number, :, :] = turn[..., host, :, :] @ own[..., number, :, :]
                point[..., number, :] = point[..., host, :] + turn[..., host, :, :] @ at
            else:
                turn[..., number, :, :], point[..., number, :] = own[..., number, :, :], at
        axis = turn[..., np.arange(len(self._axes)), :, self._axes]
        return Places(turn, point, np.moveaxis(axis, 0, -2))

    def motions(self, places: Places, v: Values, a: Values) -> Motions:
        """Return how the bodies move at rates and accelerations ``(..., n)``, rad/s and rad/s^2."""
        ways, p = self.ways, places.point
        turning = places.axis * v[..., None]
        spin = ways @ turning
        change = places.axis * a[..., None] + cross(spin, turning)
        spinning = ways @ change
        speed = cross(spin, p) - ways @ cross(turning, p)
        pull = (
            cross(spinning, p) - ways @ cross(change, p) + cross(spin, speed) - ways @ cross(turning, speed)
        )
        return Motions(spin, spinning, speed, pull)
