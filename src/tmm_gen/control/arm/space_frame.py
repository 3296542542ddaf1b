"""Where a part of an arm in space is, and what moves it there."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from tmm_gen.reference.spatial_places import Tree, cross
from tmm_gen.scene.spatial.arm import Frame, SpatialArm

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class SpaceFrame:
    """A part's outer end; angles are those of the arm's joints.

    Parameters
    ----------
    arm : SpatialArm
        On a clamp.
    frame : Frame
        Of the part.
    """

    arm: SpatialArm
    frame: Frame

    @classmethod
    def of(cls, arm: SpatialArm, name: str) -> SpaceFrame:
        """Return the frame of a part by its name."""
        return cls(arm, next(frame for frame in arm.frames if frame.name == name))

    @cached_property
    def _tree(self) -> Tree:
        return Tree(self.arm)

    @cached_property
    def joints(self) -> tuple[int, ...]:
        """The joints on the way from the base to it, counted from 0, from the base outward."""
        return tuple(int(joint) for joint in np.flatnonzero(self._tree.ways[self.frame.joint - 1]))

    def place(self, angles: Array) -> Array:
        """Return where it is, (..., 3), m, for the arm's angles, (..., d), rad."""
        return np.asarray(self.place_of(angles), float)

    def place_of(self, angles: NDArray[Any]) -> NDArray[Any]:
        """Return the same of angles that may be symbols."""
        return self._tree.places(angles).frame(self.frame)[1]

    def slopes(self, angles: Array) -> Array:
        """Return the derivatives of its place by the angles, (..., 3, d): what each joint turns about itself."""
        places = self._tree.places(angles)
        lever = places.frame(self.frame)[1][..., None, :] - places.point
        moved = cross(places.axis, lever) * self._tree.ways[self.frame.joint - 1][:, None]
        return np.asarray(np.swapaxes(moved, -1, -2), float)

    def turn_to(self, angles: Array, orientation: Array) -> Array:
        """Return about what, and by how much, it is to turn to stand like a quaternion (w, x, y, z), (3,), rad.

        In the axes of the world, the shorter way round.
        """
        w, x, y, z = orientation
        wanted = Rotation.from_quat([x, y, z, w])
        turned = Rotation.from_matrix(self._tree.places(angles).frame(self.frame)[0])
        return np.asarray((wanted * turned.inv()).as_rotvec(), float)

    def turns(self, angles: Array) -> Array:
        """Return how it turns in the axes of the world as each joint does, (3, d)."""
        ways = self._tree.ways[self.frame.joint - 1]
        return np.asarray((self._tree.places(angles).axis * ways[:, None]).T, float)
