"""Frequency response of the outputs of an arm in space to its inputs, by the exact sweep at ``s = j omega``."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import sympy as sp
from numpy.typing import ArrayLike, NDArray

from tmm_gen.derive.space.pose import quaternion_product
from tmm_gen.modal.blocks import filler
from tmm_gen.modal.space.still import Still
from tmm_gen.modal.space.sweep import Inputs, Swept, inputs_of, swept
from tmm_gen.program.space.turns import quaternion_of
from tmm_gen.scene.spatial.arm import ArmOutput, Frame

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_AT_ONCE = 4_000_000
"""Numbers a sweep may hold at a time; more frequencies are taken in several."""


def space_response(still: Still, s: ArrayLike) -> dict[str, Complex]:
    """Return all outputs but energies for a unit of each column of the inputs.

    Parameters
    ----------
    still : Still
        Where the arm rests that swings.
    s : array_like, (f,)
        Laplace variable, 1/s, no pole; ``1j * omega`` for steady vibration.

    Returns
    -------
    dict from str to array, (f, inputs)
        By column of the output.
    """
    points = np.atleast_1d(np.asarray(s, complex))
    inputs = inputs_of(still)
    outputs = [item for item in still.numbers.arm.outputs if answers(item)]
    numbers = still.numbers.size * (42 + 14 * max(1, len(inputs.columns)))
    chunk = max(1, _AT_ONCE // numbers)
    parts: list[dict[str, Complex]] = []
    for start in range(0, len(points), chunk):
        some = points[start : start + chunk]
        whole = swept(still, some, inputs)
        read: dict[str, Complex] = {}
        for item in outputs:
            read |= _read(still, inputs, some, whole, item)
        parts.append(read)
    return {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}


def answers(output: ArmOutput) -> bool:
    """Whether an output is read off small motion: no energy, which goes with its square."""
    return output.quantity.read != "energy"


def _read(still: Still, inputs: Inputs, s: Complex, whole: Swept, output: ArmOutput) -> dict[str, Complex]:
    factor, angles = (s**output.quantity.order)[:, None], whole.moved[:, 6:]
    if output.quantity.read == "bend":
        turning = still.numbers.turning
        if output.joint or turning is None:
            return {output.name: factor * sum(angles[:, number - 1] for number in output.turning)}
        own = np.equal(inputs.columns, turning.column)  # the base's own angle
        return {output.name: factor * own}
    if output.quantity.read == "force":
        values = whole.taken[:, :3] + np.cross(inputs.base[3:], _held_force(still)[:, None], axis=0)
        return {name: values[:, k] for k, name in enumerate(output.columns)}
    if output.quantity.read == "through" and not output.joint:  # what drives a base that an input turns
        assert still.numbers.turning is not None
        return {output.name: still.numbers.turning.coordinates @ whole.taken}
    if output.quantity.read == "through":
        joint = output.passing - 1
        law = still.numbers.stiffness[joint] + still.numbers.damping[joint] * s
        return {output.name: inputs.torque[joint] - law[:, None] * angles[:, joint]}
    assert output.frame is not None
    moved, turned = still.moved(output.frame)
    turns = len(output.columns) == len("wxyz")
    slopes = small_orientation(still, output.frame, turned) if turns else moved
    values = factor[:, None] * (slopes @ whole.moved)
    return {name: values[:, k] for k, name in enumerate(output.columns)}


def _held_force(still: Still) -> Array:
    """Return the force that a base held still exerts, (3,), N, in world axes: those of the base turn against them."""
    numbers = still.numbers
    found = numbers.base_body[:3, :3] @ -numbers.gravity
    for joint, host in enumerate(numbers.hosts):
        if host < 0:
            found += (still.through[joint].T @ still.forces[joint])[:3]
    return found


def small_orientation(still: Still, frame: Frame, turned: Array) -> Array:
    """Return how a frame's quaternion changes, (4, k), by how it turns in its own axes, (3, k).

    The quaternion is that of outputs: half of each joint's angle on the way makes it.
    """
    way = []
    number = frame.joint
    while number:
        way.append(number - 1)
        number = still.numbers.hosts[number - 1] + 1
    base = still.numbers.arm.base
    found = np.array(quaternion_of(base.turn)) if base else np.array([1.0, 0.0, 0.0, 0.0])
    for joint in reversed(way):
        item, half = still.numbers.arm.joints[joint], 0.5 * float(still.angles[joint])
        turn = np.array([np.cos(half), 0.0, 0.0, 0.0])
        turn[1 + item.axis] = np.sin(half)
        found = _product(_product(found, np.array(quaternion_of(item.turn))), turn)
    found = _product(found, np.array(quaternion_of(frame.turn)))
    return _product(found, np.concatenate([np.zeros((1, turned.shape[1])), 0.5 * turned]))


def _product(one: Array, other: Array) -> Array:
    """Return the product of a quaternion with others, (4,) with (4, ...)."""
    found = np.empty((*other.shape[1:], 4, 1))
    _quaternions()(found, *one, *other)
    return np.moveaxis(found[..., 0], -1, 0)


@cache
def _quaternions() -> Callable[..., None]:
    one, other = (sp.Matrix(sp.symbols(f"{name}:4", real=True)) for name in ("p", "q"))
    return filler([*one, *other], quaternion_product(one, other))
