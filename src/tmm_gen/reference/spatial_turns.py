"""Turns as quaternions, w first."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.reference.spatial_places import Values, cross
from tmm_gen.scene.spatial.arm import Frame, SpatialArm, Turn

Array = NDArray[np.float64]


def product(one: Values, other: Values) -> Values:
    """Return the product of quaternions, (..., 4), w first."""
    w, v, x, u = one[..., :1], one[..., 1:], other[..., :1], other[..., 1:]
    scalar = w * x - np.sum(v * u, axis=-1, keepdims=True)
    found: Values = np.concatenate([scalar, w * u + x * v + cross(v, u)], axis=-1)
    return found


def conjugate(turn: Values) -> Values:
    """Return quaternions that turn back, (..., 4)."""
    back: Values = turn * np.array([1.0, -1.0, -1.0, -1.0])
    return back


def turned(r: Values) -> Values:
    """Return the axes by columns, (..., 3, 3), that quaternions of length one turn to."""
    none = np.zeros_like(r[..., :1])
    back = conjugate(r)
    columns = [
        product(product(r, np.concatenate([none, np.broadcast_to(axis, (*r.shape[:-1], 3))], axis=-1)), back)[
            ..., 1:
        ]
        for axis in np.eye(3)
    ]
    return np.stack(columns, axis=-1)


def quaternion(turn: Turn) -> Array:
    """Return the quaternion of a turn, (4,), w first and not negative."""
    from scipy.spatial.transform import Rotation  # slow to import

    x, y, z, w = Rotation.from_matrix(np.array(turn)).as_quat(canonical=True)
    return np.array([w, x, y, z])


def quaternions(axes: Array) -> Array:
    """Return the rotations with given columns, (k, 3, 3), as quaternions w, x, y, z with w not negative, (k, 4)."""
    from scipy.spatial.transform import Rotation  # slow to import

    last = Rotation.from_matrix(axes).as_quat(canonical=False)
    found: Array = last[:, [3, 0, 1, 2]]
    return np.where(found[:, :1] < 0.0, -found, found)


def followed(arm: SpatialArm, frame: Frame, q: Array, base: Array | None = None) -> Array:
    """Return the quaternion, (k, 4), that half of each joint's angle makes on the way to a frame: it never jumps.

    Parameters
    ----------
    base : array, (k, 4), optional
        Quaternion of the base, where that turns.
    """
    way = []
    number = frame.joint
    while number:
        way.append(number)
        number = arm.joints[number - 1].host
    found = np.tile([1.0, 0.0, 0.0, 0.0], (len(q), 1)) if base is None else base
    for number in reversed(way):
        joint, half = arm.joints[number - 1], 0.5 * q[:, number - 1]
        turn = np.zeros((len(q), 4))
        turn[:, 0], turn[:, 1 + joint.axis] = np.cos(half), np.sin(half)
        found = product(product(found, quaternions(np.array([joint.turn]))), turn)
    return product(found, quaternions(np.array([frame.turn])))


def alike(found: Array, others: Array) -> Array:
    """Return quaternions, (k, 4), each with the sign that brings it nearer to another one."""
    sign = np.sign(np.sum(found * others, axis=-1, keepdims=True))
    return np.asarray(np.where(sign < 0.0, -found, found))
