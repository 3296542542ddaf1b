"""Where a part of a planar arm is, and what moves it there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.scene import Scene

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class PlaneFrame:
    """A part's outer end.

    Parameters
    ----------
    lengths : array, (d,)
        Of the links from the base to it, zero beyond, m.
    last : int
        Which of the angles is that of the link it is on.
    """

    lengths: Array
    last: int

    @classmethod
    def of(cls, scene: Scene, name: str) -> PlaneFrame:
        """Return the frame of a beam, link or body of an arm by parts without branches."""
        last = next(part.last for part in scene.parts if part.name == name)
        lengths = np.array([link.length for link in scene.links])
        lengths[last:] = 0.0
        return cls(lengths, last - 1)

    def place(self, angles: Array) -> Array:
        """Return where it is, (2,) or (k, 2), m, for the arm's angles, (d,) or (k, d), rad."""
        return np.asarray(self.place_of(angles), float)

    def place_of(self, angles: NDArray[Any]) -> NDArray[Any]:
        """Return the same of angles that may be symbols."""
        return np.stack([np.cos(angles) @ self.lengths, np.sin(angles) @ self.lengths], axis=-1)

    def slopes(self, angles: Array) -> Array:
        """Return the derivatives of its place by the angles, (2, d) or (k, 2, d)."""
        return np.stack([-np.sin(angles) * self.lengths, np.cos(angles) * self.lengths], axis=-2)

    def turn_to(self, angles: Array, orientation: Array) -> Array:
        """Return by what it is to turn to stand at an angle, (1,), rad: the shorter way round."""
        return np.asarray((orientation - angles[self.last] + np.pi) % (2.0 * np.pi) - np.pi, float)

    def turns(self, angles: Array) -> Array:
        """Return how it turns as each angle grows, (1, d)."""
        return np.eye(1, len(angles), self.last)
