"""Where the points of an arm are by which runs are compared, and how far two such places are apart."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.scene import Scene
from tmm_gen.simulate.places import node_places
from tmm_gen.simulate.points import body_points

Array = NDArray[np.float64]

STILL = 1e-7
"""Motion below this share of the arm's length is none: it may be rounding."""

_SPREAD = 0.1
"""How far from each joint points of a body in space are looked at, as a share of the arm's reach: turns show there."""


def extent(scene: Scene) -> float:
    """Return how far an arm reaches, m; 1 where all its parts stand at one point, as those of a gyroscope do.

    There only turns count, and as shares of each other they are the same for any length.
    """
    return scene.reach or 1.0


def placed(scene: Scene, angle: Array) -> Array:
    """Return what an error of the motion is measured on.

    Parameters
    ----------
    angle : array, (k, m)
        Of hub and links, as a trace has them, rad.

    Returns
    -------
    array, (d, k, p)
        Outer ends of a planar arm's links along x and y, points on the bodies of an arm in space along x, y and z, m;
        of a chain the angles themselves, rad.
    """
    if scene.spatial is not None:
        return body_points(scene.spatial, angle, _SPREAD * extent(scene))
    if scene.model.linear:
        return angle[None]
    x, y = node_places(scene, angle[:, angle.shape[1] - scene.stations :])
    return np.stack([x[:, 1:], y[:, 1:]])


def lengths(along: Array) -> Array:
    """Return lengths from their components along each axis, which come first."""
    found: Array = np.sqrt(np.sum(along**2, axis=0))
    return found
