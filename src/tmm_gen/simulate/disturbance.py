"""A small disturbance of a run's start, which tells how much the motion makes of such."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

SIZES = {"float64": 1e-9, "float32": 1e-4, "compensated": 1e-8}
"""rad; well above rounding, well below what bends an arm."""


def disturbed(scene: Scene, size: float, step: float) -> Array:
    """Return how far the start of each station is put off, (n,), rad.

    Springs so stiff that a step does not follow how they ring are wound up by less: no motion begins like that, and
    integrators without damping of their own would keep what such a blow leaves for good.

    Parameters
    ----------
    scene : Scene
        A planar arm or one in space.
    size : float
        Of the largest, rad.
    step : float
        s.
    """
    moved = size * np.where(np.arange(scene.stations) % 3 == 0, 1.0, 0.5)
    if scene.spatial is None:
        return moved
    arm = WorldArm(replace(scene.spatial, base=None))
    inertia = np.diag(arm.mass_matrix(np.array(scene.initial.angles, float)))
    rung = step**2 * arm.stiffness / np.where(inertia > 0.0, inertia, np.inf)
    return moved / np.maximum(1.0, rung)
