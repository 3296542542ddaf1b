"""Where a scene came from, with the means to read it again."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from tmm_gen.scene.problem import Path

if TYPE_CHECKING:
    from tmm_gen.scene.scene import Scene


@dataclass(frozen=True, eq=False)
class Source:
    """Where a scene came from, so that later complaints can be located and changed scenes checked.

    Parameters
    ----------
    origin : str
        File as the user named it.
    data : dict
        The TOML document as Python values; never changed in place.
    lines : dict from path to int
        Lines of its keys.
    check : callable
        Makes a scene of a source, or raises SceneError; carried along so that a scene needs not know its reader.
    written : str
        SHA-256 digest of the file's bytes; empty for what is not the content of a file, or no longer.
    """

    origin: str
    data: Mapping[str, object]
    lines: dict[Path, int]
    check: Callable[[Source], Scene]
    written: str = ""
