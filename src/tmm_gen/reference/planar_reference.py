"""The response of a planar arm by Lagrange's equations, to many digits; see :mod:`tmm_gen.reference.planar_arm`.

Where a force is an output it is the balance of momentum of everything beyond it.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from tmm_gen.inputs.signals import Signal
from tmm_gen.reference.collocation import Trajectory
from tmm_gen.reference.energy import dissipation, elastic_energy, gravitational_energy, kinetic_energy
from tmm_gen.reference.floating import base_place
from tmm_gen.reference.planar_arm import Arm
from tmm_gen.scene import Output, Scene, station_of

Array = NDArray[np.float64]

_NODES = 20
"""Gauss points per step of the reference for the energy turned to heat."""


def planar_response(
    scene: Scene, signals: Mapping[str, Signal], times: Array, tolerance: float = 1e-11
) -> dict[str, Array]:
    """Return the outputs of a planar scene, to about ten digits.

    Parameters
    ----------
    scene : Scene
        Of kind "planar".
    signals : mapping from str to Signal
        Inputs by name; those not given are zero.
    times : array, (k,)
        Instants, s, increasing, from 0 on; at least one.
    tolerance : float
        See :func:`tmm_gen.reference.collocation.integrate`.

    Returns
    -------
    dict from str to array, (k,)
        Outputs by name, vectors as ``NAME_x`` and ``NAME_y``.

    Raises
    ------
    ReferenceError
        If the equations cannot be integrated.
    """
    arm = Arm(scene, signals)
    times = np.asarray(times, float)
    trajectory = arm.trajectory(max(float(times[-1]), 1e-9), tolerance)
    motion = trajectory.at(times)
    found: dict[str, Array] = {}
    for output in scene.outputs:
        if scene.quantity(output).accumulates:
            found[output.name] = dissipated(arm, trajectory, times)
        else:
            found |= read(arm, output, times, *motion)
    return found


def read(arm: Arm, output: Output, times: Array, q: Array, v: Array, a: Array) -> dict[str, Array]:
    """Return an output's columns by name from the motion at some instants, (k, n) each."""
    station = station_of(output.at, arm.scene.stations)
    quantity = arm.scene.quantity(output)
    if quantity.read == "motion":
        place = station - 1 + arm.first
        values = [
            (q, v, a)[quantity.order][:, place] if place >= 0 else arm.base_motion(times)[quantity.order]
        ]
    elif quantity.read == "bend":
        moved, inner = (q, v)[quantity.order], arm.scene.inner(station) - 1 + arm.first
        against = moved[:, inner] if inner >= 0 else arm.base_motion(times)[quantity.order]
        values = [moved[:, station - 1 + arm.first] - against]
    elif quantity.read == "through":
        joints = arm.scene.joints_of(output)
        values = [np.sum([_through(arm, k, times, q, v, a) for k in joints], axis=0)]
    elif quantity.read == "energy":
        values = [_energy(arm, quantity.energy, times, q, v, a)]
    elif quantity.read == "own":
        values = [_torque(arm, output, times, q, v, a)]
    elif quantity.read == "force":
        joints = (arm.scene.stations + 1,) if output.at == "tip" else arm.scene.joints_of(output)
        values = list(np.sum([_force(arm, k, times, q, v, a) for k in joints], axis=0))
    else:
        on_the_way = arm.paths[station - 1 + arm.first] if station else 0.0
        lever = arm.lengths * on_the_way
        moving = zip(
            arm.point(quantity.order, lever, q, v, a),
            base_place(arm, quantity.order, times, q, v, a),
            strict=True,
        )
        values = [of_point + of_base for of_point, of_base in moving]
    return dict(zip(quantity.columns(output.name), values, strict=True))


def _ground(arm: Arm, number: int, times: Array) -> tuple[Array, Array, Array]:
    """Return the motion on the inner side of a joint where that is a prescribed base, zero elsewhere."""
    angle, rate, acceleration = arm.base_motion(times)
    on_base = float(arm.inner[number - 1] < 0)
    return on_base * angle, on_base * rate, on_base * acceleration


def _energy(arm: Arm, which: str, times: Array, q: Array, v: Array, a: Array) -> Array:
    """Return an energy that depends on the present state alone, (k,), J."""
    if which == "kinetic":
        return kinetic_energy(arm, times, q, v, base_place(arm, 1, times, q, v, a))
    if which == "elastic":
        return elastic_energy(arm, times, q)
    return gravitational_energy(arm, q, base_place(arm, 0, times, q, v, a))


def _torque(arm: Arm, output: Output, times: Array, q: Array, v: Array, a: Array) -> Array:
    """Return a joint's torque, positive when bent upward; at the tip, that the tip's inertia exerts."""
    if output.at == "tip":
        assert arm.scene.tip is not None
        outside = sum(
            (
                np.broadcast_to(arm.signal(i.name).at(times), times.shape)
                for i in arm.scene.inputs
                if i.acts == "torque" and station_of(i.at, arm.scene.stations) == arm.scene.stations
            ),
            np.zeros(len(times)),
        )
        return np.asarray(outside - arm.scene.tip.inertia * a[:, -1])
    number = max(station_of(output.at, arm.scene.stations), 1)
    joint, (angle, rate, _) = arm.scene.joints[number - 1], _ground(arm, number, times)
    bent, bent_rate = arm.bent(q)[:, number - 1] - angle, arm.bent(v)[:, number - 1] - rate
    return joint.stiffness * bent + joint.damping * bent_rate


def _through(arm: Arm, number: int, times: Array, q: Array, v: Array, a: Array) -> Array:
    """Return the torque of a joint's inner side on the outer one: motor, spring, damper, less what its rotor takes."""
    joint = arm.scene.joints[number - 1]
    bent = arm.strained(times, q)[:, number - 1]
    _, rate, acceleration = _ground(arm, number, times)
    bent_rate = arm.bent(v)[:, number - 1] - rate
    drive = sum(
        (
            joint.gear * np.broadcast_to(arm.signal(i.name).at(times), times.shape)
            for i in arm.scene.inputs
            if i.acts == "drive" and i.at == number
        ),
        np.zeros(len(times)),
    )
    rotor = arm.rotors[number - 1] * (arm.bent(a)[:, number - 1] - acceleration)
    return np.asarray(drive - rotor - joint.stiffness * bent - joint.damping * bent_rate)


def _force(arm: Arm, joint: int, times: Array, q: Array, v: Array, a: Array) -> tuple[Array, Array]:
    """Return the force on everything beyond a joint: its change of momentum, less weight and loads."""
    _, load_x, load_y = arm.loads(times)
    x, y = np.zeros((2, len(times)))
    place = min(joint, arm.scene.stations) - 1 + arm.first
    beyond = arm.paths[:, place] > 0.0
    bodies = np.append(beyond[arm.first :], beyond[-1])
    if joint > arm.scene.stations:
        bodies[:-1] = False
    base_x, base_y = base_place(arm, 2, times, q, v, a)
    for body in np.flatnonzero(bodies):
        ax, ay = arm.point(2, arm.levers[body], q, v, a)
        x, y = x + arm.masses[body] * (ax + base_x), y + arm.masses[body] * (ay + base_y + arm.gravity)
    return x - load_x[:, beyond].sum(axis=1), y - load_y[:, beyond].sum(axis=1)


def dissipated(arm: Arm, trajectory: Trajectory, times: Array) -> Array:
    """Return the energy turned to heat since the start, (k,), J, by Gauss quadrature between steps and instants."""
    inside = trajectory.ends[trajectory.ends < times[-1]]
    ends = np.unique(np.concatenate([[0.0], inside, times]))
    nodes, weights = np.polynomial.legendre.leggauss(_NODES)
    half = 0.5 * np.diff(ends)
    instants = (ends[:-1] + half)[:, None] + half[:, None] * nodes
    _, rate, _ = trajectory.at(instants.ravel())
    power = dissipation(arm, instants.ravel(), rate).reshape(instants.shape)
    heat = np.concatenate([[0.0], np.cumsum(half * (power @ weights))])
    return np.asarray(heat[np.searchsorted(ends, times)], np.float64)
