"""What controllers ask of an arm, planar or in space: its balance, its inertia, what a rigid motion of it takes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class SmallMotions(Protocol):
    """``M q'' + C q' + K q = 0`` for the arm's angles, (d, d) each."""

    @property
    def mass(self) -> Array:
        """``M``, kg m^2."""

    @property
    def damping(self) -> Array:
        """``C``, N m s/rad."""

    @property
    def stiffness(self) -> Array:
        """``K``, N m/rad."""


@dataclass(frozen=True, eq=False)
class Held:
    """An arm held still.

    Parameters
    ----------
    unbalanced : array, (d,)
        What turns each of its angles, N m; zero where it rests.
    matrices : SmallMotions
        Of small motion about it.
    """

    unbalanced: Array
    matrices: SmallMotions


class Holding(Protocol):
    """What holds up an arm that does not bend."""

    def weight(self, hub: Array) -> Array:
        """Return the torques of its motors with hubs somewhere, (m,), rad, (m,), N m."""
        ...


class ControlledArm(Protocol):
    """The arm of a scene with m motors; its d angles are those of the kernel's state."""

    def held(self, angles: Array, torques: Mapping[str, float]) -> Held:
        """Return it held still at some angles, (d,), rad, by torques of motors, N m, by their inputs' names."""
        ...

    def mass(self) -> Array:
        """Return the mass matrix where the scene starts, (d, d), kg m^2."""
        ...

    def level_mass(self) -> Array:
        """Return the mass matrix with all angles zero, (d, d), kg m^2."""
        ...

    def slowest(self) -> float:
        """Return its slowest natural frequency that is not zero, where the scene starts, rad/s."""
        ...

    def holding(self) -> Holding:
        """Return what holds it up."""
        ...

    def rigid_torques(self, hub: Array, rate: Array, acceleration: Array) -> Array:
        """Return the torques of motors for a motion in which nothing bends, (k, m), N m.

        Parameters
        ----------
        hub, rate, acceleration : array, (k, m)
            Of the hubs: rad, rad/s, rad/s^2.
        """
        ...

    def payloads(self) -> Mapping[str, float]:
        """Return the masses that are its payload, kg, by the keys that the scene has them under."""
        ...

    def falling(self, more: float) -> object:
        """Return the value of ``model.gravity`` with some m/s^2 more of it."""
        ...
