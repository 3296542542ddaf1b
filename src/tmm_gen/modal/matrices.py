"""Mass, damping and stiffness matrices of an arm in small motion."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.arm import LinearArm
from tmm_gen.modal.linear import common_time
from tmm_gen.modal.parts import Parts, parts_of
from tmm_gen.modal.springs import Springs, springs_of

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Matrices:
    """``M q'' + C q' + K q = 0`` for the free angles ``q``: a motor's hub, then the links.

    Parameters
    ----------
    parts : Parts
        What they are made of. The matrices themselves, of d by d numbers, are made when they are asked for.
    """

    parts: Parts

    @cached_property
    def mass(self) -> Array:
        """``M``, kg m^2, (d, d), symmetric."""
        found = self.parts.weighed(np.eye(self.parts.size))
        return 0.5 * (found + found.T)

    @cached_property
    def damping(self) -> Array:
        """``C``, N m s/rad, (d, d), symmetric."""
        return self.parts.braked(np.eye(self.parts.size))

    @cached_property
    def stiffness(self) -> Array:
        """``K``, N m/rad, (d, d), symmetric."""
        return self.parts.held(np.eye(self.parts.size))

    @cached_property
    def springs(self) -> Springs:
        """``K`` taken apart by a sweep."""
        return springs_of(self.parts)

    @property
    def damping_time(self) -> float | None:
        """T where damping is T times stiffness, joint by joint, and nothing else damps or holds; else None."""
        parts = self.parts
        if not np.any(parts.damper) and not np.any(parts.ground_damping):
            return 0.0
        if np.any(parts.ground_stiffness) or np.any(parts.ground_damping):
            return None
        return common_time(parts.damper, parts.spring)


def matrices(arm: LinearArm) -> Matrices:
    """Gather the matrices of an arm from its elements."""
    return Matrices(parts_of(arm))
