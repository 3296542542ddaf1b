"""An arm in space as controllers see it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.arm import Held, Holding
from tmm_gen.control.arm.motor_rows import Motors
from tmm_gen.control.arm.motors import motors_of
from tmm_gen.control.arm.payload_body import payload_body
from tmm_gen.control.arm.space_motors import outer_bodies
from tmm_gen.modal.space.matrices import space_matrices
from tmm_gen.modal.space.numbers import ArmNumbers
from tmm_gen.modal.space.still import Still
from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.scene import Scene

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class SpaceArm:
    """See :class:`tmm_gen.control.arm.arm.ControlledArm`; angles are those of its joints.

    Parameters
    ----------
    scene : Scene
        On a clamp.
    """

    scene: Scene

    @cached_property
    def _numbers(self) -> ArmNumbers:
        assert self.scene.spatial is not None
        return ArmNumbers(self.scene.spatial)

    @cached_property
    def _world(self) -> WorldArm:
        return WorldArm(self._numbers.arm)

    @cached_property
    def _motors(self) -> Motors:
        return motors_of(self.scene)

    def held(self, angles: Array, torques: Mapping[str, float]) -> Held:
        """Return it held still at some angles by torques."""
        still = Still(self._numbers, angles, torques)
        return Held(still.unbalanced, space_matrices(still))

    def mass(self) -> Array:
        """Return the mass matrix where the scene starts."""
        return Still(self._numbers, self._numbers.start, {}).mass

    def level_mass(self) -> Array:
        """Return the mass matrix with all angles zero."""
        return Still(self._numbers, np.zeros(self._numbers.size), {}).mass

    def slowest(self) -> float:
        """Return its slowest natural frequency that is not zero, with nothing but its springs to hold it."""
        from scipy.linalg import eigh  # slow to import

        squares = eigh(np.diag(self._numbers.stiffness), self.mass(), eigvals_only=True)
        springs = int(np.count_nonzero(self._numbers.stiffness))
        first = squares[len(squares) - springs] if springs else 1.0  # of a rigid arm, at 1 rad/s
        return float(np.sqrt(first))

    def holding(self) -> Holding:
        """Return what holds it up: what its motors would, were it rigid."""
        return RigidHolding(self)

    def rigid_torques(self, hub: Array, rate: Array, acceleration: Array) -> Array:
        """Return the torques of motors for a motion in which nothing bends."""
        angles = self._world.rest + (hub - self._motors.hub @ self._world.rest) @ self._motors.turned.T
        rates, wanted = (each @ self._motors.turned.T for each in (rate, acceleration))
        lacking = np.asarray(self._world.inverse_dynamics(angles, rates, wanted, {}), float)
        return np.asarray(lacking @ self._motors.turned / self._motors.gears, float)

    def payloads(self) -> Mapping[str, float]:
        """Return the mass of the body told to be it, or of those outermost on their branches; frames have none."""
        entries: Any = self.scene.source.data.get("body", [])
        masses = {entry["name"]: entry["mass"] for entry in entries if "mass" in entry}
        told = payload_body(self.scene)
        names = outer_bodies(self.scene) if told is None else (told,)
        return {f"body.{name}.mass": masses[name] for name in names if name in masses}

    def falling(self, more: float) -> list[float]:
        """Return gravity with some more of it along -z, m/s^2."""
        x, y, z = self._numbers.arm.gravity
        return [x, y, z - more]


@dataclass(frozen=True, eq=False)
class RigidHolding:
    """What holds up an arm that does not bend.

    Parameters
    ----------
    arm : SpaceArm
        That bends.
    """

    arm: SpaceArm

    def weight(self, hub: Array) -> Array:
        """Return the torques that hold it up with its hubs there, rad, (m,), N m."""
        still = np.zeros((1, len(hub)))
        return np.asarray(self.arm.rigid_torques(hub[None], still, still)[0], float)
