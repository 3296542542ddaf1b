"""What holds an arm up, by its payload."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import product

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.arm import ControlledArm, Holding
from tmm_gen.control.arm.arms import arm_of
from tmm_gen.control.arm.motors import motors_of
from tmm_gen.control.arm.payload import laden, payload_of
from tmm_gen.control.arm.payload_body import payload_words
from tmm_gen.control.task.terms import Goal
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

_NOTHING = 1e-12
"""Torque relative to the largest that is rounding."""

_SAME = 1e-9
"""Change of moments of inertia relative to the largest that is rounding."""


@dataclass(frozen=True, eq=False)
class Lift:
    """What holds up a rigid arm: periodic in each hub's angle, of first order; it grows evenly with the payload.

    Parameters
    ----------
    motors : int
        m.
    arm : ControlledArm
        With the scene's payload.
    heavier : ControlledArm or None
        With a kilogram more; None where the arm has no one mass at its end.
    payload : float or None
        That mass, kg.
    words : str
        What it is called.
    """

    motors: int
    arm: ControlledArm
    heavier: ControlledArm | None
    payload: float | None
    words: str

    @classmethod
    def of(cls, scene: Scene) -> Lift:
        """Return that of a scene with ``[control]``."""
        payload = payload_of(scene)
        heavier = None if payload is None else arm_of(laden(scene, payload + 1.0))
        return cls(motors_of(scene).count, arm_of(scene), heavier, payload, payload_words(scene))

    @cached_property
    def holding(self) -> Holding:
        """What holds it up with the scene's payload."""
        return self.arm.holding()

    @cached_property
    def holding_heavier(self) -> Holding:
        """The same with a kilogram more, where the arm may carry that."""
        return self.holding if self.heavier is None else self.heavier.holding()

    @cached_property
    def carries(self) -> bool:
        """Whether another payload makes a difference."""
        turns = 2.0 * np.pi * np.arange(3) / 3.0
        hubs = [np.array(each) for each in product(turns, repeat=self.motors)]
        heavy = np.array([self.holding_heavier.weight(hub) for hub in hubs])
        more = heavy - [self.holding.weight(hub) for hub in hubs]
        return bool(np.max(np.abs(more)) > _NOTHING * np.max(np.abs(heavy)))

    def payloads(self, hub: Array, lighter: float, heavier: float) -> tuple[float, float]:
        """Return the least and the largest payload, kg, with which every motor turns about what it does by the scene's.

        Parameters
        ----------
        hub : array, (m,)
            Where the hubs are, rad.
        lighter, heavier : float
            Least and largest moment of inertia of what a motor turns, relative to that with the scene's payload.
        """
        assert self.heavier is not None
        assert self.payload is not None
        own, heavy = (np.diag(_inertias(arm, hub)) for arm in (self.arm, self.heavier))
        share = heavy / own - 1.0  # for a kilogram
        largest = float(np.max(share))
        least, most = self.payload + (lighter - 1.0) / largest, self.payload + (heavier - 1.0) / largest
        return max(0.0, least), most

    def free(self, hub: Array) -> NDArray[np.bool_]:
        """Return which motors, (m,), may turn as far as they like: nothing but weight sees it, from hubs somewhere.

        The first does, that turns the whole arm. What inertia depends on is periodic of second order.
        """
        own, turns = _inertias(self.arm, hub), 2.0 * np.pi * np.arange(1, 5) / 5.0
        changed = [
            max(float(np.max(np.abs(_inertias(self.arm, hub + turn * each) - own))) for turn in turns)
            for each in np.eye(self.motors)
        ]
        return np.array(changed) <= _SAME * float(np.max(np.abs(own)))

    def weight(self, hub: Array, more: float = 0.0) -> Array:
        """Return the torques that hold up the rigid arm with hubs somewhere, (m,), rad, and some kg more, (m,), N m."""
        found = self.holding.weight(hub)
        return found + more * (self.holding_heavier.weight(hub) - found) if more else found

    def beside(self, goal: Goal) -> Array:
        """Return what the torques at a goal are beside those of the rigid arm, (m,), N m: what bending takes."""
        return np.asarray(goal.torque - self.holding.weight(goal.hub), float)

    def torque(self, goal: Goal, hub: Array) -> Array:
        """Return the torques that hold an arm whose hubs are elsewhere than at the goal, (m,), N m."""
        return self.beside(goal) + self.holding.weight(hub)


def _inertias(arm: ControlledArm, hub: Array) -> Array:
    """Return the mass matrix of a rigid arm by its motors' torques, (m, m), kg m^2."""
    count = len(hub)
    hubs, still = np.tile(hub, (count, 1)), np.zeros((count, count))
    return np.asarray(
        arm.rigid_torques(hubs, still, np.eye(count)) - arm.rigid_torques(hubs, still, still), float
    )
