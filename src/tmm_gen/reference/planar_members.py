"""What a planar arm is made of, and sums over it: masses and lever arms, springs, dampers and rotors of its joints.

Nothing here comes from `derive` or `program`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.scene import Scene
from tmm_gen.scene.model import FloatingBase

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Members:
    """Members of a planar arm in absolute angles; index 0 is the hub where the base is a motor.

    Parameters
    ----------
    scene : Scene
        Of kind "planar".
    """

    scene: Scene

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
