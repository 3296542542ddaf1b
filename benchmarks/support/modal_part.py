"""The exact response of a long chain to constant inputs, mode by mode.

The matrix exponential of a thousand stations takes minutes; where the damping matrix is a multiple of
the stiffness matrix, modes decouple and each has a closed form.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from tmm_gen.scene import Scene, station_of

Array = NDArray[np.float64]

_CRITICAL = 1e-6
"""Roots nearer than this, relatively, are treated as a double root."""


def modes(scene: Scene) -> tuple[Array, Array]:
    """Return squared natural frequencies and mode shapes of a clamped chain, undamped.

    Returns
    -------
    squares : array, (n,)
        rad^2/s^2, increasing.
    shapes : array, (n, n)
        Columns; orthonormal with respect to the mass matrix.
    """
    from scipy.linalg import eigh_tridiagonal

    inertia = np.array([link.inertia for link in scene.links])
    stiffness = np.array([joint.stiffness for joint in scene.joints])
    root = np.sqrt(inertia)
    diagonal = (stiffness + np.append(stiffness[1:], 0.0)) / inertia
    squares, shapes = eigh_tridiagonal(diagonal, -stiffness[1:] / (root[1:] * root[:-1]))
    return squares, shapes / root[:, None]


def modal_response(scene: Scene, inputs: Mapping[str, float], times: Array) -> dict[str, Array]:
    """Return the exact angles a scene's outputs ask for, from rest under constant inputs.

    Parameters
    ----------
    scene : Scene
        A clamped chain at rest whose joints all have the same ratio of damping to stiffness; outputs
        other than angles are left out.
    inputs : mapping from str to float
        Torques by name; those not given are zero.
    times : array, (k,)
        s, from 0 on.

    Raises
    ------
    ValueError
        If the scene is not of this kind.
    """
    ratio = _damping_time(scene)
    squares, shapes = modes(scene)
    load = np.zeros(scene.stations)
    for item in scene.inputs:
        load[station_of(item.at, scene.stations) - 1] += inputs.get(item.name, 0.0)
    static = (shapes.T @ load) / squares
    motion = static[:, None] * _unit_step(squares, ratio, np.asarray(times, float))
    return {
        output.name: shapes[station_of(output.at, scene.stations) - 1] @ motion
        for output in scene.outputs
        if output.of == "angle"
    }


def _damping_time(scene: Scene) -> float:
    """Return the common ratio of damping to stiffness, s."""
    ratios = {joint.damping / joint.stiffness for joint in scene.joints}
    moving = any(scene.initial.angles) or any(scene.initial.rates)
    if scene.model.kind != "chain" or scene.base.kind != "clamp" or moving or len(ratios) > 1:
        raise ValueError(f"scene '{scene.name}' has no decoupled modes starting from rest")
    return ratios.pop()


def _unit_step(squares: Array, ratio: float, times: Array) -> Array:
    """Return ``x`` with ``x'' + w^2 ratio x' + w^2 x = w^2``, from rest, one row for each ``w^2``."""
    w2 = squares[:, None].astype(complex)
    half = w2 * ratio / 2  # decay rate of an underdamped mode
    split = np.sqrt(half**2 - w2)
    double = np.abs(split) < _CRITICAL * np.sqrt(np.abs(w2))
    split = np.where(double, np.sqrt(w2), split)
    slow = -w2 / (half + split)  # not split - half, which cancels
    slow = np.where(double, -half, slow)
    fast = np.where(double, -half, -half - split)
    with np.errstate(under="ignore"):
        gap = np.where(double, 1.0, fast - slow)
        apart = (fast * np.exp(slow * times) - slow * np.exp(fast * times)) / gap
        meeting = (1.0 + half * times) * np.exp(-half * times)
    return np.real(1.0 - np.where(double, meeting, apart))
