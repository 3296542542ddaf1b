"""The elements of arms in space about rest as numbers, from the declarations that kernels are made of."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.derive.space.declaration import (
    ANGLE,
    MASS,
    OFFSET,
    PAIRS,
    TURN,
    Body,
    about_center,
    hinge,
    offset,
    symmetric,
    turned,
    vector,
)
from tmm_gen.derive.space.resting import resting_body, resting_passage
from tmm_gen.modal.blocks import filler
from tmm_gen.scene.spatial.arm import Revolute, RigidBody

Array = NDArray[np.float64]


def hinges(axes: Sequence[int], angles: Array) -> tuple[Array, Array]:
    """Return what hinges make of accelerations at some angles, and its derivative by the angle, (n, 6, 6) each.

    Parameters
    ----------
    axes : sequence of int
        0, 1 or 2: about which frame axis each turns.
    angles : array, (n,)
        rad.
    """
    found = np.empty((2, len(axes), 6, 6))
    for axis in range(3):
        mine = np.flatnonzero(np.equal(axes, axis))
        for which, fill in enumerate(_hinge(axis)[:2]):
            part = np.empty((len(mine), 6, 6))
            fill(part, angles[mine])
            found[which, mine] = part
    return found[0], found[1]


def pushes(axes: Sequence[int]) -> Array:
    """Return what the hinge's own acceleration makes of accelerations, (n, 6)."""
    return np.array([_hinge(axis)[2] for axis in axes])


def mounts(joints: Sequence[Revolute]) -> Array:
    """Return what offset and constant turn in front of each hinge make of accelerations, (n, 6, 6)."""
    at = np.array([joint.at for joint in joints])
    turns = np.array([joint.turn for joint in joints]).reshape(-1, 9)
    across, around = np.empty((2, len(joints), 6, 6))
    _offset()(across, *at.T)
    _turned()(around, *turns.T)
    made: Array = around @ across
    return made


def beside(at: Sequence[float]) -> Array:
    """Return what a rigid way to another point makes of accelerations, (6, 6)."""
    found = np.empty((6, 6))
    _offset()(found, *at)
    return found


def bodies(rigid: Sequence[RigidBody]) -> Array:
    """Return force and moment that each body takes per acceleration, (n, 6, 6), symmetric."""
    masses = np.array([body.mass for body in rigid])
    centers = np.array([body.center for body in rigid]).reshape(-1, 3)
    inertias = np.array([body.inertia for body in rigid]).reshape(-1, 6)
    found = np.empty((len(rigid), 6, 6))
    _body()(found, masses, *centers.T, *inertias.T)
    return found


def turning() -> Array:
    """Return the derivative of a fixed vector's components by a small turn about each axis of its frame, (3, 3, 3)."""
    return np.array([hinges([axis], np.zeros(1))[1][0, :3, :3] for axis in range(3)])


_Fill = Callable[..., None]


@cache
def _hinge(axis: int) -> tuple[_Fill, _Fill, tuple[float, ...]]:
    at_rest = resting_passage(hinge(axis))
    fills = [filler([ANGLE], matrix) for matrix in (at_rest.through, at_rest.through.diff(ANGLE))]
    return fills[0], fills[1], tuple(float(entry) for entry in at_rest.pushed)


@cache
def _offset() -> _Fill:
    return filler(list(OFFSET), resting_passage(offset()).through)


@cache
def _turned() -> _Fill:
    return filler(list(TURN), resting_passage(turned()).through)


@cache
def _body() -> _Fill:
    center = vector("center")
    inertia: tuple[Any, ...] = tuple(vector(f"central_{pair}")[0] for pair in PAIRS)
    body = Body("body", about_center(MASS, center, symmetric(inertia)))
    return filler([MASS, *center, *inertia], resting_body(body))
