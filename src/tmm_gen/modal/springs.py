"""The stiffness of an arm, taken apart by the Riccati sweep to the base: what gives way under torques."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.parts import Parts

Array = NDArray[np.float64]

_LEAST = float(np.finfo(float).eps)
"""Of a joint's spring: a pivot that vanishes exactly becomes this, so that both of its neighbours can be told."""


@dataclass(frozen=True, eq=False)
class Springs:
    """``K = (1 - R)^-T D (1 - R)^-1`` undone: ``D`` diagonal, ``R`` carries a share of each angle to the next.

    Without gravity all shares are exactly 1 (behind gears, what those turn), the pivots are the joints' springs, and a
    free hub's pivot is exactly 0: the arm turns freely. With it, pivots are sums of what acts in parallel, never
    differences of large numbers.

    Parameters
    ----------
    parts : Parts
        Of the arm.
    pivot : array, (d,)
        ``D``: as many are negative as the stiffness has negative eigenvalues (Sylvester).
    share : array, (d,)
        ``R``: how much of the angle inboard each angle follows.
    """

    parts: Parts
    pivot: Array
    share: Array

    @cached_property
    def loose(self) -> NDArray[np.intp]:
        """Free angles about which all beyond turns without resistance: a hub, joints without a spring."""
        hub = [0.0] if self.parts.hub else []
        springs = np.concatenate([hub, self.parts.spring])
        return np.flatnonzero((springs == 0.0) & (self.pivot == 0.0))

    @property
    def rigid(self) -> bool:
        """Whether the arm, or a part of it, turns without resistance."""
        return len(self.loose) > 0

    @property
    def turned(self) -> Array:
        """How the arm turns about each loose angle, (d, loose)."""
        return self._solved(np.eye(len(self.pivot))[:, self.loose], "N")

    @property
    def negative(self) -> int:
        """In how many ways the arm falls over."""
        return int(np.sum(self.pivot < 0.0))

    @cached_property
    def signs(self) -> Array:
        """Signs of the pivots, 0 where the arm turns as a whole, (d, 1)."""
        return np.sign(self.pivot)[:, None]

    @cached_property
    def _roots(self) -> Array:
        return np.sqrt(np.abs(self.pivot))[:, None]

    @cached_property
    def _scale(self) -> Array:
        return np.divide(1.0, self._roots, out=np.zeros_like(self._roots), where=self._roots != 0.0)

    @cached_property
    def _band(self) -> Array:
        return np.array([np.ones(len(self.share)), -np.append(self.share[1:], 0.0)])

    def angles(self, bends: Array) -> Array:
        """Return ``S b``: the angles, (d, k), of bends scaled so that ``b^T signs b`` is twice the energy."""
        return self._solved(self._scale * bends, "N")

    def loads(self, torques: Array) -> Array:
        """Return ``S^T f``: what torques on the angles, (d, k), do to the scaled bends."""
        found: Array = self._scale * self._solved(torques, "T")
        return found

    def bends(self, angles: Array) -> Array:
        """Return the scaled bends of angles, (d, k)."""
        found: Array = self._roots * (angles - self.share[:, None] * self.parts.free.inner(angles))
        return found

    def _solved(self, right: Array, transposed: str) -> Array:
        from scipy.linalg.lapack import dtbtrs  # slow to import

        runs, band, share = self.parts.free.runs, self._band, self.share
        found = np.array(right, float, order="F")
        for start, stop, host in runs if transposed == "N" else reversed(runs):
            if host >= 0 and transposed == "N":
                found[start] += share[start] * found[host]
            limb = slice(start, stop)
            found[limb], _ = dtbtrs(band[:, limb], found[limb], uplo="L", trans=transposed, diag="U")
            if host >= 0 and transposed == "T":
                found[host] += share[start] * found[start]
        return found


def springs_of(parts: Parts) -> Springs:
    """Sweep the stiffness from the ends to the base.

    Parameters
    ----------
    parts : Parts
        Of the arm.
    """
    ground = parts.ground_stiffness.tolist()
    springs = ([0.0] if parts.hub else []) + parts.spring.tolist()
    turns = ([1.0] if parts.hub else []) + parts.turn.tolist()
    pivot, share = [0.0] * len(ground), [0.0] * len(ground)
    beyond = [0.0] * (
        len(ground) + 1
    )  # on the base and each angle: stiffness of all outboard, as joints pass it on
    for i in reversed(range(len(ground))):
        own = ground[i] + beyond[i + 1]
        pivot[i] = springs[i] + own
        if springs[i] == 0.0:
            continue  # a hub, or a joint that passes nothing on
        if pivot[i] == 0.0:
            pivot[i] = _LEAST * springs[i]
        share[i] = turns[i] * springs[i] / pivot[i]
        beyond[parts.free.hosts[i]] += turns[i] * share[i] * own
    return Springs(parts, np.array(pivot), np.array(share))
