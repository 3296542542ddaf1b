"""An arm in a plane as controllers see it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.arm import Held, Holding
from tmm_gen.control.arm.holding import LevelHolding, holding
from tmm_gen.control.arm.motors import motors_of
from tmm_gen.control.arm.payload_body import payload_body, tip_bodies
from tmm_gen.modal.arm import linear_arm
from tmm_gen.modal.matrices import matrices
from tmm_gen.modal.rest import rest_at
from tmm_gen.scene import Scene

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class PlanarArm:
    """See :class:`tmm_gen.control.arm.arm.ControlledArm`; angles are those of a hub and the links.

    Parameters
    ----------
    scene : Scene
        With ``[control]``.
    """

    scene: Scene

    def held(self, angles: Array, torques: Mapping[str, float]) -> Held:
        """Return it held still at some angles by torques."""
        rest = rest_at(self.scene, angles, inputs=dict(torques))
        return Held(rest.unbalanced, matrices(linear_arm(self.scene, rest)))

    def mass(self) -> Array:
        """Return the mass matrix where the scene starts."""
        return matrices(linear_arm(self.scene)).mass

    def level_mass(self) -> Array:
        """Return the mass matrix of the arm as it starts: what the integrator does of it is the same anywhere."""
        return self.mass()

    def slowest(self) -> float:
        """Return its slowest natural frequency that is not zero."""
        from tmm_gen.reference.planar_linear import vibration

        frequencies = vibration(self.scene).frequencies
        return float(frequencies[frequencies > 0.0][0])

    def holding(self) -> Holding:
        """Return what holds it up: what each motor carries, laid level, by the cosine of its angle."""
        return LevelHolding(holding(self.scene))

    def rigid_torques(self, hub: Array, rate: Array, acceleration: Array) -> Array:
        """Return the torques of motors for a motion in which nothing bends."""
        from tmm_gen.reference.planar_arm import Arm

        scene, motors = self.scene, motors_of(self.scene)
        angles, rates, wanted = (each @ motors.turned.T for each in (hub, rate, acceleration))
        left = wanted - Arm(scene, {}).accelerations(np.zeros(len(hub)), angles, rates)
        masses = [matrices(linear_arm(scene, rest_at(scene, each))).mass for each in angles]
        forces = np.einsum("kij,kj->ki", np.array(masses), left)
        return np.asarray(forces @ motors.turned / motors.gears, float)

    def payloads(self) -> Mapping[str, float]:
        """Return the mass of the body that is told to be it, or all masses at the tip."""
        scene = self.scene
        if scene.tip is None:
            return {}
        if not scene.parts:
            return {"tip.mass": scene.tip.mass}
        masses, told = tip_bodies(scene), payload_body(scene)
        return {f"body.{name}.mass": mass for name, mass in masses.items() if told in (None, name)}

    def falling(self, more: float) -> float:
        """Return gravity along -y with some more of it, m/s^2."""
        return (self.scene.model.gravity or 0.0) + more
