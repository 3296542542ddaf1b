"""About where an arm is taken in small motion."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from tmm_gen.api.given import free_angles, named, number
from tmm_gen.api.rest import Equilibrium
from tmm_gen.control.arm.linear_model import LinearModel
from tmm_gen.control.arm.small_motion import SmallMotion
from tmm_gen.errors import UserError
from tmm_gen.modal.situation import rest_of
from tmm_gen.modal.space.situation import resting_in_space
from tmm_gen.scene import Scene

__all__ = ["linearised"]

Array = NDArray[np.float64]


def linearised(
    scene: Scene,
    small: Callable[[], SmallMotion],
    at: object,
    given: Mapping[str, object] | None,
    more: Mapping[str, object],
) -> LinearModel:
    """Return a scene's arm in small motion, which is derived if there is a use for it.

    Other arguments are those of :meth:`tmm_gen.Arm.linearise`.
    """
    held = {name: number(name, value) for name, value in named(scene, given, more).items()}
    if isinstance(at, Equilibrium):
        angles = _fitting(scene, at)
        return small().about(angles, {**at.inputs, **held})
    if isinstance(at, Mapping):
        near = free_angles(scene, at)
        return small().about(near, held)
    if isinstance(at, str) and at == "start":
        return small().about(None, held, still=False)
    if isinstance(at, str) and at == "rest":
        resting = _resting(scene, held)
        return small().about(resting, held)
    raise UserError(
        f"at: must be 'rest', 'start', angles of joints such as {{'elbow': 0.5}}, or one of rest(), not {at!r}."
    )


def _resting(scene: Scene, held: Mapping[str, float]) -> Array | None:
    """Return the free angles at which an arm comes to rest; None of a chain, which is the same anywhere."""
    if scene.spatial is not None:
        with np.errstate(all="ignore"):  # what overflows is refused
            return resting_in_space(scene, held).still.angles
    resting = rest_of(scene, held)
    return None if resting is None else resting.free_angles


def _fitting(scene: Scene, at: Equilibrium) -> Array:
    """Return the free angles of an equilibrium, of this arm."""
    unknown = [name for name in at.inputs if name not in [item.name for item in scene.inputs]]
    free = _size(scene)
    if len(at.free_angles) != free or unknown:
        raise UserError(
            f"at: this equilibrium has {len(at.free_angles)} free angles and the arm {free}: it is another arm's. "
            "Take one of this arm's rest()."
        )
    return at.free_angles


def _size(scene: Scene) -> int:
    """Return the number of angles that rest decides."""
    if scene.spatial is not None:
        return sum(not joint.given for joint in scene.spatial.joints)
    return scene.stations + scene.hub
