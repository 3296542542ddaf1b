"""The outer ends of an arm's parts, in a plane or in space, by name."""

from __future__ import annotations

from tmm_gen.control.arm.plane_frame import PlaneFrame
from tmm_gen.control.arm.space_frame import SpaceFrame
from tmm_gen.scene import Scene
from tmm_gen.scene.spatial.reach import outermost

Frame = PlaneFrame | SpaceFrame


def part_frame(scene: Scene, name: str) -> Frame:
    """Return the outer end of a part of an arm whose motors are parts by name."""
    return PlaneFrame.of(scene, name) if scene.spatial is None else SpaceFrame.of(scene.spatial, name)


def end_of(scene: Scene) -> str:
    """Return the name of the part whose outer end is the arm's: the last one's, in space the farthest along it."""
    return scene.parts[-1].name if scene.spatial is None else outermost(scene.spatial).name
