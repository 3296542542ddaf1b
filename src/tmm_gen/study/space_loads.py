"""Loads on an arm in space for a study: all together turn the arm by about a radian."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.scene.spatial.arm import SpatialArm


def turning_loads(arm: SpatialArm, frequencies: Mapping[str, float], turn: float) -> dict[str, float]:
    """Return amplitudes for each column of the inputs, in N, or N m of the motor's own side.

    Springs, dampers and inertia all resist: where one of them is far larger than the others, it alone decides, so that
    a free joint costs no absurd torque and a stiff one no absurd motion.

    Parameters
    ----------
    arm : SpatialArm
        As it starts.
    frequencies : mapping from str to float
        With which each column acts, rad/s.
    turn : float
        What some body of the arm turns by where all columns act, about, rad.
    """
    world = WorldArm(arm)
    q = np.array([joint.angle for joint in arm.joints])
    still = np.zeros_like(q)
    places = world.tree.places(q)
    mass, spring, damper = world.mass_matrix(q), np.diag(world.stiffness), np.diag(world.damping)
    alone = world.inverse_dynamics(q, still, still, {})
    turns = {}
    for column, frequency in frequencies.items():
        push = alone - world.inverse_dynamics(q, still, still, {column: 1.0})
        swing = np.linalg.solve(spring + frequency**2 * mass + 1j * frequency * damper, push)
        turned = world.tree.ways @ (places.axis * swing[:, None])
        turns[column] = float(np.max(np.linalg.norm(turned, axis=-1)))
    found: dict[str, float] = {}
    for item in arm.inputs:
        # what pushes along an arm hardly turns it, however strong: components act as the strongest of them does
        largest = max(turns[column] for column in item.columns)
        found |= dict.fromkeys(item.columns, turn / (len(turns) * largest) if largest > 0.0 else 1.0)
    return found
