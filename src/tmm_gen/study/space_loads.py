"""Loads on an arm in space for a study: all together turn the arm by about a radian."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.reference.spatial_afloat import BASE, AfloatArm
from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.reference.spatial_given import free_joints
from tmm_gen.scene.signal import PRESCRIBED
from tmm_gen.scene.spatial.arm import SpatialArm
from tmm_gen.scene.spatial.reach import longest_way

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


_ROUNDING = 1e-12
"""Lever of a force, relative to the arm's reach, that is none."""


def turning_loads(arm: SpatialArm, frequencies: Mapping[str, float], turn: float) -> dict[str, float]:
    """Return amplitudes for each column of the inputs, in N, or N m of the motor's own side.

    Springs, dampers and inertia all resist: where one of them is far larger than the others, it alone decides, so that
    a free joint costs no absurd torque and a stiff one no absurd motion.

    Parameters
    ----------
    arm : SpatialArm
        As it starts.
    frequencies : mapping from str to float
        With which each column of a torque, force or moment acts, rad/s.
    turn : float
        What some body of the arm turns by where all columns act, about, rad; one that floats may move along by as much
        of its reach instead.
    """
    swung = _Standing(arm) if arm.base is None else _Floating(arm)
    turns = {column: swung.turned(column, frequency) for column, frequency in frequencies.items()}
    found: dict[str, float] = {}
    for item in (each for each in arm.inputs if each.acts not in PRESCRIBED):
        # what pushes along an arm hardly turns it, however strong: components act as the strongest of them does
        largest = max(turns[column] for column in item.columns)
        found |= dict.fromkeys(item.columns, turn / (len(turns) * largest) if largest > 0.0 else 1.0)
    return found


@dataclass(frozen=True, eq=False)
class _Standing:
    """An arm as it starts, on a base that is held, or prescribed and at 0."""

    arm: SpatialArm

    def turned(self, column: str, frequency: float) -> float:
        """Return what some body turns by under a unit of a load, rad."""
        world, free = WorldArm(self.arm), free_joints(self.arm)
        q = np.array([joint.angle for joint in self.arm.joints])
        still = np.zeros_like(q)
        push = world.inverse_dynamics(q, still, still, {}) - world.inverse_dynamics(
            q, still, still, {column: 1.0}
        )
        if np.max(np.abs(np.asarray(push)[free])) <= _ROUNDING * longest_way(
            self.arm
        ):  # it acts right through all axes
            return 0.0
        mass = np.asarray(world.mass_matrix(q))[np.ix_(free, free)]
        swing = np.zeros(len(q), complex)
        swing[free] = _swing(
            mass, world.stiffness[free], world.damping[free], frequency, np.asarray(push)[free]
        )
        turns = world.tree.ways @ (world.tree.places(q).axis * swing[:, None])
        return float(np.max(np.linalg.norm(turns, axis=-1)))


@dataclass(frozen=True, eq=False)
class _Floating:
    """An arm as it starts that nothing holds."""

    arm: SpatialArm

    def turned(self, column: str, frequency: float) -> float:
        """Return what some body turns by under a unit of a load, rad, or how far the base moves of the arm's reach."""
        afloat = AfloatArm(self.arm)
        world, y = afloat.resting, afloat.start()[0]
        still = np.zeros_like(y)
        push = afloat.inverse_dynamics(y, still, still, {}) - afloat.inverse_dynamics(
            y, still, still, {column: 1.0}
        )
        springs, dampers = (np.concatenate([np.zeros(6), own]) for own in (world.stiffness, world.damping))
        acting = np.delete(np.asarray(push), BASE - 1)
        swing = _swing(afloat.whole_mass(y), springs, dampers, frequency, acting)
        turns = world.tree.ways @ (afloat.places(y).axis * swing[6:, None]) + swing[3:6]
        moved = np.linalg.norm(swing[:3]) / (longest_way(self.arm) or 1.0)
        return float(max(np.max(np.linalg.norm(turns, axis=-1)), np.linalg.norm(swing[3:6]), moved))


def _swing(mass: Array, springs: Array, dampers: Array, frequency: float, acting: Array) -> Complex:
    resisting = np.diag(springs) + frequency**2 * mass + 1j * frequency * np.diag(dampers)
    return np.asarray(np.linalg.solve(resisting, acting), complex)
