"""Where points of the bodies of an arm in space are."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.reference.spatial_turns import turned as axes_of
from tmm_gen.scene.spatial.arm import SpatialArm

Array = NDArray[np.float64]


def body_points(arm: SpatialArm, angles: Array, spread: float) -> Array:
    """Return three points of each body in the world, which tell of every turn: its joint's, and two beside it.

    Parameters
    ----------
    angles : array, (k, n)
        Of the joints, rad; (k, 7 + n) where the base floats, whose place and quaternion come first.
    spread : float
        How far along the first two axes of the joint's frame the other two stand, m.

    Returns
    -------
    array, (3, k, 3 n)
        Along x, y and z, m; with three more, the base's own first, where that floats.
    """
    axes: list[Array] = [np.broadcast_to(np.eye(3), (len(angles), 3, 3))]
    places: list[Array] = [np.zeros((len(angles), 3))]
    found: list[Array] = []
    if arm.base is not None:
        axes, places, angles = [axes_of(angles[:, 3:7])], [angles[:, :3]], angles[:, 7:]
        found += [places[0], places[0] + spread * axes[0][:, :, 0], places[0] + spread * axes[0][:, :, 1]]
    for joint, angle in zip(arm.joints, angles.T, strict=True):
        place = places[joint.host] + axes[joint.host] @ np.array(joint.at)
        turned = axes[joint.host] @ np.array(joint.turn) @ _turns(joint.axis, angle)
        axes.append(turned)
        places.append(place)
        found += [place, place + spread * turned[:, :, 0], place + spread * turned[:, :, 1]]
    return np.moveaxis(np.stack(found, axis=1), 2, 0)


def _turns(axis: int, angle: Array) -> Array:
    """Return the matrices, (k, 3, 3), of turns about a frame axis."""
    i, j = (axis + 1) % 3, (axis + 2) % 3
    found = np.zeros((len(angle), 3, 3))
    found[:, axis, axis] = 1.0
    found[:, i, i] = found[:, j, j] = np.cos(angle)
    found[:, j, i] = np.sin(angle)
    found[:, i, j] = -found[:, j, i]
    return found
