"""Where a search for rest starts: the scene's start, with some joints set by name."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import UserError
from tmm_gen.modal.rest import straight
from tmm_gen.scene import Scene
from tmm_gen.scene.spatial.arm import SpatialArm

Array = NDArray[np.float64]

_MOST = 1000.0
"""rad; after so many turns nothing is near."""

FROM_START, NEAR = "the start", "--near"
"""Where a search begins: without being told where, and told."""

_SHOWN = 8
"""Names that are listed."""


def joint_name(scene: Scene, number: int) -> str:
    """Return what to call a joint of a planar arm, counted from 1, or the hub, 0."""
    if number == 0:
        return "the base, which floats," if scene.floats else "hub"
    named = (part.name for part in scene.parts if number in (part.joint, part.gear))
    return next(named, f"joint {number}")


def joint_numbers(scene: Scene) -> dict[str, int]:
    """Return the joints that can be set, by name: counted from 1, base to tip; 0 is a hub."""
    if scene.spatial is not None:
        joints = enumerate(scene.spatial.joints, start=1)
        return {joint.name: number for number, joint in joints if not joint.given}
    # of an elastic gear, whose shaft is in between, the outer side is meant
    seen = [number for number, link in enumerate(scene.links, start=1) if not link.massless]
    hub = [0] if scene.hub and not scene.floats else []
    return {joint_name(scene, number): number for number in hub + seen}


def beyond(scene: Scene, joint: int) -> list[int]:
    """Return the numbers of all links of a planar arm that turn with a joint; the hub itself is 0."""
    turning = {joint}
    for number in range(joint + 1, scene.stations + 1):
        if scene.host(number) in turning:
            turning.add(number)
    return sorted(turning)


def start_of(scene: Scene, near: Sequence[str]) -> Array | None:
    """Return the free angles from where an equilibrium is looked for; None where nothing is asked for.

    Raises
    ------
    UserError
        If a word is not ``JOINT=ANGLE``, names no joint, or the scene is a chain.
    """
    if not near:
        return None
    if scene.model.linear:
        raise UserError(
            f"--near {near[0]}: a chain is linear, its motion is the same about any rest. Leave it out."
        )
    angles: dict[str, float] = {}
    for text in near:
        name, _, value = text.partition("=")
        try:
            angles[name.strip()] = float(value)
        except ValueError:
            angles[name.strip()] = math.nan
        if not abs(angles[name.strip()]) <= _MOST:  # no number is not either
            raise UserError(
                f"--near {text}: write JOINT=ANGLE, the angle in rad, at most {_MOST:g}; for example --near elbow=0.5."
            )
    return start_near(scene, angles)


def parts_that_turn(arm: SpatialArm) -> list[tuple[int, str]]:
    """Return the joints that are parts by themselves, not a beam's: number, counted from 1, and name."""
    parts = {frame.name for frame in arm.frames}
    return [(number, joint.name) for number, joint in enumerate(arm.joints, start=1) if joint.name in parts]


def start_near(scene: Scene, angles: Mapping[str, float]) -> Array:
    """Return free angles: those of the scene's start, with some joints set.

    Parameters
    ----------
    scene : Scene
        A planar arm, or one in space.
    angles : mapping from str to float
        Of the outer side of a joint against the inner one by the joint's name, rad; what stands on it turns along.

    Returns
    -------
    array, (d,)
        Of a planar arm as of :func:`~tmm_gen.modal.rest.straight`, in space those of the joints, rad.

    Raises
    ------
    UserError
        If there is no joint of some name.
    """
    numbers = joint_numbers(scene)
    for name in angles:
        if name not in numbers:
            raise UserError(
                f"scene '{scene.name}': has no joint '{name}'; there are {_listed(scene, numbers)}."
            )
    if scene.spatial is not None:
        joints = scene.spatial.joints
        return np.array([angles.get(joint.name, joint.angle) for joint in joints if not joint.given])
    shape = np.concatenate([np.zeros(1 - scene.hub), straight(scene)])  # of hub or base, then of each link
    for name, number in sorted((name, numbers[name]) for name in angles):
        inner = scene.inner(number) if number else 0
        host = scene.host(number) if number else 0
        turn = angles[name] - (shape[number] - shape[inner] if number else shape[0])
        shape[beyond(scene, host if host != inner else number)] += turn
    return shape[1 - scene.hub :]


def _listed(scene: Scene, numbers: Mapping[str, int]) -> str:
    """Return the names of joints, those of parts first, and not more than can be read."""
    parts = {part.name for part in scene.parts}
    if scene.spatial is not None:
        parts = {frame.name for frame in scene.spatial.frames}
    names = sorted(numbers, key=lambda name: (name not in parts and name != "hub", numbers[name]))
    shown = names[:_SHOWN]
    return ", ".join(shown) + (f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else "")
