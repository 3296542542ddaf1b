"""The highest natural frequency of a scene: what a time step is measured by."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tmm_gen.reference.assembly import assemble
from tmm_gen.reference.planar_linear import vibration
from tmm_gen.reference.spatial_linear import vibrations
from tmm_gen.scene import Scene


@dataclass(frozen=True)
class FastestMode:
    """The mode of the highest natural frequency.

    Parameters
    ----------
    frequency : float
        Undamped, rad/s.
    damping_ratio : float
        ``phi C phi / (2 w)`` with the mode shape normalised to unit mass; other modes are left out of it.
    """

    frequency: float
    damping_ratio: float


def fastest_mode(scene: Scene) -> FastestMode:
    """Return the mode of the highest natural frequency, from the assembled matrices.

    A planar arm is taken as straight and without weight, one in space as it starts, without weight.
    """
    from scipy.linalg import eigh, eigh_tridiagonal  # slow to import

    if scene.spatial is not None:
        frequencies, ratios = vibrations(scene.spatial)
        return FastestMode(float(frequencies[-1]), float(ratios[-1]))
    if not scene.model.linear:
        found = vibration(scene)
        return FastestMode(float(found.frequencies[-1]), float(found.damping_ratios[-1]))
    assembly = assemble(scene)
    root = np.sqrt(np.diag(assembly.mass))
    scaled = assembly.stiffness / np.outer(root, root)
    last = len(root) - 1
    if scene.hosts:
        squares, shapes = eigh(scaled, subset_by_index=(last, last))
    else:
        squares, shapes = eigh_tridiagonal(
            np.diag(scaled), np.diag(scaled, 1), select="i", select_range=(last, last)
        )
    frequency = float(np.sqrt(squares[0]))
    shape = shapes[:, 0] / root
    return FastestMode(frequency, float(shape @ assembly.damping @ shape / (2.0 * frequency)))
