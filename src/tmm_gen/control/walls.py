"""Half-planes and half-spaces that parts of the arm are to stay in: how far along the normals, and what turns them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.reach import Frame
from tmm_gen.control.space_frame import SpaceFrame
from tmm_gen.scene import Scene
from tmm_gen.scene.trajectory import Keep

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Wall:
    """A half-plane, or in space a half-space, and the part that stays in it.

    Parameters
    ----------
    frame : Frame or SpaceFrame
        Outer end of the part.
    normal : array, (2,) or (3,)
        Of length 1, away from the wall.
    offset : float
        Of the wall along it, m.
    """

    frame: Frame | SpaceFrame
    normal: Array
    offset: float

    @classmethod
    def of(cls, scene: Scene, keep: Keep) -> Wall:
        """Return a wall of a scene, or of one of the same parts in other links."""
        normal, arm = np.array(keep.normal), scene.spatial
        frame = Frame.of(scene, keep.frame) if arm is None else SpaceFrame.of(arm, keep.frame)
        normal /= np.max(
            np.abs(normal)
        )  # of any length: squares of what is very long or short leave the range
        return cls(frame, normal / np.linalg.norm(normal), keep.offset)

    def along(self, angles: Array) -> Array:
        """Return how far the part is along the normal, (k,), m, for angles of the arm, (k, d), rad."""
        return np.asarray(self.frame.place(angles) @ self.normal, float)

    def slopes(self, angles: Array) -> Array:
        """Return the derivatives by the angles, (k, d)."""
        return np.asarray(np.einsum("i,kid->kd", self.normal, self.frame.slopes(angles)), float)
