"""Where a scene tells of its sensors."""

from __future__ import annotations

from tmm_gen.scene import Scene
from tmm_gen.scene.locate import nearest_line


def where(scene: Scene, sensor: str) -> str:
    """Return where a scene tells of a kind of sensor: file, line and key."""
    line = nearest_line(scene.source.lines, ("control", "sensors", sensor))
    return f"{scene.source.origin}:{line}: control.sensors.{sensor}"
