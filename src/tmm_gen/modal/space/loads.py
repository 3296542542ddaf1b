"""Forces and moments on frames of an arm in space, as constant inputs hold them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.space.elements import beside
from tmm_gen.scene.spatial.arm import ArmInput, SpatialArm, Vector

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Load:
    """A force or a moment on a body, for a unit of its column or as it is held.

    Parameters
    ----------
    column : str
        Of the input.
    body : int
        Index of the body, from 0; -1 is a base that floats.
    vector : array, (3,)
        Components, N or N m.
    world : bool
        Whether in world axes; otherwise in those of the body.
    at : tuple of float, length 3
        Where it acts, in the body's frame, m.
    pushes : bool
        Whether it is a force; otherwise a moment.
    """

    column: str
    body: int
    vector: Array
    world: bool
    at: Vector
    pushes: bool

    @cached_property
    def arm(self) -> Array:
        """Force and moment about the joint's point by the components in the body's axes, (6, 3)."""
        # power is the same on both sides, so forces pass by the transpose of what accelerations do
        found: Array = beside(self.at).T[:, :3] if self.pushes else np.eye(6)[:, 3:]
        return found

    @property
    def reach(self) -> float:
        """Lever of a force about the joint's point, m; 1 m for a moment."""
        return float(np.linalg.norm(self.at)) if self.pushes else 1.0

    def on_body(self, facing: Array) -> Array:
        """Return the components in the body's axes, (3,), which see the world's as ``facing`` says, (3, 3)."""
        seen: Array = facing @ self.vector if self.world else self.vector
        return seen


def unit_loads(arm: SpatialArm) -> Iterator[Load]:
    """Yield a unit of each column of the inputs that act on a frame that moves by forces."""
    for item in arm.inputs:
        if item.frame is None or not (item.frame.joint or arm.base):
            continue
        for column, axis in zip(item.columns, np.eye(3), strict=True):
            yield _load(item, column, axis)


def held_loads(arm: SpatialArm, given: Mapping[str, float]) -> tuple[Load, ...]:
    """Return the loads that constant inputs hold."""
    return tuple(
        replace(each, vector=given[each.column] * each.vector)
        for each in unit_loads(arm)
        if each.body >= 0 and given.get(each.column, 0.0)
    )


def _load(item: ArmInput, column: str, vector: Array) -> Load:
    assert item.frame is not None
    body = item.frame.joint - 1
    world = item.axes == "world"
    seen = vector if world else np.array(item.frame.turn) @ vector
    return Load(column, body, seen, world, item.frame.at, item.acts == "force")
