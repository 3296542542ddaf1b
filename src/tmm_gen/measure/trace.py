"""The motion of every link over a simulation."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.scene import Scene

Array = NDArray[np.float64]


@dataclass(eq=False)
class Trace:
    """Angles and rates, the hub's first where the base is a motor.

    Parameters
    ----------
    angle, rate : array, (k, m)
        rad, rad/s; filled one instant at a time.
    count : int
        Instants filled.
    """

    angle: Array
    rate: Array
    count: int = 0

    @classmethod
    def empty(cls, scene: Scene, instants: int) -> Trace:
        """Return room for some instants."""
        columns = scene.stations + (scene.base.kind == "motor")
        return cls(np.zeros((instants, columns)), np.zeros((instants, columns)))

    def add(self, state: Mapping[str, Any] | Any) -> None:
        """Keep a kernel's state.

        Parameters
        ----------
        state : mapping or object
            With `angle` and `rate`, and those of the hub if there is one; and the turns that are kept apart from
            its angles, if they are.
        """
        get = state.__getitem__ if isinstance(state, Mapping) else lambda name: getattr(state, name)
        moved = self.angle.shape[1] > len(np.atleast_1d(get("angle")))
        for target, name in ((self.angle, "angle"), (self.rate, "rate")):
            target[self.count] = [get(f"hub_{name}"), *get(name)] if moved else get(name)
        if isinstance(state, Mapping):
            self.angle[self.count] += state.get("turned", 0.0)
        else:
            self.angle[self.count] += getattr(state, "turned", 0.0)
        self.count += 1
