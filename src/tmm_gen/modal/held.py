"""How an arm is held in a static equilibrium, whatever kind it is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False, kw_only=True)
class Held:
    """How an arm is held.

    Parameters
    ----------
    falls : int
        Directions in which the arm falls over: 0 where it is stable.
    idle : array, (d, k)
        Motions of the free angles that nothing resists at all: the arm stays wherever it is put.
    reached : bool
        Whether a descent from the scene's initial angles ends there, or the search for it began near.
    """

    falls: int
    idle: Array
    reached: bool

    @property
    def stable(self) -> bool:
        """Whether the arm comes back from a small push, whatever its direction."""
        return self.falls == 0 and self.idle.shape[1] == 0

    @property
    def state(self) -> str:
        """Which of the three it is, in words."""
        return "stable" if self.stable else "falls over" if self.falls else "stays anywhere"

    def told(self, origin: str) -> str:
        """Return its state, and whether it is what was reached from an origin of some name."""
        return f"{self.state}, reached from {origin}" if self.reached else self.state
