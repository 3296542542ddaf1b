"""The time step at which MuJoCo's RK4 follows an arm."""

from __future__ import annotations

import numpy as np

from tmm_gen.modal.arm import linear_arm
from tmm_gen.modal.matrices import matrices
from tmm_gen.scene import Scene

_LARGEST = 1.0
"""Of the largest eigenvalue times the step: RK4 is stable up to 2.78 on the negative real axis (2.83 on the
imaginary one), and a bent arm is stiffer than a straight one."""


def stable_timestep(scene: Scene) -> float:
    """Return the scene's step, or the largest of its 1/2, 1/5, 1/10, 1/20, ... that RK4 can take.

    Parameters
    ----------
    scene : Scene
        A chain, or a planar arm, linearised where it starts.

    Returns
    -------
    float
        s.
    """
    linear = matrices(linear_arm(scene))
    count = len(linear.mass)
    inverse = np.linalg.inv(linear.mass)
    system = np.block(
        [
            [np.zeros((count, count)), np.eye(count)],
            [-inverse @ linear.stiffness, -inverse @ linear.damping],
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
