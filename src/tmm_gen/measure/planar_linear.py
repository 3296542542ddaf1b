"""Small vibrations of a planar arm about the straight, unloaded position: what steps and durations are measured by."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.measure.planar_arm import Arm
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
    from scipy.linalg import eigh  # slow to import

    arm = Arm(scene, {})
    stiffness, damping = arm.springs
    mass = arm.coupling + np.diag(arm.inertias)
    squares, shapes = eigh(stiffness, mass)
    squares = np.maximum(squares, 0.0)
    frequencies = np.sqrt(squares)
    swinging = frequencies > 1e-6 * frequencies[-1]
    modal = np.einsum("ji,jk,ki->i", shapes, damping, shapes)
    ratios = np.where(swinging, modal / (2.0 * np.where(swinging, frequencies, 1.0)), 0.0)
    return Vibration(np.where(swinging, frequencies, 0.0), ratios)
