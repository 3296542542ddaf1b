"""Where motors have their encoders."""

from __future__ import annotations

from typing import Any

from tmm_gen.scene import Scene


def behind_gears(scene: Scene) -> frozenset[str]:
    """Return the names of the motors whose encoders are behind a gear that gives way."""
    entries: Any = scene.source.data.get("motor", [])
    return frozenset(
        str(entry["name"]) for entry in entries if entry.get("encoder") == "output" and "stiffness" in entry
    )
