"""Building a scene's package, or comparing it with what is there: what was done, file by file."""

from __future__ import annotations

from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING

from tmm_gen.package.known import is_rememberable, known_files, known_scene, remember
from tmm_gen.package.write import (
    Changes,
    compare_package,
    text_of,
    without_motion,
    write_package,
)

if TYPE_CHECKING:
    from tmm_gen.scene import Scene

BUILT, UP_TO_DATE, DRIFT = "built", "up to date", "drift"


@dataclass(frozen=True, repr=False)
class Built:
    """What became of one package.

    Parameters
    ----------
    scene : str
        Name of the scene, and of the package.
    folder : Path
        Of the package.
    state : str
        `BUILT`, `UP_TO_DATE`, or `DRIFT` where a comparison found differences.
    written, removed, unchanged : tuple of str
        Files by path inside of it.
    without_motion : bool
        Whether the test of its C holds no motion, as no start leads to steps within range.
    """

    scene: str
    folder: Path
    state: str
    written: tuple[str, ...]
    removed: tuple[str, ...]
    unchanged: tuple[str, ...]
    without_motion: bool

    def __repr__(self) -> str:
        """Say what became of it, and where it is."""
        return f"<{self.folder}: {self.state}, {len(self.written)} files written>"

    def as_dict(self) -> dict[str, object]:
        """Return the row for a table."""
        return {item.name: getattr(self, item.name) for item in fields(self)}


def up_to_date(path: Path, out: Path) -> Built | None:
    """Return what is known of the package of a scene's file without reading the scene: that it is there; else None.

    Parameters
    ----------
    path : Path
        Of the scene.
    out : Path
        Folder of the packages.
    """
    if (scene := known_scene(path)) is None:
        return None
    name, digest = scene
    files = known_files(digest, out / name)
    return None if files is None else _row(name, out / name, UP_TO_DATE, Changes({}, (), files))


def built(scene: Scene, out: Path, force: bool = False) -> Built:
    """Write a scene's package, unless it is known to be there already.

    Parameters
    ----------
    scene : Scene
        What to generate.
    out : Path
        Folder of the packages; made if missing.
    force : bool
        Overwrite also what was edited by hand or is not tmm-gen's.

    Raises
    ------
    UserError
        If a file in the way was edited by hand or is not tmm-gen's, unless forced; nothing has changed then.
    OSError
        If a file cannot be written; nothing has changed then.
    """
    folder, rememberable = out / scene.name, is_rememberable(scene)
    if rememberable and (known := known_files(scene.digest, folder)) is not None:
        remember(scene)
        return _row(scene.name, folder, UP_TO_DATE, Changes({}, (), known))
    from tmm_gen.package.texts import emit_package  # SymPy: a build with nothing to do needs none

    files = emit_package(scene)
    changes = write_package(files, folder, force=force)
    if rememberable:
        remember(scene, files)
    return _row(scene.name, folder, BUILT if changes.written or changes.stale else UP_TO_DATE, changes)


def compared(scene: Scene, out: Path) -> tuple[Built, list[str]]:
    """Generate a scene's package anew, whatever is remembered; return how what is there differs, with the lines."""
    from tmm_gen.package.texts import emit_package

    folder = out / scene.name
    changes = compare_package(emit_package(scene), folder)
    drift = bool(changes.written or changes.stale)
    wanted = {**changes.written, **dict.fromkeys(changes.stale, "")}
    lines = [line for path in sorted(wanted) for line in _difference(path, wanted[path])]
    return _row(scene.name, folder, DRIFT if drift else UP_TO_DATE, changes), lines


def _difference(path: Path, wanted: str) -> list[str]:
    """Return what a build would change in a file."""
    from difflib import unified_diff

    held = text_of(path) if path.is_file() else ""
    name = path.as_posix()
    before, after = (name if held else "/dev/null"), (name if wanted else "/dev/null")
    return list(unified_diff(held.splitlines(), wanted.splitlines(), before, after, lineterm=""))


def _row(name: str, folder: Path, state: str, changes: Changes) -> Built:
    written, removed, unchanged = (
        tuple(path.relative_to(folder).as_posix() for path in paths)
        for paths in (changes.written, changes.stale, changes.unchanged)
    )
    return Built(name, folder, state, written, removed, unchanged, _without_motion(name, folder))


def _without_motion(name: str, folder: Path) -> bool:
    """Whether the C's test has nothing to compare a motion with."""
    test = folder / "c" / f"test_{name}.c"
    return test.is_file() and without_motion(text_of(test))
