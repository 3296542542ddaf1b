"""What `modes`, `frequency` and `stability` look at: an arm in space about its static equilibrium."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import UserError
from tmm_gen.modal.space.equilibrium import descended, nearest
from tmm_gen.modal.space.judged import require_energy, require_inertia
from tmm_gen.modal.space.matrices import SpaceMatrices, space_matrices
from tmm_gen.modal.space.numbers import ArmNumbers
from tmm_gen.modal.space.still import Still
from tmm_gen.scene import Scene
from tmm_gen.scene.spatial.arm import SpatialArm

Array = NDArray[np.float64]

MOST_JOINTS = 1500
"""Of what is done with dense matrices."""


@dataclass(frozen=True, eq=False)
class RestingArm:
    """A scene's arm in space in small motion.

    Parameters
    ----------
    scene : Scene
        Of kind "spatial".
    still : Still
        Where it rests.
    """

    scene: Scene
    still: Still

    @property
    def arm(self) -> SpatialArm:
        """Its joints and frames."""
        return self.still.numbers.arm

    @cached_property
    def linear(self) -> SpaceMatrices:
        """Its matrices."""
        return space_matrices(self.still)


def arm_numbers(scene: Scene) -> ArmNumbers:
    """Return a scene's arm in space as arrays.

    Raises
    ------
    UserError
        If its base moves, or it has more than `MOST_JOINTS` joints.
    """
    assert scene.spatial is not None
    if scene.prescribed is not None or scene.spatial.base is not None:
        raise UserError(
            f"scene '{scene.name}': small motion of an arm in space whose base moves is not there yet. Clamp it: "
            '`kind = "clamp"` under [base].'
        )
    found = ArmNumbers(scene.spatial)
    if found.size > MOST_JOINTS:
        raise UserError(
            f"scene '{scene.name}': small motion of {found.size} joints takes dense matrices; at most {MOST_JOINTS} "
            "are possible here. The error of frequencies falls with the square of a beam's cells: try fewer `links`."
        )
    return found


def rest_in_space(
    scene: Scene, inputs: Mapping[str, float] | None = None, start: Array | None = None
) -> Still:
    """Return where an arm in space comes to rest.

    Near the joints' angles of `start`, rad, where they are given, whether it falls over there or not. Else:

    Under gravity or constant inputs that is where no joint is out of balance. Without either its springs are slack, and
    what turns freely stands as at the scene's start.

    Raises
    ------
    UserError
        If there is no equilibrium.
    """
    numbers = arm_numbers(scene)
    held = {name: value for name, value in (inputs or {}).items() if value != 0.0}
    if start is not None:
        return nearest(numbers, held, start, scene.name)
    if any(numbers.arm.gravity) or held:
        return descended(numbers, held, numbers.start, scene.name)
    return Still(numbers, np.where(numbers.stiffness > 0.0, numbers.rest, numbers.start), {})


def resting_in_space(
    scene: Scene, inputs: Mapping[str, float] | None = None, start: Array | None = None
) -> RestingArm:
    """Return a scene's arm in small motion about where it rests, as of :func:`rest_in_space`.

    Raises
    ------
    UserError
        If there is no equilibrium, or none whose small motion can be judged.
    """
    still = require_inertia(rest_in_space(scene, inputs, start), scene.name)
    return RestingArm(scene, require_energy(still, scene.name))
