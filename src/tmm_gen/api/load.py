"""Arms of scene files."""

from __future__ import annotations

from os import PathLike

from tmm_gen.api.arm import Arm
from tmm_gen.api.guard import guarded
from tmm_gen.api.words import path_of, text_of
from tmm_gen.scene import load_scene, parse_scene

__all__ = ["load", "parse"]


@guarded
def load(file: str | PathLike[str]) -> Arm:
    """Return the arm of a scene file.

    Raises
    ------
    SceneError
        If the file cannot be read or makes no arm: it names file, line, key and value, and what to do. It is a
        UserError.
    """
    return Arm.of(load_scene(path_of("load", file)))


@guarded
def parse(text: str) -> Arm:
    """Return the arm of a scene file's text.

    Raises
    ------
    SceneError
        As of :func:`load`.
    """
    return Arm.of(parse_scene(text_of("parse", text)))
