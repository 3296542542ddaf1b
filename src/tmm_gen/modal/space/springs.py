"""The stiffness of an arm in space taken apart, and what nothing resists told from what resists a little.

Angles are those of joints, so that springs stand on the diagonal and only weight and loads couple. Beside the terms
that each joint's torque is made of, what is left is of the order of one, however far springs lie apart.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.space.still import ROUNDING, Still

Array = NDArray[np.float64]
Indices = NDArray[np.intp]

_APART = 1e-9
"""Share of an idle motion's largest angle that counts as none."""


@dataclass(frozen=True, eq=False)
class SpaceSprings:
    """``K = B^T S B`` with ``B`` from eigenvectors of the stiffness in scaled angles.

    Parameters
    ----------
    still : Still
        Where the arm rests.
    shift : array, (n,), optional
        Stiffness to be added about each joint, N m/rad.
    """

    still: Still
    shift: Array | None = None

    @cached_property
    def idle(self) -> Array:
        """Motions that nothing resists, (n, r): no joint in them has a spring, and neither weight nor loads mind.

        What weight and loads do to joints without a spring is seen beside the terms it is a sum of: a direction in
        which it vanishes to their rounding is free, whatever else the arm has.
        """
        numbers, free = self.still.numbers, self.still.numbers.free
        if self.shift is not None or not len(free):
            return np.zeros((numbers.size, 0))
        acting = self.still.acting
        unit = np.where(acting > 0.0, 1.0 / np.sqrt(np.where(acting > 0.0, acting, 1.0)), 1.0)
        seen = unit[:, None] * self.still.geometric[:, free] * unit[free]
        _, sizes, rows = np.linalg.svd(seen)
        vanishing = rows[sizes <= ROUNDING * numbers.size] * unit[free]
        found = np.zeros((numbers.size, len(vanishing)))
        found[free] = _apart(vanishing.T)
        return found

    @cached_property
    def _root(self) -> Array:
        """Square root of what each joint's stiffness is a sum of, (n, 1)."""
        held = self.still.numbers.stiffness + self.still.acting
        if self.shift is not None:
            held = held + self.shift
        return np.sqrt(np.where(held > 0.0, held, 1.0))[:, None]

    @cached_property
    def _taken(self) -> tuple[Array, Array]:
        """Eigenvalues in scaled angles, exactly zero for what is idle, and eigenvectors, (n,) and (n, n)."""
        from scipy.linalg import eigh, qr  # slow to import

        numbers, root = self.still.numbers, self._root
        matrix = 0.5 * (self.still.geometric + self.still.geometric.T)
        own = numbers.stiffness if self.shift is None else numbers.stiffness + self.shift
        matrix[np.diag_indices(numbers.size)] += own
        scaled = matrix / root / root.T
        count = self.idle.shape[1]
        if not count:
            values, vectors = eigh(scaled)
            return values, vectors
        basis = qr(root * self.idle)[0]
        held = basis[:, count:]
        values, vectors = eigh(held.T @ scaled @ held)
        return np.append(np.zeros(count), values), np.hstack([basis[:, :count], held @ vectors])

    @property
    def loose(self) -> Indices:
        """Bends that nothing resists: as many as there are idle motions."""
        return np.arange(self.idle.shape[1])

    @property
    def rigid(self) -> bool:
        """Whether the arm, or a part of it, turns without resistance."""
        return len(self.loose) > 0

    @property
    def turned(self) -> Array:
        """The idle motions, (n, r)."""
        return self.idle

    @property
    def negative(self) -> int:
        """In how many ways the arm falls over."""
        return int(np.sum(self._taken[0] < 0.0))

    @property
    def convex(self) -> float:
        """The least eigenvalue of what resists, of terms of the order of one; infinite where nothing does."""
        return float(np.min(self._taken[0][len(self.loose) :], initial=np.inf))

    @cached_property
    def signs(self) -> Array:
        """Signs of the bends, 0 where nothing resists, (n, 1)."""
        return np.sign(self._taken[0])[:, None]

    @cached_property
    def _sizes(self) -> Array:
        return np.sqrt(np.abs(self._taken[0]))[:, None]

    @cached_property
    def _giving(self) -> Array:
        return np.divide(1.0, self._sizes, out=np.zeros_like(self._sizes), where=self._sizes > 0.0)

    def angles(self, bends: Array) -> Array:
        """Return the angles, (n, k), of scaled bends."""
        found: Array = (self._taken[1] @ (self._giving * bends)) / self._root
        return found

    def loads(self, torques: Array) -> Array:
        """Return what torques on the joints, (n, k), do to the scaled bends."""
        found: Array = self._giving * (self._taken[1].T @ (torques / self._root))
        return found

    def bends(self, angles: Array) -> Array:
        """Return the scaled bends of angles, (n, k)."""
        found: Array = self._sizes * (self._taken[1].T @ (self._root * angles))
        return found


def _apart(motions: Array) -> Array:
    """Return motions that span the same, each with a joint of its own that no other moves, inner ones first."""
    from scipy.linalg import qr  # slow to import

    own = np.sort(qr(motions.T, mode="r", pivoting=True)[1][: motions.shape[1]])
    found: Array = motions @ np.linalg.inv(motions[own])
    return np.where(np.abs(found) > _APART * np.max(np.abs(found), axis=0, initial=0.0), found, 0.0)
