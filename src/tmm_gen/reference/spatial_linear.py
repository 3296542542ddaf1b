"""Small vibrations of an arm in space about where it starts, without weight."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.reference.spatial_afloat import joint_mass
from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.reference.spatial_given import free_joints
from tmm_gen.scene.spatial.arm import SpatialArm

Array = NDArray[np.float64]


def vibrations(arm: SpatialArm) -> tuple[Array, Array]:
    """Return how springs give way where an arm starts, without weight: frequencies and damping ratios, (n,) each.

    Frequencies rise, rad/s; those of free joints are zero but for rounding. Damping ratios are ``phi C phi / (2 w)``
    with mode shapes of unit mass, zero where ``w`` is.
    """
    from scipy.linalg import eigh  # slow to import

    world = WorldArm(arm)
    free = free_joints(arm)
    mass = joint_mass(arm)[np.ix_(free, free)]
    squares, shapes = eigh(np.diag(world.stiffness[free]), mass)
    found: Array = np.sqrt(np.maximum(squares, 0.0))
    damped = world.damping[free] @ shapes**2
    ratios: Array = np.where(found > 0.0, damped / np.where(found > 0.0, 2.0 * found, 1.0), 0.0)
    return found, ratios
