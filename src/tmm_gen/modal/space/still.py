"""An arm in space held still: where it is, what acts in it, and how that changes by small turns of its joints."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.space.elements import beside, hinges, turning
from tmm_gen.modal.space.loads import Load, held_loads
from tmm_gen.modal.space.numbers import ArmNumbers
from tmm_gen.reference.spatial_turns import product, quaternion
from tmm_gen.scene.spatial.arm import Frame

Array = NDArray[np.float64]

ROUNDING = 64.0 * float(np.finfo(float).eps)
"""Per joint: what is smaller, relative to the terms it is a sum of, cannot be told from zero."""


@dataclass(frozen=True, eq=False)
class Still:
    """An arm without motion.

    Parameters
    ----------
    numbers : ArmNumbers
        Of the arm.
    angles : array, (n,)
        Of its joints, rad.
    given : mapping from str to float
        Constant inputs by column; those not given are zero.
    """

    numbers: ArmNumbers
    angles: Array
    given: Mapping[str, float]

    @cached_property
    def _hinges(self) -> tuple[Array, Array]:
        return hinges(self.numbers.axes, self.angles)

    @cached_property
    def through(self) -> Array:
        """Accelerations behind each joint by those of the body it stands on, (n, 6, 6); transposed, forces inward."""
        found: Array = self._hinges[0] @ self.numbers.mounts
        return found

    @cached_property
    def turned(self) -> Array:
        """The derivative of `through` by the joint's angle, (n, 6, 6)."""
        found: Array = self._hinges[1] @ self.numbers.mounts
        return found

    @cached_property
    def facing(self) -> Array:
        """Components in each body's axes by those in the world's, (n, 3, 3)."""
        found = np.empty((self.numbers.size, 3, 3))
        for number, host in enumerate(self.numbers.hosts):
            own = self.through[number, :3, :3]
            found[number] = own @ (found[host] if host >= 0 else self.numbers.base_facing)
        return found

    @cached_property
    def weight(self) -> Array:
        """Proper acceleration of each body's point: gravity with its sign turned, in the body's axes, (n, 3), m/s^2."""
        found: Array = self.facing @ -self.numbers.gravity
        return found

    @cached_property
    def loads(self) -> tuple[Load, ...]:
        """What constant inputs hold on bodies."""
        return held_loads(self.numbers.arm, self.given)

    @cached_property
    def driving(self) -> Array:
        """Torque of motors in each joint, (n,), N m."""
        found = np.zeros(self.numbers.size)
        for item in self.numbers.arm.inputs:
            if item.acts == "torque":
                gear = self.numbers.arm.joints[item.joint - 1].gear
                found[item.joint - 1] += gear * self.given.get(item.name, 0.0)
        return found

    @cached_property
    def forces(self) -> Array:
        """Force and moment behind each joint, by the inner side on the outer one, (n, 6), in the body's axes."""
        found: Array = (self.numbers.bodies[:, :, :3] @ self.weight[:, :, None])[:, :, 0]
        for load in self.loads:
            found[load.body] -= load.arm @ load.on_body(self.facing[load.body])
        for number in reversed(range(self.numbers.size)):
            host = self.numbers.hosts[number]
            if host >= 0:
                found[host] += self.through[number].T @ found[number]
        return found

    @cached_property
    def needed(self) -> Array:
        """Torque that holds what is beyond each joint, (n,), N m."""
        found: Array = np.sum(self.numbers.pushes * self.forces, axis=1)
        return found

    @property
    def passed(self) -> Array:
        """Torque that each joint passes on, its spring's and its motor's, (n,), N m."""
        found: Array = self.driving - self.numbers.stiffness * (self.angles - self.numbers.rest)
        return found

    @property
    def unbalanced(self) -> Array:
        """Torque that turns each joint, (n,), N m; zero in equilibrium."""
        found: Array = self.passed - self.needed
        return found

    @cached_property
    def acting(self) -> Array:
        """The most that weight and loads can do about each joint, (n,), N m."""
        found = self.numbers.weighing
        for load in self.loads:
            forces, levers = np.zeros((2, self.numbers.size))
            forces[load.body], levers[load.body] = np.linalg.norm(load.vector), load.reach
            found = found + self.numbers.stretched(forces, levers)
        return found

    @cached_property
    def scale(self) -> Array:
        """What the torques of each joint are sums of, (n,), N m."""
        springs = np.abs(self.numbers.stiffness * (self.angles - self.numbers.rest))
        found: Array = self.acting + springs + np.abs(self.driving)
        return found

    @cached_property
    def axes(self) -> Array:
        """The joints' axes in world axes, (n, 3)."""
        spins = self.numbers.pushes[:, 3:]
        found: Array = (np.swapaxes(self.facing, -1, -2) @ spins[:, :, None])[:, :, 0]
        return found

    @cached_property
    def turns(self) -> Array:
        """How each body turns, in its own axes, as each joint does, (n, 3, n)."""
        found: Array = (self.facing @ self.axes.T) * self.numbers.ways[:, None, :]
        return found

    @cached_property
    def moves(self) -> Array:
        """How each body moves and turns, in its own axes, as each joint turns, (n, 6, n)."""
        found = np.zeros((self.numbers.size, 6, self.numbers.size))
        for number, host in enumerate(self.numbers.hosts):
            if host >= 0:
                inner = found[host, :, : host + 1]
                found[number, :, : host + 1] = self.through[number] @ inner
            found[number, :, number] = self.numbers.pushes[number]
        return found

    @cached_property
    def mass(self) -> Array:
        """The mass matrix, (n, n), kg m^2; of an arm that floats where momentum is zero: the base moves along."""
        size = self.numbers.size
        weighed = (self.numbers.bodies @ self.moves).reshape(-1, size)
        found = self.moves.reshape(-1, size).T @ weighed
        if self.numbers.floats:
            found += self._coupling.T @ self.following
        found = 0.5 * (found + found.T)
        found[np.diag_indices(size)] += self.numbers.armature
        return found

    @cached_property
    def carried(self) -> Array:
        """How each body moves and turns, in its own axes, as the base does in the base's, (n, 6, 6)."""
        found = np.empty((self.numbers.size, 6, 6))
        for number, host in enumerate(self.numbers.hosts):
            found[number] = self.through[number] @ found[host] if host >= 0 else self.through[number]
        return found

    @cached_property
    def base_mass(self) -> Array:
        """Force and moment that all of the arm takes as the base accelerates, (6, 6), in its axes."""
        own = np.einsum("nai,nab,nbj->ij", self.carried, self.numbers.bodies, self.carried)
        return np.asarray(self.numbers.base_body + own)

    @cached_property
    def _coupling(self) -> Array:
        return np.asarray(np.einsum("nai,nab,nbj->ij", self.carried, self.numbers.bodies, self.moves))

    @cached_property
    def following(self) -> Array:
        """How a base that floats moves and turns as each joint turns, (6, n), in its axes: momentum stays zero."""
        if not self.numbers.floats:
            return np.zeros((6, self.numbers.size))
        return np.asarray(-np.linalg.solve(self.base_mass, self._coupling))

    @cached_property
    def geometric(self) -> Array:
        """What torques that weight and loads take change by as joints turn, (n, n), N m/rad."""
        change = self._taken @ self.turns
        found = np.empty((self.numbers.size, self.numbers.size))
        for number in reversed(range(self.numbers.size)):
            found[number] = self.numbers.pushes[number] @ change[number]
            host = self.numbers.hosts[number]
            if host >= 0:
                change[host] += self.through[number].T @ change[number]
                change[host, :, number] += self.turned[number].T @ self.forces[number]
        return found

    @cached_property
    def _taken(self) -> Array:
        """What a body's weight and loads take by small turns of it, (n, 6, 3): they stand still as it turns."""
        found: Array = self.numbers.bodies[:, :, :3] @ small_turns(self.weight) + self.loaded
        return found

    @cached_property
    def loaded(self) -> Array:
        """What held loads in world axes take by small turns of each body, (n, 6, 3)."""
        found = np.zeros((self.numbers.size, 6, 3))
        for load in self.loads:
            if load.world:
                found[load.body] -= load.arm @ small_turns(load.on_body(self.facing[load.body]))
        return found

    @property
    def conservative(self) -> bool:
        """Whether what acts has an energy here: no load that turns with its body does work around a small loop."""
        if not self.loads:
            return True
        skew = np.abs(self.geometric - self.geometric.T)
        about = np.sqrt(self.acting[:, None] * self.acting[None, :])
        return bool(np.all(skew <= 1e3 * ROUNDING * self.numbers.size * about))

    @property
    def heights(self) -> Array:
        """What is left of places by motions that weight and loads do not mind, (k,), m: all along what acts.

        The bodies' centres against gravity, and the points on which forces in world axes act along them.
        """
        down = self.numbers.gravity
        centers = np.array([joint.body.center for joint in self.numbers.arm.joints])
        places = self._points[1:] + np.einsum("nij,ni->nj", self.facing, centers)
        found = [-(places @ down) / (np.linalg.norm(down) or 1.0)]
        for load in self.loads:
            if load.world and load.pushes:
                place = self._points[load.body + 1] + self.facing[load.body].T @ np.array(load.at)
                found.append(np.array([place @ load.vector / np.linalg.norm(load.vector)]))
        return np.concatenate(found)

    def place(self, frame: Frame) -> Array:
        """Return where a frame is, (3,), m."""
        found: Array = self._points[frame.joint] + self._facing(frame.joint).T @ np.array(frame.at)
        return found

    def moved(self, frame: Frame) -> tuple[Array, Array]:
        """Return how a frame moves, in world axes, and turns, in its own, (3, 6 + n) each.

        First as the base moves and turns in its own axes, then as each joint turns.
        """
        own = np.hstack([np.eye(6), np.zeros((6, self.numbers.size))])
        if frame.joint:
            own = np.hstack([self.carried[frame.joint - 1], self.moves[frame.joint - 1]])
        moved = beside(frame.at) @ own
        return self._facing(frame.joint).T @ moved[:3], np.array(frame.turn).T @ moved[3:]

    def posed(self, changes: Array | None = None) -> Array:
        """Return it moved a little as pictures take it, (k, n): angles; (k, 7 + n) where the base floats.

        Parameters
        ----------
        changes : array, (k, 6 + n)
            How the base moves and turns, in its own axes, and each joint turns, m and rad; none by default.
        """
        moves = np.zeros((1, 6 + self.numbers.size)) if changes is None else changes
        angles = self.angles + moves[:, 6:]
        base = self.numbers.arm.base
        if base is None:
            return np.asarray(angles)
        size = np.linalg.norm(moves[:, 3:6], axis=1, keepdims=True)
        turn = np.hstack([np.cos(0.5 * size), 0.5 * np.sinc(size / (2.0 * np.pi)) * moves[:, 3:6]])
        place = self.numbers.base_place + moves[:, :3] @ self.numbers.base_facing
        return np.hstack([place, product(quaternion(base.turn), turn), angles])

    @cached_property
    def _points(self) -> Array:
        """Where the base and the joints are, (n + 1, 3), m."""
        found = np.tile(self.numbers.base_place, (self.numbers.size + 1, 1))
        for number, joint in enumerate(self.numbers.arm.joints, start=1):
            found[number] = found[joint.host] + self._facing(joint.host).T @ np.array(joint.at)
        return found

    def _facing(self, joint: int) -> Array:
        return self.facing[joint - 1] if joint else self.numbers.base_facing


def small_turns(vectors: Array) -> Array:
    """Return how the components of fixed vectors, (..., 3), change by small turns of their axes, (..., 3, 3)."""
    found: Array = np.einsum("aij,...j->...ia", turning(), vectors)
    return found
