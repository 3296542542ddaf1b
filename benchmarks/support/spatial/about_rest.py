"""An arm in space at rest by world equations: equilibria under constant inputs, tangent stiffness, frequencies."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.reference.collocation import ReferenceError
from tmm_gen.reference.spatial_arm import Inputs, WorldArm
from tmm_gen.scene.spatial.arm import SpatialArm

Array = NDArray[np.float64]

_ITERATIONS = 60
_SETTLED = 1e-13
_LARGEST = 0.5
"""rad; no angle changes by more at once."""


def stiffness(arm: SpatialArm, q: Array, inputs: Inputs | None = None) -> Array:
    """Return the tangent stiffness, (n, n), N m/rad: torques that joints lack by angles, gravity and loads included.

    Parameters
    ----------
    arm : SpatialArm
    q : array, (n,)
        Angles, rad.
    inputs : mapping from str to float, optional
        Constant inputs by column.
    """
    still = np.zeros(len(arm.joints))
    return WorldArm(arm).tangents(np.asarray(q, float), still, still, inputs or {})[0]


def equilibrium(arm: SpatialArm, inputs: Inputs | None = None, start: Array | None = None) -> Array:
    """Return angles of rest, (n,), rad, by Newton's method.

    Parameters
    ----------
    arm : SpatialArm
    inputs : mapping from str to float, optional
        Constant inputs by column.
    start : array, (n,), optional
        Where to start; where the springs are slack if not given.

    Raises
    ------
    ReferenceError
        If none is found.
    """
    world, given = WorldArm(arm), inputs or {}
    q = world.rest.copy() if start is None else np.array(start, float)
    still = np.zeros_like(q)
    for _ in range(_ITERATIONS):
        lacking = world.inverse_dynamics(q, still, still, given)
        by_q, _ = world.tangents(q, still, still, given)
        change = np.linalg.solve(by_q, -lacking)
        largest = float(np.max(np.abs(change)))
        q = q + change * min(1.0, _LARGEST / max(largest, 1e-300))
        if largest <= _SETTLED * max(1.0, float(np.max(np.abs(q)))):
            return q
    raise ReferenceError(
        f"no rest found in {_ITERATIONS} iterations: the last one moved an angle by {largest:.1e} rad"
    )


def frequencies(arm: SpatialArm, q: Array | None = None) -> Array:
    """Return the undamped natural frequencies about a rest, (n,), rad/s, rising.

    Parameters
    ----------
    arm : SpatialArm
    q : array, (n,), optional
        Angles of the rest, rad; where the springs are slack if not given.

    Notes
    -----
    A direction in which the rest is not stable has a negative square ``s``; it is listed as ``-sqrt(-s)``.
    """
    from scipy.linalg import eigh  # slow to import

    world = WorldArm(arm)
    at = world.rest if q is None else np.asarray(q, float)
    tangent = stiffness(arm, at)
    squares = eigh(0.5 * (tangent + tangent.T), world.mass_matrix(at), eigvals_only=True)
    found: Array = np.sign(squares) * np.sqrt(np.abs(squares))
    return found
