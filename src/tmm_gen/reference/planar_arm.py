"""Lagrange's equations of a planar arm, written down on their own: nothing here comes from `derive` or `program`.

The coordinates are the absolute angles of hub and links; with the place of each mass a sum of
``l_j (cos q_j, sin q_j)``, the equations are

    sum_k B_jk (cos(q_j - q_k) q_k'' + sin(q_j - q_k) q_k'^2) + J_j q_j'' + g b_j cos q_j
        + rotors + springs + dampers = loads

with ``B_jk`` the masses times the lever arms they have in ``j`` and in ``k``, and ``b_j`` the first moments. A rotor
between two links has the kinetic energy ``1/2 J_a (q_j' - q_i')^2``. No forces between links occur.

Where the base floats, the centre of mass moves as all forces together push it, and the arm turns about it:
``B_jk - b_j b_k / M`` stands in place of ``B_jk``, ``M`` the whole mass, and gravity turns nothing
(:mod:`tmm_gen.reference.floating` says where the base is).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.inputs.signals import Constant, Signal
from tmm_gen.reference.collocation import Trajectory, integrate
from tmm_gen.scene import Scene, station_of
from tmm_gen.scene.model import FloatingBase

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Arm:
    """Lagrange's equations of a scene; index 0 is the hub where the base is a motor.

    Parameters
    ----------
    scene : Scene
        Of kind "planar".
    signals : mapping from str to Signal
        Inputs by name; those not given are zero.
    """

    scene: Scene
    signals: Mapping[str, Signal]

    @property
    def first(self) -> int:
        """Place of link 1 among the coordinates."""
        return self.scene.hub

    @cached_property
    def lengths(self) -> Array:
        """Lengths by coordinate, (n,); the hub's is zero."""
        return np.array([0.0] * self.first + [link.length for link in self.scene.links])

    @cached_property
    def masses(self) -> Array:
        """Masses of the links and of the body at the tip, (bodies,), kg."""
        tip = self.scene.tip
        return np.array([link.mass for link in self.scene.links] + [tip.mass if tip else 0.0])

    @cached_property
    def moments(self) -> Array:
        """First moments ``b``, (n,), kg m."""
        return self.gathered(self.masses)

    @cached_property
    def whole(self) -> float:
        """Mass of the arm and its base where that floats, kg; infinite where something holds it."""
        base = self.scene.base
        return float(self.masses.sum()) + base.mass if isinstance(base, FloatingBase) else math.inf

    @cached_property
    def inertias(self) -> Array:
        """Inertias about the own centres, (n,), kg m^2; the tip's turns with the last link."""
        tip = self.scene.tip
        own = [self.scene.base.inertia] * self.first + [link.inertia for link in self.scene.links]
        own[-1] += tip.inertia if tip else 0.0
        return np.array(own)

    @property
    def gravity(self) -> float:
        """Along -y, m/s^2."""
        return self.scene.model.gravity or 0.0

    @property
    def weight(self) -> float:
        """What of it the joints feel, m/s^2: nothing where the arm falls freely."""
        return 0.0 if self.scene.floats else self.gravity

    # -- what hangs on what ------------------------------------------------------------------------------------

    @cached_property
    def inner(self) -> NDArray[np.int_]:
        """Coordinate on the inner side of each joint, (joints,); -1 where that is no coordinate but the base."""
        return np.array([self.scene.host(j + 1) - 1 + self.first for j in range(self.scene.stations)])

    @cached_property
    def paths(self) -> Array:
        """Whether a coordinate (column) lies between the base and another (row), itself included, (n, n)."""
        found = np.eye(len(self.lengths))
        for joint, inner in enumerate(self.inner):
            if inner >= 0:
                found[joint + self.first] += found[inner]
        return found

    def along(self, x: Array) -> Array:
        """Sum values from the base to each coordinate, (..., n)."""
        return x @ self.paths.T if self.scene.hosts else np.cumsum(x, axis=-1)

    def beyond(self, x: Array) -> Array:
        """Sum values of each coordinate and all that it carries, (..., n)."""
        return x @ self.paths if self.scene.hosts else np.cumsum(x[..., ::-1], axis=-1)[..., ::-1]

    # -- sums over the arm, each as long as the arm ------------------------------------------------------------

    @cached_property
    def _centers(self) -> Array:
        """How far the centres of mass stand off along their own links, (n,); the hub has none."""
        return np.array([0.0] * self.first + [link.center * link.length for link in self.scene.links])

    def walked(self, x: Array) -> Array:
        """Sum lever arms times values from the base to each body, (..., n) to (..., bodies); the tip is last."""
        ends = self.along(self.lengths * x)
        found = np.empty((*x.shape[:-1], x.shape[-1] + 1 - self.first))
        found[..., :-1] = (ends - self.lengths * x + self._centers * x)[..., self.first :]
        found[..., -1] = ends[..., -1]
        return found

    def gathered(self, forces: Array) -> Array:
        """Sum forces on the bodies times their lever arms in each link, (..., bodies) to (..., n)."""
        links = np.zeros((*forces.shape[:-1], len(self.lengths)))
        links[..., self.first :] = forces[..., :-1]
        at_ends = np.zeros_like(links)
        at_ends[..., -1] = forces[..., -1]
        return self.lengths * (self.beyond(links + at_ends) - links) + self._centers * links

    @cached_property
    def rotors(self) -> Array:
        """Inertias of motors at their joints, ``gear^2`` times their own, (joints,), kg m^2."""
        return np.array([j.gear**2 * j.rotor_inertia for j in self.scene.joints])

    @cached_property
    def slack(self) -> Array:
        """Angles at which the springs of the joints are slack, (joints,), rad."""
        return np.array([j.rest for j in self.scene.joints])

    @cached_property
    def joints(self) -> tuple[Array, Array]:
        """Stiffness and damping of the joints, (joints,) each; joint 1 is at the base."""
        joints = self.scene.joints
        return np.array([j.stiffness for j in joints]), np.array([j.damping for j in joints])

    def bent(self, x: Array) -> Array:
        """Return differences across the joints, (..., n) to (..., joints); a base that is no coordinate is zero."""
        padded = np.concatenate([x, np.zeros((*x.shape[:-1], 1))], axis=-1)  # the base comes last, at -1
        return np.asarray(x[..., self.first :] - padded[..., self.inner])

    def _pulled(self, torques: Array) -> Array:
        """Return what torques in the joints do to the coordinates, (..., joints) to (..., n)."""
        found = np.zeros((*torques.shape[:-1], len(self.lengths) + 1))  # the base comes last, at -1
        found[..., self.first : -1] += torques
        for joint, inner in enumerate(self.inner):
            found[..., inner] -= torques[..., joint]
        return found[..., :-1]

    def spring_torques(self, q: Array) -> Array:
        """Return what springs exert against angles, (..., n), N m."""
        return self._pulled(self.joints[0] * self.bent(q))

    def damper_torques(self, v: Array) -> Array:
        """Return what dampers of joints and hub exert against rates, (..., n), N m."""
        found = self._pulled(self.joints[1] * self.bent(v))
        if self.first:
            found[..., 0] += self.scene.base.damping * v[..., 0]
        return found

    def rotor_torques(self, a: Array) -> Array:
        """Return what it takes to turn the motors' rotors, (..., n), N m."""
        return self._pulled(self.rotors * self.bent(a))

    def strained(self, times: Array, q: Array) -> Array:
        """Return what the springs of the joints are wound up by, (k, joints), rad."""
        found = self.bent(q) - self.slack
        found[:, self.inner < 0] -= self.base_motion(times)[0][:, None]
        return found

    # -- the same as matrices ----------------------------------------------------------------------------------

    @cached_property
    def levers(self) -> Array:
        """Lever arms, (bodies, n): how far each centre of mass stands off along each link; the tip mass last."""
        return self.walked(np.eye(len(self.lengths))).T

    @cached_property
    def coupling(self) -> Array:
        """``B``, (n, n), kg m^2."""
        about_base = (self.levers.T * self.masses) @ self.levers
        return about_base - np.outer(self.moments, self.moments) / self.whole

    @cached_property
    def springs(self) -> tuple[Array, Array]:
        """Stiffness and damping matrices of joints and hub bearing, (n, n)."""
        unit = np.eye(len(self.lengths))
        return self.spring_torques(unit), self.damper_torques(unit)

    @cached_property
    def mass(self) -> Array:
        """Mass matrix of the straight arm, (n, n), kg m^2."""
        return self.coupling + self.own_inertias

    @cached_property
    def own_inertias(self) -> Array:
        """What does not depend on angles: inertias about own centres, and rotors, (n, n), kg m^2."""
        found = np.diag(self.inertias)
        return found + self.rotor_torques(np.eye(len(found))) if self.rotors.any() else found

    # -- loads --------------------------------------------------------------------------------------------------

    def signal(self, name: str) -> Signal:
        """Return an input over time."""
        return self.signals.get(name, Constant(0.0))

    def loads(self, times: Array) -> tuple[Array, Array, Array]:
        """Return torques on the coordinates and forces along x and y at the outer ends, (k, n) each."""
        torque, along_x, along_y = np.zeros((3, len(times), len(self.lengths)))
        for item in self.scene.inputs:
            values = np.broadcast_to(self.signal(item.name).at(times), times.shape)
            place = station_of(item.at, self.scene.stations) - 1 + self.first
            if item.acts == "angle":  # through the springs and the dampers of joints on the base
                rate = self.signal(item.name).slope(times)
                for on_base in np.flatnonzero(self.inner < 0):
                    joint = self.scene.joints[on_base]
                    torque[:, on_base] += joint.stiffness * values + joint.damping * rate
            elif item.acts == "drive":  # between both sides of the joint
                geared = self.scene.joints[place - self.first].gear * values
                torque[:, place] += geared
                on = int(self.inner[place - self.first])
                if on >= 0:
                    torque[:, on] -= geared
            else:
                {"torque": torque, "force_x": along_x, "force_y": along_y}[item.acts][:, place] += values
        return torque, along_x, along_y

    def base_motion(self, times: Array) -> tuple[Array, Array]:
        """Return angle and rate of a prescribed base, zero for a clamp, (k,) each."""
        angle, rate = np.zeros((2, len(times)))
        for item in self.scene.inputs:
            if item.acts == "angle":
                angle += self.signal(item.name).at(times)
                rate += self.signal(item.name).slope(times)
        return angle, rate

    # -- equations ----------------------------------------------------------------------------------------------

    def residual(self, times: Array, q: Array, v: Array, a: Array) -> Array:
        """Return what is left of Lagrange's equations, (k, n), N m."""
        torque, force_x, force_y = self.loads(times)
        s, c = np.sin(q), np.cos(q)
        # cos(qj - qk) ak + sin(qj - qk) vk^2, summed over k with B, from the accelerations of the bodies
        along = self._carried(c * a - s * v**2)
        across = self._carried(s * a + c * v**2)
        inertial = c * along + s * across + self.inertias * a
        weight = self.weight * self.moments * c
        moment_x, moment_y = self._moment(force_x), self._moment(force_y)
        pushed = c * moment_y - s * moment_x
        joints = self.spring_torques(q) + self.damper_torques(v)
        if self.rotors.any():
            joints = joints + self.rotor_torques(a)
        if self.slack.any():
            joints = joints - self._pulled(self.joints[0] * self.slack)
        return inertial + weight + joints - torque - pushed

    def _carried(self, x: Array) -> Array:
        """Return ``B`` times values, (k, n)."""
        found = self.gathered(self.masses * self.walked(x))
        return found - np.outer(x @ self.moments, self.moments) / self.whole

    def _moment(self, force: Array) -> Array:
        """Return lever arms times the forces beyond each link, (k, n); of an arm that floats about its centre."""
        found = self.lengths * self.beyond(force)
        return found - np.outer(force.sum(axis=1), self.moments) / self.whole

    def slopes(self, times: Array, q: Array, v: Array, a: Array) -> tuple[Array, Array, Array]:
        """Return the derivatives of the residual by angles, rates and accelerations, (k, n, n) each."""
        stiffness, damping = self.springs
        _, force_x, force_y = self.loads(times)
        apart = q[:, :, None] - q[:, None, :]
        cosine, sine = self.coupling * np.cos(apart), self.coupling * np.sin(apart)
        pull = sine * a[:, None, :] - cosine * v[:, None, :] ** 2
        diagonal = np.arange(len(self.lengths))
        by_q = pull + stiffness
        by_q[:, diagonal, diagonal] -= pull.sum(axis=2)
        by_q[:, diagonal, diagonal] -= self.weight * self.moments * np.sin(q)
        moment_x, moment_y = self._moment(force_x), self._moment(force_y)
        by_q[:, diagonal, diagonal] += np.sin(q) * moment_y + np.cos(q) * moment_x
        by_v = 2.0 * sine * v[:, None, :] + damping
        by_a = cosine + self.own_inertias
        return by_q, by_v, by_a

    def trajectory(self, until: float, tolerance: float = 1e-11) -> Trajectory:
        """Integrate from the scene's initial motion."""
        knots = np.concatenate([[0.0, until], *(self.signal(i.name).knots for i in self.scene.inputs)])
        breaks = np.unique(knots[(knots >= 0.0) & (knots <= until)])
        initial = self.scene.initial
        start = [np.array([0.0] * self.first + list(x)) for x in (initial.angles, initial.rates)]
        return integrate(self.residual, self.slopes, start[0], start[1], breaks, tolerance)

    def accelerations(self, times: Array, q: Array, v: Array) -> Array:
        """Solve Lagrange's equations for the accelerations, (k, n)."""
        rest = self.residual(times, q, v, np.zeros_like(q))
        _, _, mass = self.slopes(times, q, v, np.zeros_like(q))
        found: Array = np.asarray(np.linalg.solve(mass, -rest[:, :, None])[:, :, 0], np.float64)
        return found

    @staticmethod
    def point(order: int, lever: Array, q: Array, v: Array, a: Array) -> tuple[Array, Array]:
        """Return position or its first or second derivative of a point by its lever arms, (k,) along x and y."""
        s, c = np.sin(q), np.cos(q)
        if order == 0:
            return c @ lever, s @ lever
        if order == 1:
            return -(s * v) @ lever, (c * v) @ lever
        return -(s * a + c * v**2) @ lever, (c * a - s * v**2) @ lever
