"""What modes need of an arm in small motion, whatever kind it is."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class LinearParts(Protocol):
    """Products with the matrices of an arm of d free angles."""

    @property
    def size(self) -> int:
        """Number of free angles, d."""
        ...

    def weighed(self, angles: Array) -> Array:
        """Return the mass matrix times angles, (d, k)."""
        ...

    def held(self, angles: Array) -> Array:
        """Return the stiffness matrix times angles, (d, k)."""
        ...

    def braked(self, rates: Array) -> Array:
        """Return the damping matrix times rates, (d, k), complex ones too."""
        ...


class Resistance(Protocol):
    """The stiffness taken apart: ``K = B^T S B``, ``S`` of signs and zeros, ``B`` what angles do to scaled bends."""

    @property
    def loose(self) -> NDArray[np.intp]:
        """Bends that nothing resists, by structure."""
        ...

    @property
    def rigid(self) -> bool:
        """Whether there are any."""
        ...

    @property
    def turned(self) -> Array:
        """Motions that nothing resists, (d, loose)."""
        ...

    @property
    def negative(self) -> int:
        """In how many ways the arm falls over."""
        ...

    @property
    def signs(self) -> Array:
        """``S``, (d, 1)."""
        ...

    def angles(self, bends: Array) -> Array:
        """Return the angles, (d, k), of scaled bends."""
        ...

    def loads(self, torques: Array) -> Array:
        """Return what torques on the angles, (d, k), do to the scaled bends."""
        ...

    def bends(self, angles: Array) -> Array:
        """Return the scaled bends of angles, (d, k)."""
        ...


class Linear(Protocol):
    """``M q'' + C q' + K q = 0``."""

    @property
    def parts(self) -> LinearParts:
        """What the matrices are made of."""
        ...

    @property
    def springs(self) -> Resistance:
        """The stiffness taken apart."""
        ...

    @property
    def damping_time(self) -> float | None:
        """T where damping is T times stiffness and nothing else damps or holds; else None."""
        ...

    @property
    def mass(self) -> Array:
        """``M``, (d, d), symmetric."""
        ...

    @property
    def damping(self) -> Array:
        """``C``, (d, d), symmetric."""
        ...

    @property
    def stiffness(self) -> Array:
        """``K``, (d, d), symmetric."""
        ...


_PROPORTIONAL = 1e-12
"""Ratios of damper to spring that differ by less are the same; either way the poles agree to this."""


def common_time(damper: Array, spring: Array) -> float | None:
    """Return T where dampers are T times the springs beside them; else None."""
    if np.any(damper[spring == 0.0]):
        return None
    held = spring > 0.0
    if not held.any():
        return 0.0
    times = damper[held] / spring[held]
    middle = float(np.median(times))
    return middle if np.all(np.abs(times - middle) <= _PROPORTIONAL * middle) else None
