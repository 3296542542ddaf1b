"""Changing numbers in the text of a scene file, and nothing else."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

from tmm_gen.scene.load import parse_scene
from tmm_gen.scene.problem import Path, Problem, SceneError, show_path
from tmm_gen.scene.scene import Scene

_NUMBER = r"[+-]?(?:\d[\d_]*\.?[\d_]*(?:[eE][+-]?\d+)?)"
_LIST = r"\[[^\[\]#]*\]"
_TABLE = r"\{[^{}#]*\}"
Value: TypeAlias = float | Sequence[float] | Mapping[str, float | Sequence[float]]
"""A number, a list of them, or either by names."""


def rewritten(text: str, origin: str, scene: Scene, changes: Mapping[Path, Value]) -> str:
    """Return the text of a scene file with some numbers replaced; comments and layout stay.

    Parameters
    ----------
    text : str
        Of the file.
    origin : str
        Name used in errors.
    scene : Scene
        What the new text must say.
    changes : mapping from path to value
        New values: numbers, lists of them, either of these by names, or numbers in lists; each key must stand with its
        value on one line, no other key of its name beside it.

    Raises
    ------
    SceneError
        If a number cannot be found in the text, or the result does not say what it must.
    """
    rows = text.split("\n")
    lines = parse_scene(text, origin).source.lines
    for place, number in changes.items():
        path, value = _whole(place, number, scene)
        line = lines.get(path)
        old = _LIST if isinstance(value, Sequence) else _NUMBER
        if isinstance(value, Mapping):  # what was the same for all may be told by names now
            old = f"(?:{_TABLE}|{_LIST}|{_NUMBER})"
        # at the start of a line, dotted or not, or in a table within it: material = { young = 70e9 }
        key = rf"((?:^\s*(?:[\w-]+\s*\.\s*)*|[{{,]\s*){re.escape(str(path[-1]))}\s*=\s*)"
        matches = list(re.finditer(rf"{key}{old}(?=[\s#,}}]|$)", rows[line - 1])) if line else []
        if line is None or len(matches) != 1:
            remedy = "Write the key and its number on a line of their own."
            raise SceneError(
                [Problem(origin, line or 1, show_path(path), None, "cannot be rewritten", remedy)]
            )
        new = as_written(value)
        (match,) = matches
        start = rows[line - 1][: match.start()] + match[1] + new
        rows[line - 1] = _aligned(start, match.end(), rows[line - 1])
    whole = "\n".join(rows)
    if parse_scene(whole, origin) != scene:
        problem = Problem(origin, 1, "", None, "cannot be rewritten", "Change the numbers by hand.")
        raise SceneError([problem])
    return whole


def as_written(value: Any) -> str:
    """Return a value as TOML has it."""
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{name} = {as_written(each)}" for name, each in value.items()) + " }"
    return repr(list(value)) if isinstance(value, Sequence) else repr(value)


def _whole(place: Path, value: Value, scene: Scene) -> tuple[Path, Value]:
    """Return a change as it is written: one of a number in a list by the whole list, as the scene has it."""
    if not isinstance(place[-1], int):
        return place, value
    found: Any = scene.source.data
    for part in place[:-1]:
        found = found[part]
    return place[:-1], found


def _aligned(start: str, end: int, row: str) -> str:
    """Return a row whose first characters, up to an end, are others; a comment stays in its column if it can."""
    rest = row[end:]
    comment = rest.lstrip()
    if not comment.startswith("#"):
        return start + rest
    return start + " " * max(1, len(row) - len(comment) - len(start)) + comment
