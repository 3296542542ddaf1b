"""Where the base of a planar arm is that nothing holds: its centre of mass moves as forces push it (Newton)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.reference.planar_arm import Arm

Array = NDArray[np.float64]

_NODES = 20
"""Gauss points between two instants, for the forces over time."""


def base_place(arm: Arm, order: int, times: Array, q: Array, v: Array, a: Array) -> tuple[Array, Array]:
    """Return the position of the base or its first or second derivative, (k,) along x and y; zero where it is held.

    Parameters
    ----------
    order : int
        How often it is differentiated.
    times : array, (k,)
        s, increasing, from 0 on.
    q, v, a : array, (k, n)
        Motion at these instants.
    """
    if not arm.scene.floats:
        return np.zeros(len(times)), np.zeros(len(times))
    center, (x, y) = _center(arm, times)[order], about_center(arm, order, q, v, a)
    return center[0] + x, center[1] + y


def about_center(arm: Arm, order: int, q: Array, v: Array, a: Array) -> tuple[Array, Array]:
    """Return the same against the centre of mass of an arm that floats; zero where the base is held."""
    x, y = arm.point(order, -arm.moments / arm.whole, q, v, a)
    return x, y


def _center(arm: Arm, times: Array) -> list[tuple[Array, Array]]:
    """Return position, velocity and acceleration of the centre of mass, (k,) along x and y each.

    The base starts at the origin, at rest.
    """
    initial = arm.scene.initial
    angles, rates = (np.array([[0.0] * arm.first + list(x)]) for x in (initial.angles, initial.rates))
    lever = arm.moments / arm.whole
    ends = np.unique(np.concatenate([[0.0], times, *(arm.signal(i.name).knots for i in arm.scene.inputs)]))
    ends = ends[(ends >= 0.0) & (ends <= times[-1])]
    nodes, weights = np.polynomial.legendre.leggauss(_NODES)
    half = 0.5 * np.diff(ends)[:, None]
    instants = ends[:-1, None] + half * (1.0 + nodes)
    place = np.searchsorted(ends, times)
    falls = (0.0, -arm.gravity)
    found = []
    for axis, fall in enumerate(falls):
        begun = [arm.point(order, lever, angles, rates, np.zeros_like(angles))[axis][0] for order in (0, 1)]
        inside = (arm.loads(instants.ravel())[axis + 1].sum(axis=1) / arm.whole + fall).reshape(
            instants.shape
        )
        gained = np.sum(half * weights * inside, axis=1)
        moved = np.sum(half * weights * inside * (ends[1:, None] - instants), axis=1)
        rate = begun[1] + np.concatenate([[0.0], np.cumsum(gained)])
        way = begun[0] + np.concatenate([[0.0], np.cumsum(rate[:-1] * np.diff(ends) + moved)])
        now = arm.loads(times)[axis + 1].sum(axis=1) / arm.whole + fall
        found.append((way[place], rate[place], now))
    return list(zip(*found, strict=True))
