"""Places of frames in other frames: an offset, and a turn about x, then y, then z of axes that stay, as in URDF."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.scene.exact import exact, nearest

Floats = NDArray[np.float64]
Vector = tuple[float, float, float]


def turned_by(rpy: Vector) -> Floats:
    """Return the rotation of roll, pitch and yaw.

    Parameters
    ----------
    rpy : tuple of float, length 3
        Angles about x, y, z, rad.

    Returns
    -------
    array, shape (3, 3)
        Its columns are the turned axes.
    """
    (cx, cy, cz), (sx, sy, sz) = (tuple(f(angle) for angle in rpy) for f in (math.cos, math.sin))
    return np.array(
        [
            [cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx],
            [sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx],
            [-sy, cy * sx, cy * cx],
        ]
    )


def angles_of(turn: Floats) -> Vector:
    """Return roll, pitch and yaw of a rotation; accurate for any, also where x points along z.

    Parameters
    ----------
    turn : array, shape (3, 3)
        A rotation.

    Returns
    -------
    tuple of float
        rad.
    """
    yaw = math.atan2(turn[1, 0], turn[0, 0])
    c, s = math.cos(yaw), math.sin(yaw)
    pitch = math.atan2(-turn[2, 0], c * turn[0, 0] + s * turn[1, 0])
    # what is left once the yaw is taken off: where yaw is arbitrary, roll makes up for it
    roll = math.atan2(s * turn[0, 2] - c * turn[1, 2], c * turn[1, 1] - s * turn[0, 1])
    return roll, pitch, yaw


@dataclass(frozen=True, eq=False)
class Place:
    """A frame in another frame.

    Parameters
    ----------
    at : array, shape (3,)
        Its origin, m.
    turn : array, shape (3, 3)
        Its axes, by columns.
    rpy : tuple of float or None
        The angles the turn was written by; None where it was worked out.
    """

    at: Floats
    turn: Floats
    rpy: Vector | None = None

    @classmethod
    def of(cls, xyz: Vector = (0.0, 0.0, 0.0), rpy: Vector = (0.0, 0.0, 0.0)) -> Place:
        """Return a place as an origin in URDF writes it."""
        return cls(np.array(xyz), turned_by(rpy), rpy)

    def __matmul__(self, inner: Place) -> Place:
        """Return where a place in this frame lies in the outer one; what moves nothing leaves numbers as written."""
        if np.array_equal(self.turn, np.eye(3)):
            return Place(_sum(self.at, inner.at), inner.turn, inner.rpy)
        if np.array_equal(inner.turn, np.eye(3)):
            return Place(self.at + self.turn @ inner.at, self.turn, self.rpy)
        return Place(self.at + self.turn @ inner.at, self.turn @ inner.turn)

    def angles(self) -> Vector:
        """Return roll, pitch and yaw, as written where they were, rad."""
        return angles_of(self.turn) if self.rpy is None else self.rpy


def _sum(a: Floats, b: Floats) -> Floats:
    """Return the sum of what was written as decimals: 0.1 and 0.2 make 0.3."""
    return np.array([nearest(exact(x) + exact(y)) for x, y in zip(a, b, strict=True)])


def about(axis: Floats, angle: float) -> Floats:
    """Return the rotation by an angle, rad, about a unit vector; shape (3, 3)."""
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    rotation: Floats = np.eye(3) + math.sin(angle) * cross + (1.0 - math.cos(angle)) * cross @ cross
    return rotation


def matrix_of(inertia: tuple[float, float, float, float, float, float]) -> Floats:
    """Return an inertia matrix, shape (3, 3), of xx, yy, zz, xy, xz, yz."""
    xx, yy, zz, xy, xz, yz = inertia
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def moved(mass: float, inertia: Floats, offset: Floats) -> Floats:
    """Return an inertia matrix about a point `offset` away from the centre of mass, kg m^2; shape (3, 3)."""
    steiner: Floats = mass * (offset @ offset * np.eye(3) - np.outer(offset, offset))
    return inertia + steiner
