"""Rest as a scene's generated NumPy kernel sees it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.equilibrium import Unbalanced
from tmm_gen.native.python_module import numpy_module
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

_SHORT = 1e-8
"""Step in which nothing moves, s: angles change by its square."""


def kernel_unbalanced(scene: Scene, inputs: Mapping[str, float] | None = None) -> Unbalanced:
    """Return the torque out of balance that the scene's generated NumPy kernel sees.

    The kernel gives the accelerations of an arm let go at some angles; times the mass matrix they are the torques.

    Parameters
    ----------
    scene : Scene
        Of kind "planar".
    inputs : mapping from str to float, optional
        Constant inputs by name; those not given are zero.
    """
    accelerations = kernel_accelerations(scene, inputs)
    return lambda rest, linear: linear.mass @ accelerations(rest.free_angles)


def kernel_accelerations(scene: Scene, inputs: Mapping[str, float] | None = None) -> Callable[[Array], Array]:
    """Return the generated NumPy kernel's map from the free angles to their accelerations, rad/s^2.

    ``initialise`` answers for a base that is held. It starts a free hub at angle zero, so a motor's arm, hub
    first, is let go for one step too short to move.
    """
    if scene.hub:
        scene = scene.replace(**{"integrator.name": "newmark", "model.linearisation": "newton"})
    module = numpy_module(scene)
    held = module.Input(**{item.name: (inputs or {}).get(item.name, 0.0) for item in scene.inputs})

    def held_base(angles: Array) -> Array:
        state = module.initialise(module.Params(), held, initial_angle=angles)
        return np.array(state.acceleration, float)

    if not scene.hub:
        return held_base
    short = module.prepare(step=_SHORT)
    rest = module.initialise(module.Params(), held)

    def free_hub(angles: Array) -> Array:
        still = {"rate": np.zeros(angles.size - 1), "acceleration": np.zeros(angles.size - 1)}
        hub = {"hub_angle": angles[0], "hub_rate": 0.0, "hub_acceleration": 0.0}
        after = module.step(short, replace(rest, angle=angles[1:], **still, **hub), held)
        return np.array([after.hub_acceleration, *after.acceleration], float)

    return free_hub
