"""Forces and moments on frames of an arm in space, as constant inputs hold them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.space.elements import beside
from tmm_gen.scene.spatial.arm import ArmInput, SpatialArm

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Load:
    """A force or a moment on a body, for a unit of its column or as it is held.

    Parameters
    ----------
    column : str
        Of the input.
    body : int
        Index of the body, from 0.
    vector : array, (3,)
        Components, N or N m.
    world : bool
        Whether in world axes; otherwise in those of the body.
    arm : array, (6, 3)
        Force and moment about the joint's point by the components in the body's axes.
    reach : float
        Lever of a force about the joint's point, m; 1 m for a moment.
    """

    column: str
    body: int
    vector: Array
    world: bool
    arm: Array
    reach: float

    def on_body(self, facing: Array) -> Array:
        """Return the components in the body's axes, (3,), which see the world's as ``facing`` says, (3, 3)."""
        seen: Array = facing @ self.vector if self.world else self.vector
        return seen


def unit_loads(arm: SpatialArm) -> Iterator[Load]:
    """Yield a unit of each column of the inputs that act on a frame that moves."""
    for item in arm.inputs:
        if item.frame is None or not item.frame.joint:
            continue
        for column, axis in zip(item.columns, np.eye(3), strict=True):
            yield _load(item, column, axis)


def held_loads(arm: SpatialArm, given: Mapping[str, float]) -> tuple[Load, ...]:
    """Return the loads that constant inputs hold."""
    return tuple(
        Load(each.column, each.body, given[each.column] * each.vector, each.world, each.arm, each.reach)
        for each in unit_loads(arm)
        if given.get(each.column, 0.0)
    )


def _load(item: ArmInput, column: str, vector: Array) -> Load:
    assert item.frame is not None
    body = item.frame.joint - 1
    world = item.axes == "world"
    seen = vector if world else np.array(item.frame.turn) @ vector
    if item.acts == "force":
        # power is the same on both sides, so forces pass by the transpose of what accelerations do
        passed = beside(item.frame.at).T[:, :3]
        return Load(column, body, seen, world, passed, float(np.linalg.norm(item.frame.at)))
    return Load(column, body, seen, world, np.eye(6)[:, 3:], 1.0)
