"""How many natural frequencies lie below a frequency, after Wittrick and Williams: none is missed."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tmm_gen.modal.beam.arm import BeamArm
from tmm_gen.modal.beam.member import Integers, clamped_count

Array = NDArray[np.float64]

_ZERO = 1e-9
"""An eigenvalue of the balanced static stiffness below this is that of a rigid-body motion."""


def modes_below(arm: BeamArm, omega: ArrayLike) -> Integers:
    """Return how many undamped natural frequencies lie below each frequency, rigid-body motions included.

    The modes of the beams with all nodes held, plus the negative eigenvalues of the dynamic stiffness of the
    nodes (Wittrick & Williams 1971, Q. J. Mech. Appl. Math. 24, 263-284).

    Parameters
    ----------
    arm : BeamArm
        Its damping is left out.
    omega : array_like, (f,)
        rad/s, positive.
    """
    points = np.atleast_1d(np.asarray(omega, float))
    still = arm.undamped()
    held = sum(
        (clamped_count(member, points) for member in still.members), start=np.zeros(len(points), np.int64)
    )
    stiffness = balanced(still.stiffness(1j * points).real)
    counted: Integers = held + np.sum(np.linalg.eigvalsh(stiffness) < 0.0, axis=-1)
    return counted


def rigid_motions(arm: BeamArm) -> int:
    """Return in how many ways the arm moves without resistance."""
    static = balanced(arm.undamped().stiffness(np.zeros(1)).real)
    return int(np.sum(np.abs(np.linalg.eigvalsh(static)) < _ZERO))


def balanced(matrices: Array) -> Array:
    """Scale rows and columns alike so that the largest entry of each is one.

    The signs of the eigenvalues stay (Sylvester), and a heavy hub no longer hides a light beam.

    Parameters
    ----------
    matrices : array, (f, n, n)
        Symmetric.
    """
    found = matrices
    for _ in range(3):
        scale = 1.0 / np.sqrt(np.maximum(np.max(np.abs(found), axis=-1), np.finfo(float).tiny))
        found = found * scale[:, :, None] * scale[:, None, :]
    return found
