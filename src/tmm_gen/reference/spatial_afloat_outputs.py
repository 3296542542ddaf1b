"""The outputs of an arm in space whose base floats, by the equations of :mod:`tmm_gen.reference.spatial_afloat`."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.reference.spatial_afloat import BASE, AfloatArm
from tmm_gen.reference.spatial_arm import Inputs
from tmm_gen.reference.spatial_places import cross
from tmm_gen.reference.spatial_turns import alike, followed, quaternions
from tmm_gen.scene.spatial.arm import ArmOutput, Frame

Array = NDArray[np.float64]


def afloat_values(world: AfloatArm, output: ArmOutput, y: Array, u: Array, b: Array, inputs: Inputs) -> Array:
    """Return an output, (k,) or (k, components), from coordinates and their derivatives, (k, 7 + n) each."""
    quantity = output.quantity
    if quantity.read == "bend":
        moving = (y, u, b)[quantity.order]
        return np.asarray(sum(moving[:, BASE + number - 1] for number in output.turning))
    if quantity.read == "through":
        return np.asarray(world.resting.torque(y[:, BASE:], u[:, BASE:], inputs)[:, output.passing - 1])
    if quantity.energy == "kinetic":
        return world.kinetic_energy(y, u)
    if quantity.energy == "gravitational":
        return world.gravitational_energy(y)
    if quantity.energy == "elastic":
        bent = y[:, BASE:] - world.resting.rest
        return np.asarray(0.5 * (bent**2 @ world.resting.stiffness))
    assert output.frame is not None
    axes, point, velocity = _seen(world, output.frame, y, u)
    if quantity.order:
        return velocity
    if quantity.components == "xyz":
        return point
    return alike(quaternions(axes), followed(world.arm, output.frame, y[:, BASE:], y[:, 3:BASE]))


def _seen(world: AfloatArm, frame: Frame, y: Array, u: Array) -> tuple[Array, Array, Array]:
    """Return a frame's axes by columns, (k, 3, 3), its point and that point's velocity, (k, 3) each."""
    carrier, places, motions = world.moving(y, u, np.zeros_like(u))
    at, turn = np.array(frame.at), np.array(frame.turn)
    if not frame.joint:
        lever = carrier.axes @ at
        return carrier.axes @ turn, carrier.place + lever, carrier.velocity + cross(carrier.spin, lever)
    axes, point = places.frame(frame)
    body = frame.joint - 1
    lever = point - places.point[:, body]
    return axes, point, np.asarray(motions.speed[:, body] + cross(motions.spin[:, body], lever))
