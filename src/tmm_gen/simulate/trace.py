"""The motion of every link over a simulation."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import UserError
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

MOST = 20_000_000
"""Steps whose outputs are sure to fit in memory."""

BASE = tuple(
    f"base_{word}" for word in (*(f"place_{x}" for x in "xyz"), *(f"quaternion_{x}" for x in "wxyz"))
)
"""State of a base that floats in space: where it is."""


@dataclass(eq=False)
class Trace:
    """Angles and rates, the hub's first where the base is a motor.

    Parameters
    ----------
    angle, rate : array, (k, m)
        rad, rad/s; filled as steps are taken. Rates are zero where the integrator remembers none. Of a base that
        floats in space place and quaternion come first, with rates of zero.
    every : int
        How many steps lie from one instant to the next.
    count : int
        States seen so far, the start among them.
    """

    angle: Array
    rate: Array
    every: int = 1
    count: int = 0

    @classmethod
    def empty(cls, scene: Scene, instants: int, every: int = 1) -> Trace:
        """Return room for the start and what each so many of some steps lead to."""
        afloat = scene.spatial is not None and scene.spatial.base is not None
        columns = scene.stations + scene.hub + len(BASE) * afloat
        kept = (instants - 1) // every + 1
        return cls(np.zeros((kept, columns)), np.zeros((kept, columns)), every)

    @property
    def indices(self) -> Array:
        """Numbers of the steps that the instants lie behind, (k,)."""
        return self.every * np.arange(len(self.angle), dtype=float)

    def thinned(self, every: int) -> Trace:
        """Return the motion at every so manieth of its instants, as if no others had been."""
        return Trace(self.angle[::every], self.rate[::every], self.every, math.ceil(self.count / every))

    def add(self, state: Mapping[str, Any] | Any) -> None:
        """Keep a kernel's state: `angle` and `rate`, those of a hub, and turns that are kept apart from angles."""
        named = state if isinstance(state, Mapping) else vars(state)
        self.extend({name: np.asarray(value)[None] for name, value in named.items()})

    def extend(self, states: Mapping[str, Array]) -> None:
        """Keep states of a kernel, (k, ...) by name, one a step."""
        found = states["angle"] if states["angle"].ndim > 1 else states["angle"][:, None]
        first = -self.count % self.every
        place = slice((self.count + first) // self.every, (self.count + len(found) - 1) // self.every + 1)
        self.count += len(found)
        if len(found) <= first:
            return
        hub = self.angle.shape[1] - found.shape[1]
        if hub == len(BASE):
            self.angle[place, :hub] = np.stack([states[name][first :: self.every] for name in BASE], axis=1)
        for target, name in ((self.angle, "angle"), (self.rate, "rate")):
            if name in states:
                target[place, hub:] = states[name].reshape(found.shape)[first :: self.every]
            if hub == 1 and f"hub_{name}" in states:
                target[place, 0] = states[f"hub_{name}"][first :: self.every]
        if "turned" in states:
            turned = states["turned"][first :: self.every]
            self.angle[place] += turned if turned.ndim > 1 else turned[:, None]


def room_for(scene: Scene, steps: int, *, whole: bool) -> Trace:
    """Return room for the motion of all links, at every instant if need be or if there is room.

    Parameters
    ----------
    scene : Scene
        Whose links move.
    steps : int
        How many are taken.
    whole : bool
        Whether every instant is needed.

    Raises
    ------
    UserError
        If every instant is needed and there is no room.
    """
    if steps * scene.stations <= MOST:
        return Trace.empty(scene, steps + 1)
    if whole:
        raise UserError(
            f"the motion of {scene.stations} links over {steps} steps is too much to keep. "
            "Simulate a shorter time (--until) or take larger steps (--step)."
        )
    return Trace.empty(scene, steps + 1, math.ceil(steps * scene.stations / MOST))
