"""Where a scene tells of something: the beginning of an error."""

from __future__ import annotations

import re

from tmm_gen.scene import Scene
from tmm_gen.scene.locate import nearest_line
from tmm_gen.scene.problem import Path

_PART = re.compile(r"([^.\[\]]+)|\[(\d+)\]")


def where(scene: Scene, key: str) -> str:
    """Return file, line and key; of what is no key of the file, such as another file, without a line.

    Parameters
    ----------
    scene : Scene
        Perhaps one that was changed: controllers and plants think of arms with other cells.
    key : str
        As errors show it: ``control.keep[2].normal``, tables counted from 1.
    """
    path: Path = tuple(
        word or int(number) - 1 for word, number in (part.groups() for part in _PART.finditer(key))
    )
    file = scene.source.origin.partition(" (with ")[0]
    if path[0] not in scene.source.data:
        return f"{file}: {key}"
    return f"{file}:{nearest_line(scene.source.lines, path)}: {key}"
