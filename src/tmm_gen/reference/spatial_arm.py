"""The equations of an arm in space by geometric Jacobians in world axes: nothing here comes from `derive` or `program`.

With ``J_b`` the Jacobian of a body's velocity, taken at its centre of mass, and of its angular velocity,

    M(q) = sum_b J_b^T diag(m_b, R_b I_b R_b^T) J_b + rotors
    M q'' + sum_b J_b^T [m_b (J_b' q' - g); I J_b' q' + w_b x I w_b] + springs + dampers = loads,

``I = R_b I_b R_b^T``. Everything but ``M`` is found as forces and moments of the bodies about the base, summed over
what is beyond a joint and projected on its axis, which is the product with the Jacobians' transposes.

A rotor has the kinetic energy ``1/2 J_a q'^2`` and no momentum besides, as where its gear ratio is high.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tmm_gen.reference.spatial_given import moved
from tmm_gen.reference.spatial_places import Places, Tree, Values, applied, cross
from tmm_gen.scene.signal import ACCELERATION
from tmm_gen.scene.spatial.arm import ArmInput, SpatialArm

Array = NDArray[np.float64]
Inputs = Mapping[str, ArrayLike]
"""Values of inputs by column, each of the shape of the instants; those not given are zero. How a base is moved along is
there with ``_rate`` and ``_acceleration``: see :func:`tmm_gen.reference.spatial_given.given`."""

_STEP = 1e-40
"""Imaginary part of a complex step: its square is lost beside any number, so the derivative has no other error."""


@dataclass(frozen=True, eq=False)
class WorldArm:
    """The equations of an arm; arguments ``q``, ``v``, ``a`` are ``(..., n)``, in rad, rad/s, rad/s^2.

    Parameters
    ----------
    arm : SpatialArm
    """

    arm: SpatialArm

    @cached_property
    def tree(self) -> Tree:
        """Where its bodies are and how they move."""
        return Tree(self.arm)

    @cached_property
    def masses(self) -> Array:
        """Masses of the bodies, (n,), kg."""
        return np.array([joint.body.mass for joint in self.arm.joints])

    @cached_property
    def _centers(self) -> Array:
        return np.array([joint.body.center for joint in self.arm.joints])

    @cached_property
    def _inertias(self) -> Array:
        """In the axes of the bodies, (n, 3, 3)."""
        found = []
        for joint in self.arm.joints:
            xx, yy, zz, xy, xz, yz = joint.body.inertia
            found.append([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        return np.array(found)

    @cached_property
    def gravity(self) -> Array:
        """In world axes, (3,), m/s^2."""
        return np.array(self.arm.gravity)

    @cached_property
    def stiffness(self) -> Array:
        """Of the joints' springs, (n,), N m/rad."""
        return np.array([joint.stiffness for joint in self.arm.joints])

    @cached_property
    def damping(self) -> Array:
        """Of the joints' dampers, (n,), N m s/rad."""
        return np.array([joint.damping for joint in self.arm.joints])

    @cached_property
    def rotors(self) -> Array:
        """Inertias of rotors seen at the joints, (n,), kg m^2."""
        return np.array([joint.armature for joint in self.arm.joints])

    @cached_property
    def rest(self) -> Array:
        """Angles at which the springs are slack, (n,), rad."""
        return np.array([joint.rest for joint in self.arm.joints])

    def centers(self, places: Places) -> tuple[Values, Values]:
        """Return the bodies' centres of mass and the way there from their joints, (..., n, 3) each, m."""
        way = applied(places.turn, self._centers)
        return places.point + way, way

    def inertias(self, places: Places) -> Values:
        """Return the inertias about the centres of mass, in world axes, (..., n, 3, 3), kg m^2."""
        turned: Values = places.turn @ self._inertias @ np.swapaxes(places.turn, -1, -2)
        return turned

    def jacobians(self, places: Places) -> tuple[Values, Values]:
        """Return those of the centres of mass and of the angular velocities, (..., n, 3, n) each, by body and joint."""
        center, _ = self.centers(places)
        lever = center[..., :, None, :] - places.point[..., None, :, :]
        on_way = self.tree.ways[..., None]
        axis = places.axis[..., None, :, :]
        moving = np.swapaxes(cross(axis, lever) * on_way, -1, -2)
        return moving, np.swapaxes(axis * on_way, -1, -2)

    def mass_matrix(self, q: Values) -> Values:
        """Return the mass matrix, (..., n, n), kg m^2."""
        return self._mass(self.tree.places(q))

    def _mass(self, places: Places) -> Values:
        moving, turning = self.jacobians(places)
        n = moving.shape[-1]
        flat = (*moving.shape[:-3], 3 * n, n)
        weighted = (self.masses[:, None, None] * moving).reshape(flat)
        turned = (self.inertias(places) @ turning).reshape(flat)
        found: Values = (
            np.swapaxes(moving.reshape(flat), -1, -2) @ weighted
            + np.swapaxes(turning.reshape(flat), -1, -2) @ turned
            + np.diag(self.rotors)
        )
        return found

    def inverse_dynamics(self, q: Values, v: Values, a: Values, inputs: Inputs) -> Values:
        """Return the torque that each joint lacks for a motion, with springs, dampers and inputs acting, (..., n), N m.

        Parameters
        ----------
        q, v, a : array, (..., n)
            Motion.
        inputs : mapping from str to array_like
            Values by column, scalar or ``(...)``; those not given are zero.
        """
        return self._lacking(self.tree.places(q), q, v, a, inputs)

    def _lacking(self, places: Places, q: Values, v: Values, a: Values, inputs: Inputs) -> Values:
        motions = self.tree.motions(places, v, a)
        center, way = self.centers(places)
        pull = motions.carried(way)[1]
        inertia = self.inertias(places)
        carried = moved(self.arm, inputs, ACCELERATION)
        fall = self.gravity if carried is None else self.gravity - carried[..., None, :]
        force = self.masses[:, None] * (pull - fall)
        moment = applied(inertia, motions.spinning) + cross(motions.spin, applied(inertia, motions.spin))
        moment = moment + cross(center, force)  # from here on about the base
        outer_force, outer_moment = self.loads(places, inputs)
        beyond = self.tree.ways.T
        force, moment = beyond @ (force - outer_force), beyond @ (moment - outer_moment)
        turning = (places.axis * (moment - cross(places.point, force))).sum(axis=-1)
        lacking: Values = turning + self.rotors * a - self.torque(q, v, inputs)
        return lacking

    def base_force(self, q: Values, v: Values, a: Values, inputs: Inputs) -> Values:
        """Return the force that the base exerts on the arm, (..., 3), N: what bodies take, less what acts on them."""
        places = self.tree.places(q)
        pull = self.tree.motions(places, v, a).carried(self.centers(places)[1])[1]
        carried = moved(self.arm, inputs, ACCELERATION)
        fall = self.gravity if carried is None else self.gravity - carried[..., None, :]
        taken = self.masses[:, None] * (pull - fall) - self.loads(places, inputs)[0]
        found: Values = taken.sum(axis=-2)
        return found

    def torque(self, q: Values, v: Values, inputs: Inputs) -> Values:
        """Return what each joint passes on to its body: spring, damper and motor, (..., n), N m."""
        driven = np.zeros(len(self.arm.joints))
        found: Values = -self.stiffness * (q - self.rest) - self.damping * v
        for item in self.arm.inputs:
            if item.acts == "torque" and item.name in inputs:
                where, gear = driven.copy(), self.arm.joints[item.joint - 1].gear
                where[item.joint - 1] = gear
                found = found + np.asarray(inputs[item.name])[..., None] * where
        return found

    def forward_dynamics(self, q: Array, v: Array, inputs: Inputs) -> Array:
        """Return the accelerations, (..., n), rad/s^2."""
        places = self.tree.places(q)
        lacking = self._lacking(places, q, v, np.zeros_like(q), inputs)
        found: Array = np.linalg.solve(self._mass(places), -lacking[..., None])[..., 0]
        return found

    def tangents(self, q: Array, v: Array, a: Array, inputs: Inputs) -> tuple[Array, Array]:
        """Return the derivatives of `inverse_dynamics` by angles and by rates, (..., n, n) each, to rounding.

        Inputs must be scalars, or ``(k,)`` with ``q`` of ``(k, n)``.
        """
        return complex_slopes(self.inverse_dynamics, q, v, a, inputs)

    def loads(self, places: Places, inputs: Inputs) -> tuple[Values, Values]:
        """Return the forces of inputs on each body and their moments about the base, (..., n, 3) each, N and N m."""
        force = np.zeros_like(places.point)
        moment = np.zeros_like(places.point)
        for item in self.arm.inputs:
            if item.frame is None or not item.frame.joint:  # what acts on the base moves nothing
                continue
            given = components(item, inputs)
            if given is None:
                continue
            axes, point = places.frame(item.frame)
            vector = applied(axes, given) if item.axes == "body" else given
            body = item.frame.joint - 1
            if item.acts == "force":
                force[..., body, :] += vector
                moment[..., body, :] += cross(point, np.broadcast_to(vector, point.shape))
            else:
                moment[..., body, :] += vector
        return force, moment


def complex_slopes(
    lacking: Callable[[Values, Values, Values, Inputs], Values], q: Array, v: Array, a: Array, inputs: Inputs
) -> tuple[Array, Array]:
    """Return the derivatives of what is lacking by coordinates and by rates; see `WorldArm.tangents`."""
    n = q.shape[-1]
    small = 1j * _STEP * np.eye(n)
    spread = {name: np.asarray(value)[..., None] for name, value in inputs.items()}
    q, v, a = q[..., None, :], v[..., None, :], a[..., None, :]
    by_q = lacking(q + small, v, a, spread).imag / _STEP
    by_v = lacking(q, v + small, a, spread).imag / _STEP
    return np.swapaxes(by_q, -1, -2), np.swapaxes(by_v, -1, -2)


def components(item: ArmInput, inputs: Inputs) -> Values | None:
    """Return the components of a force or moment, (..., 3); None where none is given."""
    if not any(column in inputs for column in item.columns):
        return None
    return np.stack(np.broadcast_arrays(*(inputs.get(column, 0.0) for column in item.columns)), axis=-1)
