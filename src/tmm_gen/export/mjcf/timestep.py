"""The time step at which MuJoCo's RK4 follows an arm."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.arm import linear_arm
from tmm_gen.modal.matrices import matrices
from tmm_gen.reference.spatial_afloat import joint_mass
from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.scene import Scene

Matrix = NDArray[np.float64]

_LARGEST = 1.0
"""Of the largest eigenvalue times the step: RK4 is stable up to 2.78 on the negative real axis (2.83 on the
imaginary one), and a bent arm is stiffer than a straight one."""


def stable_timestep(scene: Scene) -> float:
    """Return the scene's step, or the largest of its 1/2, 1/5, 1/10, 1/20, ... that RK4 can take.

    Parameters
    ----------
    scene : Scene
        Linearised where it starts.

    Returns
    -------
    float
        s.
    """
    mass, stiffness, damping = _linear(scene)
    count = len(mass)
    inverse = np.linalg.inv(mass)
    system = np.block(
        [
            [np.zeros((count, count)), np.eye(count)],
            [-inverse @ stiffness, -inverse @ damping],
        ]
    )
    fastest = float(np.max(np.abs(np.linalg.eigvals(system))))
    needed = scene.integrator.step * fastest / _LARGEST
    power = 1
    while True:
        for parts in (power, 2 * power, 5 * power):
            if parts >= needed:
                return scene.integrator.step / parts
        power *= 10


def _linear(scene: Scene) -> tuple[Matrix, Matrix, Matrix]:
    """Return mass, stiffness and damping matrices about the start; in space, of the arm held there."""
    if scene.spatial is None:
        found = matrices(linear_arm(scene))
        return found.mass, found.stiffness, found.damping
    arm = WorldArm(scene.spatial)
    if scene.spatial.base is not None:  # it falls, and weighs nothing
        return joint_mass(scene.spatial), np.diag(arm.stiffness), np.diag(arm.damping)
    angles, rates = (np.array([getattr(j, key) for j in scene.spatial.joints]) for key in ("angle", "rate"))
    stiffness, damping = arm.tangents(angles, rates, np.zeros_like(angles), {})
    return arm.mass_matrix(angles), stiffness, damping
