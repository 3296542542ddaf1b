"""Small motions about where an arm starts, by the reference's equations: matrices, what loads do, what turns."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from tmm_gen.inputs.signals import Constant
from tmm_gen.reference.planar_arm import Arm
from tmm_gen.reference.spatial_afloat import BASE, AfloatArm
from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.reference.spatial_given import free_joints
from tmm_gen.scene import Scene
from tmm_gen.scene.spatial.arm import SpatialArm
from tmm_gen.scene.spatial.reach import longest_way

Array = NDArray[np.float64]
Matrices = tuple[Array, Array, Array]

_ROUNDING = 1e-12
"""Lever of a force, relative to the arm's reach, that is none."""


class SmallMotion(Protocol):
    """An arm in small motion about where it starts, without weight."""

    @property
    def matrices(self) -> Matrices:
        """Mass, damping and stiffness, (n, n) each."""

    def push(self, column: str) -> Array:
        """Return what a unit of a load does to the coordinates, (n,)."""

    def turned(self, q: Array) -> Array:
        """Return by how much some body turns at most, (m,), by coordinates (n, m).

        In rad. Where the base moves by a larger share of the arm's reach, that share.
        """


def small_motion(scene: Scene) -> SmallMotion:
    """Return that of an arm in space, or of a planar one on a base that floats."""
    if scene.spatial is None:
        return _FloatingInPlane(scene)
    return _Standing(scene.spatial) if scene.spatial.base is None else _Floating(scene.spatial)


@dataclass(frozen=True, eq=False)
class _Standing:
    """In space, on a base that is held, or prescribed and at 0: joints that move by forces."""

    arm: SpatialArm

    @cached_property
    def _world(self) -> WorldArm:
        return WorldArm(self.arm)

    @cached_property
    def _free(self) -> NDArray[np.intp]:
        return free_joints(self.arm)

    @cached_property
    def _q(self) -> Array:
        return np.array([joint.angle for joint in self.arm.joints])

    @cached_property
    def _axes(self) -> Array:
        return np.asarray(self._world.tree.places(self._q).axis)[self._free]

    @property
    def matrices(self) -> Matrices:
        world, free = self._world, self._free
        mass = np.asarray(world.mass_matrix(self._q))[np.ix_(free, free)]
        return mass, np.diag(world.damping[free]), np.diag(world.stiffness[free])

    def push(self, column: str) -> Array:
        q, still = self._q, np.zeros_like(self._q)
        lacking = self._world.inverse_dynamics
        found = np.asarray(lacking(q, still, still, {}) - lacking(q, still, still, {column: 1.0}))[self._free]
        if np.max(np.abs(found)) <= _ROUNDING * longest_way(self.arm):  # it acts right through all axes
            return np.zeros_like(found)
        return found

    def turned(self, q: Array) -> Array:
        return _largest(_turns(self._world, self._free, self._axes, q))


@dataclass(frozen=True, eq=False)
class _Floating:
    """In space, held by nothing: place and turn of the base, and the joints."""

    arm: SpatialArm

    @cached_property
    def _afloat(self) -> AfloatArm:
        return AfloatArm(self.arm)

    @cached_property
    def _y(self) -> Array:
        return self._afloat.start()[0]

    @cached_property
    def _axes(self) -> Array:
        return np.asarray(self._afloat.places(self._y).axis)

    @property
    def matrices(self) -> Matrices:
        world = self._afloat.resting
        dampers, springs = (
            np.diag(np.concatenate([np.zeros(6), own])) for own in (world.damping, world.stiffness)
        )
        return self._afloat.whole_mass(self._y), dampers, springs

    def push(self, column: str) -> Array:
        y, still = self._y, np.zeros_like(self._y)
        lacking = self._afloat.inverse_dynamics
        found = lacking(y, still, still, {}) - lacking(y, still, still, {column: 1.0})
        return np.delete(np.asarray(found), BASE - 1)

    def turned(self, q: Array) -> Array:
        moved = np.linalg.norm(q[:3], axis=0) / (longest_way(self.arm) or 1.0)
        base = q[3:6].T[:, None]
        bodies = base + _turns(self._afloat.resting, slice(None), self._axes, q[6:])
        return np.asarray(np.max([moved, _largest(base), _largest(bodies)], axis=0))


def _turns(world: WorldArm, joints: Any, axes: Array, q: Array) -> Array:
    """Return how bodies turn, (m, bodies, 3), where some joints do, (n, m), about their axes, (n, 3); rad."""
    return np.asarray(world.tree.ways[:, joints] @ (axes * q.T[..., None]))


def _largest(vectors: Array) -> Array:
    return np.asarray(np.max(np.linalg.norm(vectors, axis=-1), axis=-1))


@dataclass(frozen=True, eq=False)
class _FloatingInPlane:
    """In a plane, held by nothing: place of the centre of mass, and all angles."""

    scene: Scene

    @cached_property
    def _arm(self) -> Arm:
        return Arm(self.scene, {})

    @cached_property
    def _q(self) -> Array:
        return np.array([[0.0] * self._arm.first + list(self.scene.initial.angles)])

    @cached_property
    def _to_base(self) -> Array:
        """How the base moves against the centre of mass as angles change, (2, n), m."""
        return np.concatenate([np.sin(self._q), -np.cos(self._q)]) * self._arm.moments / self._arm.whole

    @property
    def matrices(self) -> Matrices:
        from scipy.linalg import block_diag  # slow to import

        still, free = np.zeros_like(self._q), np.zeros((2, 2))
        mass = self._arm.slopes(np.zeros(1), self._q, still, still)[2][0]
        springs, dampers = self._arm.springs
        return (
            block_diag(self._arm.whole * np.eye(2), mass),
            block_diag(free, dampers),
            block_diag(free, springs),
        )

    def push(self, column: str) -> Array:
        still, now = np.zeros_like(self._q), np.zeros(1)
        loaded = Arm(self.scene, {column: Constant(1.0)})
        turning = self._arm.residual(now, self._q, still, still) - loaded.residual(now, self._q, still, still)
        _, along_x, along_y = loaded.loads(now)
        return np.concatenate([[along_x.sum(), along_y.sum()], turning[0]])

    def turned(self, q: Array) -> Array:
        moved = np.linalg.norm(q[:2] + self._to_base @ q[2:], axis=0) / (self.scene.reach or 1.0)
        return np.asarray(np.maximum(moved, np.max(np.abs(q[2:]), axis=0)))
