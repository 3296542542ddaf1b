"""Joints of an arm in space whose motion is given: what of the equations they take part in."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.inputs.signals import Constant, Signal
from tmm_gen.scene.spatial.arm import SpatialArm

Array = NDArray[np.float64]


def free_joints(arm: SpatialArm) -> NDArray[np.intp]:
    """Return the indices of the joints that move by forces, from 0."""
    return np.array([k for k, joint in enumerate(arm.joints) if not joint.given], dtype=np.intp)


@dataclass(frozen=True, eq=False)
class GivenJoints:
    """What inputs say of an arm's joints.

    Parameters
    ----------
    arm : SpatialArm
    signals : mapping from str to Signal
        By the inputs' names; those not given are zero.
    """

    arm: SpatialArm
    signals: Mapping[str, Signal]

    @cached_property
    def of(self) -> dict[int, Signal]:
        """The angles by the joints' indices, from 0."""
        none = Constant(0.0)
        return {k: self.signals.get(j.given, none) for k, j in enumerate(self.arm.joints) if j.given}

    def lacking(self, at: Array, a: Array, found: Array) -> Array:
        """Return what is lacking, (k, n), where a joint's acceleration is to be what is given."""
        for k, signal in self.of.items():
            found[..., k] = a[..., k] - signal.curvature(at)
        return found

    def slopes(self, by_q: Array, by_v: Array, by_a: Array) -> tuple[Array, Array, Array]:
        """Return the slopes of that, (k, n, n) each."""
        if self.of:
            by_q, by_v, by_a = np.array(by_q), np.array(by_v), np.array(by_a)
        for k in self.of:
            by_q[..., k, :] = by_v[..., k, :] = by_a[..., k, :] = 0.0
            by_a[..., k, k] = 1.0
        return by_q, by_v, by_a

    def settled(self, times: Array, q: Array, v: Array) -> tuple[Array, Array]:
        """Return angles and rates, (k, n) each, with those that are given."""
        q, v = np.array(q), np.array(v)
        for k, signal in self.of.items():
            q[..., k], v[..., k] = signal.at(times), signal.slope(times)
        return q, v
