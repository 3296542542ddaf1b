"""What `modes` and `frequency` look at: a scene's arm in small motion, and where it rests."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from tmm_gen.modal.arm import LinearArm, linear_arm
from tmm_gen.modal.equilibrium import equilibrium
from tmm_gen.modal.rest import rest_at, straight
from tmm_gen.scene import Scene


def resting_arm(scene: Scene, inputs: Mapping[str, float] | None = None) -> LinearArm:
    """Return a scene's linear arm: a chain, or a planar arm about its static equilibrium.

    Under gravity or constant inputs the equilibrium is where no link is out of balance. Without either the arm lies
    straight along x.

    Parameters
    ----------
    scene : Scene
        Chain or planar.
    inputs : mapping from str to float, optional
        Constant inputs of a planar arm by name.

    Raises
    ------
    UserError
        If there is no equilibrium.
    """
    if scene.model.linear:
        return linear_arm(scene)
    held = {name: value for name, value in (inputs or {}).items() if value != 0.0}
    if not scene.model.gravity and not held:
        return linear_arm(scene, rest_at(scene, np.zeros_like(straight(scene))))
    return linear_arm(scene, equilibrium(scene, held))
