"""What `modes`, `frequency` and `stability` look at: an arm in space about its static equilibrium."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import UserError
from tmm_gen.modal.modes import Mode, find_modes
from tmm_gen.modal.space.equilibrium import descended, nearest
from tmm_gen.modal.space.held_base import held_base
from tmm_gen.modal.space.judged import require_energy, require_inertia
from tmm_gen.modal.space.loads import unit_loads
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
        """Its matrices by the joints' angles; a base that floats follows them."""
        return space_matrices(self.still)

    def modes(self, count: int | None = None) -> tuple[Mode, ...]:
        """Return the lowest modes, all by default; those in which an arm moves as a whole come besides.

        Shapes, (6 + n,), say how the base moves and turns, in its own axes, and each joint turns.
        """
        own = np.eye(6, 6 + len(self.arm.joints))[: self.whole]
        whole = [Mode(0.0, None, (0j, 0j), shape) for shape in own]
        return (*whole, *(self._followed(mode) for mode in find_modes(self.linear, count)))

    @property
    def whole(self) -> int:
        """In how many ways the arm moves along and turns as a whole: 6 where the base floats, else 0."""
        return 6 if self.still.numbers.floats else 0

    def _followed(self, mode: Mode) -> Mode:
        return replace(mode, shape=np.concatenate([self.still.following @ mode.shape, mode.shape]))


def arm_numbers(scene: Scene, inputs: Mapping[str, float] | None = None) -> ArmNumbers:
    """Return a scene's arm in space as arrays; a prescribed base is held at its angle.

    Raises
    ------
    UserError
        If it has more than `MOST_JOINTS` joints, or nothing holds it against what is to act on it.
    """
    assert scene.spatial is not None
    given = inputs or {}
    found = ArmNumbers(
        *held_base(scene.spatial, given.get(scene.prescribed.name, 0.0) if scene.prescribed else 0.0)
    )
    pushing = [load.column for load in unit_loads(found.arm) if given.get(load.column, 0.0)]
    if found.floats and pushing:
        raise UserError(
            f"scene '{scene.name}': nothing holds the base, so that what --input gives at {', '.join(pushing)} moves "
            "the arm on and on, and it has no rest. Leave it out; torques in joints have one."
        )
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
    numbers = arm_numbers(scene, inputs)
    held = {name: value for name, value in (inputs or {}).items() if value != 0.0}
    if start is not None:
        return nearest(numbers, held, start, scene.name)
    if np.any(numbers.gravity) or held:
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
