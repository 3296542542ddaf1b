"""What `modes` and `frequency` look at: a scene's arm in small motion, and where it rests."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import UserError
from tmm_gen.modal.arm import LinearArm, linear_arm
from tmm_gen.modal.equilibrium import equilibrium, nearest
from tmm_gen.modal.rest import Rest, rest_at, slack
from tmm_gen.scene import Scene

Array = NDArray[np.float64]


def resting_arm(
    scene: Scene, inputs: Mapping[str, float] | None = None, start: Array | None = None
) -> LinearArm:
    """Return a scene's linear arm: a chain, or a planar arm about its static equilibrium.

    Parameters
    ----------
    scene : Scene
        Chain or planar.
    inputs : mapping from str to float, optional
        Constant inputs of a planar arm by name.
    start : array, optional
        Free angles near which it rests, rad; by default as of :func:`rest_of`.

    Raises
    ------
    UserError
        If there is no equilibrium.
    """
    return linear_arm(scene, rest_of(scene, inputs, start))


def rest_of(
    scene: Scene, inputs: Mapping[str, float] | None = None, start: Array | None = None
) -> Rest | None:
    """Return where a planar arm comes to rest; None for a chain, whose small motion is the same about any.

    Near the free angles of `start`, rad, where they are given, whether it falls over there or not. Else:

    Under gravity or constant inputs that is where no link is out of balance. Without either its springs are slack: it
    lies straight along x, unless joints have a `rest` or turn freely.
    """
    if scene.model.linear:
        return None
    held = {name: value for name, value in (inputs or {}).items() if value != 0.0}
    if start is not None:
        return nearest(scene, held, start)
    if scene.model.gravity or held:
        return equilibrium(scene, held)
    return rest_at(scene, slack(scene))


def require_weight(scene: Scene) -> Scene:
    """Return a scene whose arm has equilibria to be found.

    Raises
    ------
    UserError
        If it is a chain.
    """
    if scene.model.linear:
        raise UserError(
            f"{scene.source.origin}: a chain has no weight and rests straight, or as its inputs twist it: "
            "`tmm-gen run` shows that. Name a planar scene, or one in space."
        )
    return scene
