"""What a folder has of controllers that were written into it before, and that would be compiled with the new one."""

from __future__ import annotations

import re
from collections.abc import Container, Iterator
from pathlib import Path

from tmm_gen.onboard.loop_text import PLANT

_HEAD = 1024
"""Bytes of a file in which it says who wrote it."""

_WRITTEN = "Do not edit: change the scene and run `tmm-gen "
_CONTROLLER = "mpc --emit`"
_NAME = re.compile(r"^(?:/\*\*\n \*|#) (\w+)(?::| under the scene's short names)")
"""Whose file one is: its first words."""


def former_files(folder: Path, wanted: Container[Path]) -> tuple[Path, ...]:
    """Return the files of controllers that were written into a folder, and are not written anew.

    Those are a controller's own, of its kernel and of the arm that its example moves, by what they say of themselves at
    their beginning; whatever else is there is not looked at.

    Parameters
    ----------
    folder : Path
        Need not exist.
    wanted : container of Path
        The files that are to be there.
    """
    heads = dict(_heads(folder))
    names = {_name(head) for head in heads.values() if _WRITTEN + _CONTROLLER in head} - {""}
    theirs = {f"{name}{end}" for name in names for end in ("", "_kernel", f"_{PLANT}")}
    return tuple(sorted(path for path, head in heads.items() if _name(head) in theirs and path not in wanted))


def _heads(folder: Path) -> Iterator[tuple[Path, str]]:
    """Yield the files that a controller may have, and how they begin."""
    for place in (folder, folder / "example", folder / PLANT):
        for path in place.glob("*") if place.is_dir() else ():
            if (path.suffix in (".c", ".h") or path.name == "CMakeLists.txt") and path.is_file():
                with path.open("rb") as file:
                    yield path, file.read(_HEAD).decode(errors="replace")


def _name(head: str) -> str:
    """Return whose file one is; nothing where it is no controller's."""
    found = _NAME.match(head)
    short = found is not None and not head[found.end(1) :].startswith(":")
    return found[1] if found is not None and (short or _WRITTEN in head) else ""
