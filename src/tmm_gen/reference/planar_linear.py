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
    arm = Arm(scene, {})
    _, damping = arm.springs
    mass = arm.mass
    hub = len(mass) - scene.stations
    stiffness = np.array([joint.stiffness for joint in scene.joints])
    # joints without a spring, and a free hub, let all beyond them turn, whatever the numbers are
    unit = arm.paths[:, hub:]
    held = stiffness > 0.0
    turning = hub + int(np.sum(~held))
    # angles for a unit of energy in each joint: no stiffness hides the slowest swing
    bends = unit[:, held] / np.sqrt(stiffness[held])
    whole = np.concatenate([np.ones((len(mass), hub)), unit[:, ~held]], axis=1)
    if turning:
        whole = np.linalg.solve(np.linalg.cholesky(whole.T @ mass @ whole), whole.T).T
    bends = bends - whole @ (whole.T @ mass @ bends)
    _, sizes, rows = np.linalg.svd(np.linalg.cholesky(mass).T @ bends, full_matrices=False)
    shapes = np.concatenate([whole, bends @ rows.T / sizes], axis=1)
    frequencies = np.concatenate([np.zeros(turning), 1.0 / sizes])
    modal = np.einsum("ji,jk,ki->i", shapes, damping, shapes)
    ratios = np.divide(modal, 2.0 * frequencies, out=np.zeros_like(modal), where=frequencies > 0.0)
    return Vibration(frequencies, ratios)
