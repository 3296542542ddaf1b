"""The outputs of an arm in space, by the equations of :mod:`tmm_gen.reference.spatial_arm`."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.reference.spatial_afloat import AfloatArm
from tmm_gen.reference.spatial_afloat_outputs import afloat_values
from tmm_gen.reference.spatial_arm import Inputs, WorldArm
from tmm_gen.reference.spatial_given import given, moved
from tmm_gen.reference.spatial_motion import Signals, motion
from tmm_gen.reference.spatial_places import cross
from tmm_gen.reference.spatial_turns import alike, followed, quaternions
from tmm_gen.scene.signal import RATE
from tmm_gen.scene.spatial.arm import ArmOutput, Frame, SpatialArm

Array = NDArray[np.float64]


def spatial_response(
    arm: SpatialArm, signals: Signals, times: Array, tolerance: float = 1e-11
) -> dict[str, Array]:
    """Return the outputs of an arm in space, to about ten digits.

    Parameters
    ----------
    arm : SpatialArm
    signals : mapping from str to Signal
        Inputs by column; those not given are zero.
    times : array, (k,)
        Instants, s, increasing, from 0 on; at least one.
    tolerance : float
        See :func:`tmm_gen.reference.spatial_motion.motion`.

    Returns
    -------
    dict from str to array, (k,)
        Outputs by column.

    Raises
    ------
    ReferenceError
        If the equations cannot be integrated.
    """
    times = np.asarray(times, float)
    return outputs(arm, *motion(arm, signals, times, tolerance), given(arm, signals, times))


def outputs(arm: SpatialArm, q: Array, v: Array, a: Array, inputs: Inputs) -> dict[str, Array]:
    """Return the outputs by column from the motion at some instants, (k, n) each; inputs by column, (k,).

    On a base that floats, motion is that of its coordinates too, (k, 7 + n): see
    :class:`tmm_gen.reference.spatial_afloat.AfloatArm`.
    """
    found: dict[str, Array] = {}
    for output in arm.outputs:
        if arm.base is None:
            values = _values(WorldArm(arm), output, q, v, a, inputs)
        else:
            values = afloat_values(AfloatArm(arm), output, q, v, a, inputs)
        columns = np.moveaxis(values, -1, 0) if len(output.columns) > 1 else [values]
        found |= dict(zip(output.columns, columns, strict=True))
    return found


def _values(world: WorldArm, output: ArmOutput, q: Array, v: Array, a: Array, inputs: Inputs) -> Array:
    """Return an output, (k,) or (k, components)."""
    quantity = output.quantity
    if quantity.read == "bend":
        moving = (q, v, a)[quantity.order]
        return np.asarray(sum(moving[:, number - 1] for number in output.turning))
    if quantity.read == "through" and world.arm.joints[output.joint - 1].given:  # what drives it
        return np.asarray(world.inverse_dynamics(q, v, a, inputs)[:, output.joint - 1])
    if quantity.read == "through":
        return np.asarray(world.torque(q, v, inputs)[:, output.passing - 1])
    if quantity.read == "force":
        return np.asarray(world.base_force(q, v, a, inputs))
    if quantity.read == "energy":
        return _energy(world, quantity.energy, q, v, inputs)
    assert output.frame is not None
    if quantity.order:
        return _along(_velocity(world, output.frame, q, v), moved(world.arm, inputs, RATE))
    axes, point = world.tree.places(q).frame(output.frame)
    if quantity.components == "xyz":
        return _along(np.asarray(point), moved(world.arm, inputs))
    return alike(quaternions(axes), followed(world.arm, output.frame, q))


def _along(values: Array, base: Array | None) -> Array:
    """Return places or velocities seen from a base, (k, 3), as they are in the world."""
    return values if base is None else values + base


def _energy(world: WorldArm, which: str, q: Array, v: Array, inputs: Inputs) -> Array:
    if which == "kinetic":
        base = moved(world.arm, inputs, RATE)
        own = kinetic_energy(world, q, v)
        if base is None:
            return own
        moving, _ = world.jacobians(world.tree.places(q))
        momentum = np.einsum("b,kbij,kj->ki", world.masses, moving, v)
        return np.asarray(own + np.sum((momentum + 0.5 * np.sum(world.masses) * base) * base, axis=-1))
    if which == "elastic":
        return np.asarray(0.5 * ((q - world.rest) ** 2 @ world.stiffness))
    base = moved(world.arm, inputs)
    lifted = 0.0 if base is None else np.sum(world.masses) * (base @ world.gravity)
    return gravitational_energy(world, q) - lifted


def _velocity(world: WorldArm, frame: Frame, q: Array, v: Array) -> Array:
    """Return the velocity of a frame's point, (k, 3), m/s."""
    if not frame.joint:
        return np.zeros((len(q), 3))
    places = world.tree.places(q)
    motions = world.tree.motions(places, v, np.zeros_like(v))
    body = frame.joint - 1
    lever = places.frame(frame)[1] - places.point[:, body]
    return np.asarray(motions.speed[:, body] + cross(motions.spin[:, body], lever))


def kinetic_energy(world: WorldArm, q: Array, v: Array) -> Array:
    """Return the kinetic energy of bodies and rotors, (k,), J."""
    return np.asarray(0.5 * np.einsum("ki,kij,kj->k", v, world.mass_matrix(q), v))


def gravitational_energy(world: WorldArm, q: Array) -> Array:
    """Return the energy of weight, (k,), J: zero where all mass is at the height of the base."""
    center, _ = world.centers(world.tree.places(q))
    return np.asarray(-(world.masses @ (center @ world.gravity)[..., None])[..., 0])
