"""The arm of a scene as controllers see it, in a plane or in space."""

from __future__ import annotations

from tmm_gen.control.arm.arm import ControlledArm
from tmm_gen.control.arm.planar_arm import PlanarArm
from tmm_gen.control.arm.space_arm import SpaceArm
from tmm_gen.scene import Scene


def arm_of(scene: Scene) -> ControlledArm:
    """Return the arm of a scene as controllers see it."""
    return PlanarArm(scene) if scene.spatial is None else SpaceArm(scene)
