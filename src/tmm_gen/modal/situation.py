"""What `modes` and `frequency` look at: a scene's arm in small motion, and where it rests."""

from __future__ import annotations

from collections.abc import Mapping

from tmm_gen.modal.arm import LinearArm, linear_arm
from tmm_gen.modal.equilibrium import equilibrium
from tmm_gen.modal.rest import Rest, rest_at, slack
from tmm_gen.scene import Scene


def resting_arm(scene: Scene, inputs: Mapping[str, float] | None = None) -> LinearArm:
    """Return a scene's linear arm: a chain, or a planar arm about its static equilibrium.

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
    return linear_arm(scene, None if scene.model.linear else rest_of(scene, inputs))


def rest_of(scene: Scene, inputs: Mapping[str, float] | None = None) -> Rest:
    """Return where a planar arm comes to rest.

    Under gravity or constant inputs that is where no link is out of balance. Without either its springs are slack: it
    lies straight along x, unless joints have a `rest` or turn freely.
    """
    held = {name: value for name, value in (inputs or {}).items() if value != 0.0}
    if scene.model.gravity or held:
        return equilibrium(scene, held)
    return rest_at(scene, slack(scene))
