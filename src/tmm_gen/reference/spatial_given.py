"""Joints of an arm in space whose motion is given, and bases that are moved along: what of the equations they are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tmm_gen.inputs.signals import Constant, Signal
from tmm_gen.scene.signal import ACCELERATION, RATE
from tmm_gen.scene.spatial.arm import SpatialArm

Array = NDArray[np.float64]


def given(arm: SpatialArm, signals: Mapping[str, Signal], times: Array) -> dict[str, Array]:
    """Return the values of inputs at instants, by column; of a base that is moved along, velocity and acceleration too.

    Those are the columns that kernels have: with ``_rate`` and ``_acceleration`` at the end.
    """
    found = {name: signal.at(times) for name, signal in signals.items()}
    for item in arm.along:
        if item and item.name in signals:
            found[item.name + RATE] = signals[item.name].slope(times)
            found[item.name + ACCELERATION] = signals[item.name].curvature(times)
    return found


def moved(arm: SpatialArm, inputs: Mapping[str, ArrayLike], kind: str = "") -> NDArray[Any] | None:
    """Return how a base is moved along, (..., 3), in world axes, m; None where it is not.

    Parameters
    ----------
    inputs : mapping from str to array_like
        As of :func:`given`.
    kind : {"", "_rate", "_acceleration"}
        Its place, velocity (m/s) or acceleration (m/s^2).
    """
    values = [inputs.get(item.name + kind, 0.0) if item else 0.0 for item in arm.along]
    if not any(item and item.name + kind in inputs for item in arm.along):
        return None
    return np.stack(np.broadcast_arrays(*values), axis=-1)


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
