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

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.inputs.signals import Constant, Signal
from tmm_gen.reference.collocation import Trajectory, integrate
from tmm_gen.reference.planar_members import Members
from tmm_gen.scene import station_of

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Arm(Members):
    """Lagrange's equations of a scene; index 0 is the hub where the base is a motor.

    Parameters
    ----------
    scene : Scene
        Of kind "planar".
    signals : mapping from str to Signal
        Inputs by name; those not given are zero.
    """

    signals: Mapping[str, Signal]

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
            if item.acts == "angle":  # through springs, dampers and rotors of joints on the base
                rate, acceleration = (
                    self.signal(item.name).slope(times),
                    self.signal(item.name).curvature(times),
                )
                for on_base in np.flatnonzero(self.inner < 0):
                    joint = self.scene.joints[on_base]
                    torque[:, on_base] += joint.stiffness * values + joint.damping * rate
                    torque[:, on_base] += self.rotors[on_base] * acceleration
            elif item.acts == "drive":  # between both sides of the joint
                geared = self.scene.joints[place - self.first].gear * values
                torque[:, place] += geared
                on = int(self.inner[place - self.first])
                if on >= 0:
                    torque[:, on] -= geared
            else:
                {"torque": torque, "force_x": along_x, "force_y": along_y}[item.acts][:, place] += values
        return torque, along_x, along_y

    def base_motion(self, times: Array) -> tuple[Array, Array, Array]:
        """Return angle, rate and acceleration of a prescribed base, zero for a clamp, (k,) each."""
        angle, rate, acceleration = np.zeros((3, len(times)))
        for item in self.scene.inputs:
            if item.acts == "angle":
                angle += self.signal(item.name).at(times)
                rate += self.signal(item.name).slope(times)
                acceleration += self.signal(item.name).curvature(times)
        return angle, rate, acceleration

    def strained(self, times: Array, q: Array) -> Array:
        """Return what the springs of the joints are wound up by, (k, joints), rad."""
        found = self.bent(q) - self.slack
        found[:, self.inner < 0] -= self.base_motion(times)[0][:, None]
        return found

    def wound(self, times: Array, v: Array) -> Array:
        """Return how fast the two sides of each joint turn against each other, (k, joints), rad/s."""
        found = self.bent(v)
        found[:, self.inner < 0] -= self.base_motion(times)[1][:, None]
        return found

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
