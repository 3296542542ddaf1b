"""Changing numbers in the text of a scene file, and nothing else."""

from __future__ import annotations

import re
from collections.abc import Mapping

from tmm_gen.scene.load import parse_scene
from tmm_gen.scene.problem import Path, Problem, SceneError, show_path
from tmm_gen.scene.scene import Scene

_NUMBER = r"[+-]?(?:\d[\d_]*\.?[\d_]*(?:[eE][+-]?\d+)?)"


def rewritten(text: str, origin: str, scene: Scene, changes: Mapping[Path, float]) -> str:
    """Return the text of a scene file with some numbers replaced; comments and layout stay.

    Parameters
    ----------
    text : str
        Of the file.
    origin : str
        Name used in errors.
    scene : Scene
        What the new text must say.
    changes : mapping from path to float
        New values; each key must stand on a line of its own in the file.

    Raises
    ------
    SceneError
        If a number cannot be found in the text, or the result does not say what it must.
    """
    rows = text.split("\n")
    lines = parse_scene(text, origin).source.lines
    for path, value in changes.items():
        line = lines.get(path)
        pattern = re.compile(rf"^(\s*{re.escape(str(path[-1]))}\s*=\s*){_NUMBER}(?=\s|$|#)")
        match = pattern.match(rows[line - 1]) if line else None
        if line is None or match is None:
            remedy = "Write the key and its number on a line of their own."
            raise SceneError(
                [Problem(origin, line or 1, show_path(path), None, "cannot be rewritten", remedy)]
            )
        rows[line - 1] = f"{match[1]}{value!r}{rows[line - 1][match.end() :]}"
    new = "\n".join(rows)
    if parse_scene(new, origin) != scene:
        problem = Problem(origin, 1, "", None, "cannot be rewritten", "Change the numbers by hand.")
        raise SceneError([problem])
    return new
