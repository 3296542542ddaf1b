"""Mass, damping and stiffness matrices of an arm in space about rest."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.linear import common_time
from tmm_gen.modal.space.springs import SpaceSprings
from tmm_gen.modal.space.still import Still

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class SpaceParts:
    """Products with the matrices; free angles are those of the joints.

    Parameters
    ----------
    still : Still
        Where the arm rests.
    """

    still: Still

    @property
    def size(self) -> int:
        """Number of joints, n."""
        return self.still.numbers.size

    def weighed(self, angles: Array) -> Array:
        """Return the mass matrix times angles, (n, k)."""
        found: Array = self.still.mass @ angles
        return found

    def held(self, angles: Array) -> Array:
        """Return the stiffness matrix times angles, (n, k): springs, weight and loads each by itself."""
        found: Array = self.still.numbers.stiffness[:, None] * angles + self.still.geometric @ angles
        return found

    def braked(self, rates: Array) -> Array:
        """Return the damping matrix times rates, (n, k), complex ones too."""
        found: Array = self.still.numbers.damping[:, None] * rates
        return found


@dataclass(frozen=True, eq=False)
class SpaceMatrices:
    """``M q'' + C q' + K q = 0`` for the angles ``q`` of the joints.

    Parameters
    ----------
    parts : SpaceParts
        What they are made of.
    """

    parts: SpaceParts

    @property
    def mass(self) -> Array:
        """``M``, kg m^2, (n, n), symmetric."""
        return self.parts.still.mass

    @cached_property
    def damping(self) -> Array:
        """``C``, N m s/rad, (n, n), diagonal."""
        return np.diag(self.parts.still.numbers.damping)

    @cached_property
    def stiffness(self) -> Array:
        """``K``, N m/rad, (n, n), symmetric."""
        found = self.parts.held(np.eye(self.parts.size))
        return 0.5 * (found + found.T)

    @cached_property
    def springs(self) -> SpaceSprings:
        """``K`` taken apart."""
        return SpaceSprings(self.parts.still)

    @property
    def damping_time(self) -> float | None:
        """T where damping is T times stiffness, joint by joint, and weight and loads do nothing; else None."""
        still = self.parts.still
        if not np.any(still.numbers.damping):
            return 0.0
        if np.any(still.acting) and np.any(still.geometric):
            return None
        return common_time(still.numbers.damping, still.numbers.stiffness)


def space_matrices(still: Still) -> SpaceMatrices:
    """Return the matrices of an arm held still."""
    return SpaceMatrices(SpaceParts(still))
