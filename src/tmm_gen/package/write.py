"""Putting a generated package on disk: whole or not at all, and never over what somebody else wrote."""

from __future__ import annotations

from collections.abc import Container, Mapping
from dataclasses import dataclass
from pathlib import Path

from tmm_gen.emit.seal import WITHOUT_MOTION, is_intact, is_written_by_tmm_gen
from tmm_gen.errors import UserError
from tmm_gen.files import write_tree_whole
from tmm_gen.reading import LARGEST_TEXT, kind_of, read_file

SUFFIXES = frozenset({".py", ".c", ".h", ".txt"})
"""Of the files that tmm-gen writes; only such files are looked at."""


@dataclass(frozen=True)
class Changes:
    """What writing a package would do.

    Parameters
    ----------
    written : dict from Path to str
        Files that are new or differ, with the text they are to have.
    stale : tuple of Path
        Files tmm-gen once wrote and no longer does.
    unchanged : tuple of Path
        Files that are as they are to be.
    """

    written: dict[Path, str]
    stale: tuple[Path, ...]
    unchanged: tuple[Path, ...]


def compare_package(files: Mapping[str, str], folder: Path) -> Changes:
    """Compare generated texts with what lies in a package's folder.

    Parameters
    ----------
    files : mapping from str to str
        Text by path inside the package.
    folder : Path
        Of the package; need not exist.
    """
    wanted = {folder / path: text for path, text in files.items()}
    same = {path for path, text in wanted.items() if path.is_file() and _content(path) == text.encode()}
    return Changes(
        written={path: text for path, text in wanted.items() if path not in same},
        stale=tuple(path for path in written_files(folder) if path not in wanted),
        unchanged=tuple(path for path in wanted if path in same),
    )


def write_package(files: Mapping[str, str], folder: Path, *, force: bool = False) -> Changes:
    """Write a package, remove what tmm-gen once wrote into it and no longer does.

    Parameters
    ----------
    files : mapping from str to str
        Text by path inside the package.
    folder : Path
        Of the package; made if missing.
    force : bool
        Overwrite and remove also what was edited by hand, overwrite what tmm-gen did not write.

    Returns
    -------
    Changes
        What has been done.

    Raises
    ------
    UserError
        If a file in the way was edited by hand or is not tmm-gen's, unless forced; nothing has changed then.
    OSError
        If a file cannot be written; nothing has changed then.
    """
    changes = compare_package(files, folder)
    if not force:
        for path in (*changes.written, *changes.stale):
            _require_ours(path)
    write_tree_whole(changes.written)
    for path in changes.stale:
        path.unlink()
        _remove_empty(path.parent, folder)
    return changes


def written_files(folder: Path, beside: Container[Path] = ()) -> list[Path]:
    """Return the files below a folder that tmm-gen wrote, edited since or not, sorted.

    Parameters
    ----------
    folder : Path
        Where to look; need not exist.
    beside : container of Path
        Files that are known of, and not looked at.
    """
    if not folder.is_dir():
        return []
    below = (path for path in folder.rglob("*") if path.suffix in SUFFIXES and path not in beside)
    found = (path for path in below if path.is_file())
    return sorted(path for path in found if is_written_by_tmm_gen(text_of(path)))


def _require_ours(path: Path) -> None:
    if not path.exists():
        return
    if path.is_dir():
        raise UserError(f"{path}: is a folder where a file is to be written. Move it away.")
    if not path.is_file():
        words = kind_of(path.stat().st_mode)
        raise UserError(f"{path}: is {words} where a file is to be written. Move it away.")
    text = text_of(path)
    if is_intact(text):
        return
    if is_written_by_tmm_gen(text):
        fault, keep = "was edited by hand since tmm-gen wrote it", "Put the change into the scene"
    else:
        fault, keep = "was not written by tmm-gen", "Move it away"
    raise UserError(f"{path}: {fault}. {keep}, or lose it with --force.")


def text_of(path: Path) -> str:
    """Return the text of a file; nothing for one too large to be tmm-gen's."""
    return _content(path).decode("utf-8", errors="replace")


def without_motion(text: str) -> bool:
    """Whether a generated test says that it has no motion to compare with."""
    return WITHOUT_MOTION in text


def _content(path: Path) -> bytes:
    return b"" if path.stat().st_size > LARGEST_TEXT else read_file(path)


def _remove_empty(folder: Path, top: Path) -> None:
    """Remove folders that have become empty, up to the package's."""
    while folder != top and not any(folder.iterdir()):
        folder.rmdir()
        folder = folder.parent
