"""Small vibrations of a planar arm about the straight, unloaded position: what steps and durations are measured by."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.reference.planar_arm import Arm
from tmm_gen.scene import Scene

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Vibration:
    """Natural vibrations, undamped.

    Parameters
    ----------
    frequencies : array, (m,)
        rad/s, increasing; zero where the arm turns as a whole.
    damping_ratios : array, (m,)
        ``phi C phi / (2 w)`` with mode shapes of unit mass; zero where the arm turns as a whole.
    """

    frequencies: Array
    damping_ratios: Array


def vibration(scene: Scene) -> Vibration:
    """Return natural frequencies and damping ratios of a planar scene without gravity, straight."""
    from scipy.linalg import cholesky, svd  # slow to import

    arm = Arm(scene, {})
    _, damping = arm.springs
    mass = arm.coupling + np.diag(arm.inertias)
    turning = len(mass) - scene.stations  # a free hub lets the arm turn as a whole, whatever the numbers are
    # angles for a unit of energy in each joint: no stiffness hides the slowest swing
    bends = np.tri(len(mass), scene.stations, -turning)
    bends = bends / np.sqrt([joint.stiffness for joint in scene.joints])
    whole = np.ones((len(mass), turning))
    whole = whole / np.sqrt(np.sum(whole * (mass @ whole), axis=0))
    bends = bends - whole @ (whole.T @ mass @ bends)
    _, sizes, rows = svd(cholesky(mass) @ bends, full_matrices=False)
    shapes = np.concatenate([whole, bends @ rows.T / sizes], axis=1)
    frequencies = np.concatenate([np.zeros(turning), 1.0 / sizes])
    modal = np.einsum("ji,jk,ki->i", shapes, damping, shapes)
    ratios = np.divide(modal, 2.0 * frequencies, out=np.zeros_like(modal), where=frequencies > 0.0)
    return Vibration(frequencies, ratios)
