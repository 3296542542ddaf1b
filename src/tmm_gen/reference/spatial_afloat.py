"""The equations of an arm in space whose base moves: those of the arm on a base that rests, carried along.

Relative to the base all bodies move as :mod:`tmm_gen.reference.spatial_places` has it. What carries them has a place
``p``, axes ``R`` and angular velocity ``W``, all in world axes, and with it (Coriolis)

    x' = p' + W x (x - p) + (x')_rel,    x'' = p'' + W' x (x - p) + W x (W x (x - p)) + 2 W x (x')_rel + (x'')_rel.

Coordinates are the place, the four numbers of a quaternion ``r`` of the axes, and the joints' angles: ``W`` is the
vector of ``2 r' r*``, and ``r r = 1`` is asked for by its second derivative. No point of that is singular.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.reference.spatial_arm import Inputs, WorldArm, complex_slopes, components
from tmm_gen.reference.spatial_places import Motions, Places, Values, applied, cross
from tmm_gen.reference.spatial_turns import conjugate, product, quaternion, turned
from tmm_gen.scene.spatial.arm import FreeBase, RigidBody, SpatialArm

Array = NDArray[np.float64]

BASE = 7
"""Coordinates of the base: place and quaternion, w first."""


@dataclass(frozen=True, eq=False)
class Carrier:
    """How a base moves, in world axes.

    Parameters
    ----------
    place, velocity, acceleration : array, (..., 3)
        m, m/s, m/s^2.
    axes : array, (..., 3, 3)
        By columns.
    spin, spinning : array, (..., 3)
        rad/s, rad/s^2.
    """

    place: Values
    velocity: Values
    acceleration: Values
    axes: Values
    spin: Values
    spinning: Values

    def places(self, relative: Places) -> Places:
        """Return where joints are that are there relative to the base."""
        axes = self.axes[..., None, :, :]
        return Places(
            axes @ relative.turn,
            self.place[..., None, :] + applied(axes, relative.point),
            applied(axes, relative.axis),
        )

    def motions(self, places: Places, relative: Motions) -> Motions:
        """Return how bodies move that move so relative to the base; both in world axes."""
        lever = places.point - self.place[..., None, :]
        spin, spinning = self.spin[..., None, :], self.spinning[..., None, :]
        carried = cross(spin, lever)
        return Motions(
            spin=spin + relative.spin,
            spinning=spinning + relative.spinning + cross(spin, relative.spin),
            speed=self.velocity[..., None, :] + carried + relative.speed,
            pull=self.acceleration[..., None, :]
            + cross(spinning, lever)
            + cross(spin, carried)
            + 2.0 * cross(spin, relative.speed)
            + relative.pull,
        )


@dataclass(frozen=True, eq=False)
class AfloatArm:
    """The equations of an arm on a base that floats.

    Arguments ``y``, ``u``, ``b`` are ``(..., 7 + n)``: place and quaternion of the base and angles, and their first and
    second derivatives.

    Parameters
    ----------
    arm : SpatialArm
        Whose base is free.
    """

    arm: SpatialArm

    @cached_property
    def resting(self) -> WorldArm:
        """The arm as if its base were at rest in the origin."""
        return WorldArm(self.arm)

    @property
    def base(self) -> FreeBase:
        """What floats."""
        assert isinstance(self.arm.base, FreeBase)
        return self.arm.base

    def carrier(self, y: Values, u: Values, b: Values) -> Carrier:
        """Return how the base moves."""
        r, rate, curve = y[..., 3:BASE], u[..., 3:BASE], b[..., 3:BASE]
        square = np.sum(r * r, axis=-1, keepdims=True)
        inverse = conjugate(r) / square
        spin = 2.0 * product(rate, inverse)[..., 1:]
        # what the change of the length makes of it is in both terms alike
        spinning = 2.0 * product(curve, inverse)[..., 1:]
        along = np.sum(r * rate, axis=-1, keepdims=True) / square
        spinning = spinning - 2.0 * along * spin
        return Carrier(y[..., :3], u[..., :3], b[..., :3], turned(r / np.sqrt(square)), spin, spinning)

    def places(self, y: Values) -> Places:
        """Return where the joints are."""
        return self.carrier(y, 0.0 * y, 0.0 * y).places(self.resting.tree.places(y[..., BASE:]))

    def moving(self, y: Values, u: Values, b: Values) -> tuple[Carrier, Places, Motions]:
        """Return how the base moves, where the joints are, and how the bodies move."""
        carrier = self.carrier(y, u, b)
        places = carrier.places(self.resting.tree.places(y[..., BASE:]))
        # relative motion by places seen from the base's origin, in world axes
        seen = replace(places, point=places.point - carrier.place[..., None, :])
        relative = self.resting.tree.motions(seen, u[..., BASE:], b[..., BASE:])
        return carrier, places, carrier.motions(places, relative)

    def inverse_dynamics(self, y: Values, u: Values, b: Values, inputs: Inputs) -> Values:
        """Return what each coordinate lacks, (..., 7 + n): force, moment about the base, length, torques.

        Forces in N and moments in N m are in world axes; inputs as of :meth:`WorldArm.inverse_dynamics`.
        """
        world, q, v, a = self.resting, y[..., BASE:], u[..., BASE:], b[..., BASE:]
        carrier, places, motions = self.moving(y, u, b)
        center, way = world.centers(places)
        pull = motions.carried(way)[1]
        inertia = world.inertias(places)
        force = world.masses[:, None] * (pull - world.gravity)
        moment = applied(inertia, motions.spinning) + cross(motions.spin, applied(inertia, motions.spin))
        moment = moment + cross(center, force)  # from here on about the world's origin
        outer_force, outer_moment = world.loads(places, inputs)
        force, moment = force - outer_force, moment - outer_moment
        own_force, own_moment = self._own(carrier, inputs)
        whole_force = own_force + force.sum(axis=-2)
        whole_moment = own_moment + moment.sum(axis=-2) - cross(carrier.place, whole_force)
        beyond = world.tree.ways.T
        force, moment = beyond @ force, beyond @ moment
        turning = (places.axis * (moment - cross(places.point, force))).sum(axis=-1)
        lacking = turning + world.rotors * a - world.torque(q, v, inputs)
        r, rate, curve = y[..., 3:BASE], u[..., 3:BASE], b[..., 3:BASE]
        length = np.sum(r * curve + rate * rate, axis=-1, keepdims=True)
        found: Values = np.concatenate([whole_force, whole_moment, length, lacking], axis=-1)
        return found

    def _own(self, carrier: Carrier, inputs: Inputs) -> tuple[Values, Values]:
        """Return force and moment about the world's origin that the base's own body takes, less what acts on it."""
        body = self.base.body
        way = carrier.axes @ np.array(body.center)
        inertia = carrier.axes @ inertia_matrix(body) @ np.swapaxes(carrier.axes, -1, -2)
        spin, spinning = carrier.spin, carrier.spinning
        pull = carrier.acceleration + cross(spinning, way) + cross(spin, cross(spin, way))
        force = body.mass * (pull - self.resting.gravity)
        moment = applied(inertia, spinning) + cross(spin, applied(inertia, spin))
        moment = moment + cross(carrier.place + way, force)
        for item in self.arm.inputs:
            if item.frame is None or item.frame.joint:
                continue
            given = components(item, inputs)
            if given is None:
                continue
            axes = carrier.axes @ np.array(item.frame.turn)
            vector = applied(axes, given) if item.axes == "body" else given
            if item.acts == "force":
                point = carrier.place + carrier.axes @ np.array(item.frame.at)
                force, moment = force - vector, moment - cross(point, np.broadcast_to(vector, point.shape))
            else:
                moment = moment - vector
        return force, moment

    def mass_matrix(self, y: Values, u: Values, inputs: Inputs) -> Values:
        """Return the derivatives of `inverse_dynamics` by second derivatives, (..., 7 + n, 7 + n)."""
        n = y.shape[-1]
        y, u = y[..., None, :], u[..., None, :]
        spread = {name: np.asarray(value)[..., None] for name, value in inputs.items()}
        none = self.inverse_dynamics(y, u, np.zeros(n), spread)
        each = self.inverse_dynamics(
            np.broadcast_to(y, (*y.shape[:-2], n, n)),
            np.broadcast_to(u, (*u.shape[:-2], n, n)),
            np.eye(n),
            spread,
        )
        found: Values = np.swapaxes(each - none, -1, -2)
        return found

    def whole_mass(self, y: Array) -> Array:
        """Return the mass matrix by the base's velocity and angular velocity and the rates, (6 + n, 6 + n)."""
        n = len(self.arm.joints)
        by_twist = np.zeros((BASE + n, 6 + n))
        by_twist[:3, :3], by_twist[BASE:, 6:] = np.eye(3), np.eye(n)
        turns = np.concatenate([np.zeros((3, 1)), np.eye(3)], axis=1)
        by_twist[3:BASE, 3:6] = 0.5 * product(turns, np.broadcast_to(y[3:BASE], (3, 4))).T
        found = self.mass_matrix(y, np.zeros_like(y), {}) @ by_twist
        return np.asarray(np.delete(found, 6, axis=0))

    def joint_mass(self, y: Array) -> Array:
        """Return the mass matrix of the joints where nothing holds the base, (n, n), kg m^2."""
        whole = self.whole_mass(y)
        return np.asarray(whole[6:, 6:] - whole[6:, :6] @ np.linalg.solve(whole[:6, :6], whole[:6, 6:]))

    def forward_dynamics(self, y: Array, u: Array, inputs: Inputs) -> Array:
        """Return the second derivatives, (..., 7 + n)."""
        lacking = self.inverse_dynamics(y, u, np.zeros_like(y), inputs)
        found: Array = np.linalg.solve(self.mass_matrix(y, u, inputs), -lacking[..., None])[..., 0]
        return found

    def tangents(self, y: Array, u: Array, b: Array, inputs: Inputs) -> tuple[Array, Array]:
        """Return the derivatives of `inverse_dynamics` by coordinates and by their rates; see `WorldArm.tangents`."""
        return complex_slopes(self.inverse_dynamics, y, u, b, inputs)

    def start(self) -> tuple[Array, Array]:
        """Return coordinates and their rates at the start, (7 + n,) each."""
        base, joints = self.base, self.arm.joints
        r = quaternion(base.turn)
        rate = 0.5 * product(r, np.array([0.0, *base.rate]))
        y = np.array([*base.at, *r, *(joint.angle for joint in joints)])
        return y, np.array([*base.velocity, *rate, *(joint.rate for joint in joints)])

    def momentum(self, y: Array, u: Array) -> tuple[Array, Array]:
        """Return linear and angular momentum about the world's origin, (..., 3) each, kg m/s and kg m^2/s."""
        world, body = self.resting, self.base.body
        carrier, places, motions = self.moving(y, u, np.zeros_like(u))
        center, way = world.centers(places)
        linear = world.masses[:, None] * motions.carried(way)[0]
        angular = applied(world.inertias(places), motions.spin) + cross(center, linear)
        own_way = carrier.axes @ np.array(body.center)
        own = body.mass * (carrier.velocity + cross(carrier.spin, own_way))
        inertia = carrier.axes @ inertia_matrix(body) @ np.swapaxes(carrier.axes, -1, -2)
        spin = applied(inertia, carrier.spin) + cross(carrier.place + own_way, own)
        return own + linear.sum(axis=-2), spin + angular.sum(axis=-2)

    def kinetic_energy(self, y: Array, u: Array) -> Array:
        """Return the kinetic energy of bodies and rotors, (...), J."""
        world, body = self.resting, self.base.body
        carrier, places, motions = self.moving(y, u, np.zeros_like(u))
        _, way = world.centers(places)
        speed = motions.carried(way)[0]
        turning = applied(world.inertias(places), motions.spin)
        own = carrier.velocity + cross(carrier.spin, carrier.axes @ np.array(body.center))
        inertia = carrier.axes @ inertia_matrix(body) @ np.swapaxes(carrier.axes, -1, -2)
        twice = (
            np.sum(world.masses[:, None] * speed**2, axis=(-1, -2))
            + np.sum(turning * motions.spin, axis=(-1, -2))
            + body.mass * np.sum(own**2, axis=-1)
            + np.sum(applied(inertia, carrier.spin) * carrier.spin, axis=-1)
            + np.sum(world.rotors * u[..., BASE:] ** 2, axis=-1)
        )
        return np.asarray(0.5 * twice)

    def gravitational_energy(self, y: Array) -> Array:
        """Return the energy of weight, (...), J: zero where all mass is at the height of the world's origin."""
        world, body = self.resting, self.base.body
        carrier = self.carrier(y, 0.0 * y, 0.0 * y)
        center, _ = world.centers(carrier.places(world.tree.places(y[..., BASE:])))
        own = carrier.place + carrier.axes @ np.array(body.center)
        return np.asarray(-((center @ world.gravity) @ world.masses + body.mass * (own @ world.gravity)))


def joint_mass(arm: SpatialArm) -> Array:
    """Return the mass matrix of an arm's joints where it starts, (n, n), kg m^2, whatever it stands on."""
    if arm.base is not None:
        afloat = AfloatArm(arm)
        return afloat.joint_mass(afloat.start()[0])
    return np.asarray(WorldArm(arm).mass_matrix(np.array([joint.angle for joint in arm.joints])))


def inertia_matrix(body: RigidBody) -> Array:
    """Return a body's inertia about its centre of mass, (3, 3), kg m^2."""
    xx, yy, zz, xy, xz, yz = body.inertia
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
