"""Frequency response of a scene's outputs to its inputs, by the Riccati sweep at ``s = j omega``."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tmm_gen.modal.arm import GEARED, JOINTS, LinearArm
from tmm_gen.modal.sweep import States, sweep
from tmm_gen.scene import Output, Scene, station_of

Complex = NDArray[np.complex128]

_AT_ONCE = 4_000_000
"""Numbers a sweep may hold at a time; more frequencies are taken in several."""


def frequency_response(arm: LinearArm, s: ArrayLike) -> dict[str, Complex]:
    """Return all outputs for a unit of each input.

    Parameters
    ----------
    arm : LinearArm
        Chain, or planar arm about rest.
    s : array_like, (f,)
        Laplace variable, 1/s, not zero and no pole; ``1j * omega`` for steady vibration.

    Returns
    -------
    dict from str to array, (f, inputs)
        By name of the output; those with two components get ``_x`` and ``_y``.
    """
    points = np.atleast_1d(np.asarray(s, complex))
    numbers = (len(arm.elements) + 1) * (arm.width**2 + arm.width * max(1, len(arm.scene.inputs))) * 3
    chunk = max(1, _AT_ONCE // numbers)
    parts = []
    for start in range(0, len(points), chunk):
        some = points[start : start + chunk]
        states = sweep(arm, some)
        parts.append(
            {
                name: value
                for item in linear_outputs(arm.scene)
                for name, value in _read(arm, states, some, item)
            }
        )
    return {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}


def linear_outputs(scene: Scene) -> tuple[Output, ...]:
    """Return the outputs that answer small motion in proportion: all but energies."""
    return tuple(item for item in scene.outputs if not scene.quantity(item).of_arm)


def _read(arm: LinearArm, states: States, s: Complex, output: Output) -> list[tuple[str, Complex]]:
    station = station_of(output.at, arm.scene.stations)
    quantity = arm.scene.quantity(output)
    names = quantity.columns(output.name)
    if quantity.read == "bend":
        inner, outer = (_behind(arm, number) for number in (arm.scene.inner(station), station))
        return [
            (names[0], s[:, None] ** quantity.order * (states.motion[outer] - states.motion[inner])[:, -1])
        ]
    if quantity.read == "through":  # beyond the joint, a motor's torque included
        at = [k + 1 for k in _joints(arm, output)]
        return [(names[0], states.force[at].sum(axis=0)[:, -1])]
    if quantity.in_joint:
        force = _force(arm, states, output, station)
        if quantity.vector:
            return [(name, force[:, i]) for i, name in enumerate(names)]
        # positive where the joint is bent toward positive angles, whatever side the force is counted on
        return [(names[0], output.factor * arm.sign * force[:, -1])]
    motion = states.motion[_behind(arm, station)]
    factor = output.factor * s[:, None] ** quantity.order
    rows = [0, 1] if quantity.vector else [arm.width - 1]
    return [(name, factor * motion[:, row]) for name, row in zip(names, rows, strict=True)]


def _behind(arm: LinearArm, station: int) -> int:
    """Return the number of the state outboard of a station's link, or of the base."""
    if station == 0:
        return 0
    return 1 + next(k for k, e in enumerate(arm.elements) if e.name == "link" and e.station == station)


def _force(arm: LinearArm, states: States, output: Output, station: int) -> Complex:
    """Return the forces in a joint, or between the last link and the body at the tip."""
    if output.at == "tip":
        link = _behind(arm, station) - 1
        beyond: Complex = (
            states.force[-1].copy() if link + 1 < len(states.force) else np.zeros_like(states.force[-1])
        )
        for number, load in arm.elements[link].loads:
            beyond[:, :, number] -= np.array(load)
        return beyond
    # of geared ones on the outer side
    sides = [k + (arm.elements[k].name == GEARED) for k in _joints(arm, output)]
    found: Complex = states.force[sides].sum(axis=0)
    return found


def _joints(arm: LinearArm, output: Output) -> list[int]:
    """Return the elements that are the joints whose torque or force an output is."""
    joints = arm.scene.joints_of(output)
    return [k for k, e in enumerate(arm.elements) if e.name in JOINTS and e.station in joints]
