"""Where the joints of an arm in space are over time: what its pictures are drawn from."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.report.spread import spread
from tmm_gen.scene.spatial.arm import SpatialArm
from tmm_gen.scene.spatial.reach import longest_way
from tmm_gen.simulate.simulation import Simulation
from tmm_gen.simulate.skeleton import Skeleton

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class SpaceMotion:
    """An arm in space at some instants.

    Parameters
    ----------
    arm : SpatialArm
    time : array, (k,)
        s, from 0 on.
    angles : array, (k, n)
        Of its joints, rad; (k, 7 + n) where its base floats, its place and quaternion first.
    carried : array, (k, 3), optional
        How far the base is moved along as prescribed, m; not at all if left out.
    """

    arm: SpatialArm
    time: Array
    angles: Array
    carried: Array | None = None

    @cached_property
    def skeleton(self) -> Skeleton:
        """Its points and lines."""
        return Skeleton(self.arm)

    @property
    def points(self) -> Array:
        """Where the spots of its skeleton are, (k, m, 3), m."""
        return self.places[0]

    @cached_property
    def places(self) -> tuple[Array, Array]:
        """Where its spots are and the outer ends of its pins, (k, ..., 3) each, m."""
        points, ends = self.skeleton.places(self.angles)
        if self.carried is None:
            return points, ends
        return points + self.carried[:, None], ends + self.carried[:, None]

    @property
    def reach(self) -> float:
        """The longest way along it, m; 1 where it has no length."""
        return longest_way(self.arm) or 1.0

    @property
    def upward(self) -> tuple[int, int]:
        """The world axis nearest to upward, against gravity, and its sign; z where nothing falls."""
        gravity = self.arm.gravity
        axis = max(range(3), key=lambda axis: (abs(gravity[axis]), axis))
        return axis, 1 if gravity[axis] <= 0.0 else -1

    def thinned(self, most: int) -> SpaceMotion:
        """Return it at so many instants at most, the first and the last among them."""
        shown = spread(self.time, most)
        carried = None if self.carried is None else self.carried[shown]
        return SpaceMotion(self.arm, self.time[shown], self.angles[shown], carried)


def space_motion(simulation: Simulation) -> SpaceMotion:
    """Return the motion of a simulation.

    Parameters
    ----------
    simulation : Simulation
        Of an arm in space, traced.

    Raises
    ------
    ValueError
        If it is of no arm in space, or was not traced.
    """
    arm, trace = simulation.scene.spatial, simulation.trace
    if arm is None or trace is None:
        raise ValueError("the motion was not traced" if arm else "this is no arm in space")
    shown = trace.indices.astype(int)
    carried = None
    if any(arm.along):
        still = np.zeros(len(shown))
        along = [simulation.inputs[item.name][shown] if item else still for item in arm.along]
        carried = np.stack(along, axis=1)
    return SpaceMotion(arm, simulation.time[shown], trace.angle, carried)
