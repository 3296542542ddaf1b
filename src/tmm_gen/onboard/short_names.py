"""Short names of the kernel inside a controller: those it has when the scene is built."""

from __future__ import annotations

import re
from collections.abc import Mapping

from tmm_gen.emit.templates import render


def short_names(scene: str, kernel: str, files: Mapping[str, str]) -> dict[str, str]:
    """Return a header that gives the kernel inside a controller the names it has when the scene is built.

    Parameters
    ----------
    scene : str
        Prefix of the short names.
    kernel : str
        Prefix of the others.
    files : mapping of str to str
        The kernel's.
    """
    headers = sorted(path for path in files if path.endswith(".h"))
    words = {word for path in headers for word in re.findall(rf"\b{kernel}_\w+", files[path], re.IGNORECASE)}
    names = [
        (_shortened(word, scene, kernel), word) for word in sorted(words) if not word.endswith(("_H", "_h"))
    ]
    text = render("control/short_names.h.jinja", scene=scene, kernel=kernel, headers=headers, names=names)
    return {f"{scene}.h": text} if f"{scene}.h" not in files else {}


def _shortened(word: str, scene: str, kernel: str) -> str:
    prefix = scene if word.startswith(kernel) else scene.upper()
    return prefix + word[len(kernel) :]
