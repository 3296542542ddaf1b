"""Writing files whole: a reader, or a run that is cut short, never sees half of one."""

from __future__ import annotations

import errno
import os
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

__all__ = ["write_tree_whole", "write_whole"]


def write_whole(path: Path, content: str | bytes) -> None:
    """Write one file whole: the old content stays until the new one is complete.

    Parameters
    ----------
    path
        File to write; missing parent folders are made, a symbolic link is followed.
    content
        Text (written as UTF-8, its line ends as they are) or bytes.

    Raises
    ------
    OSError
        If it cannot be written; nothing has changed then.
    """
    write_tree_whole({path: content})


def write_tree_whole(files: Mapping[Path, str | bytes]) -> None:
    """Write several files, all or none.

    Every file is first written beside its target; only when all are complete do they take their
    places. Should one of these renames fail, the files already replaced get their old content back
    and folders that were made are removed.

    Parameters
    ----------
    files
        Content by path; see `write_whole`.

    Raises
    ------
    OSError
        If one cannot be written; the tree is then as it was.
    """
    targets = {path.resolve(): content for path, content in files.items()}
    made: list[Path] = []
    staged: dict[Path, Path] = {}
    before: dict[Path, bytes | None] = {}
    try:
        for target, content in targets.items():
            _make_parents(target, made)
            if target.is_dir():
                raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(target))
            temporary = target.with_name(f".{target.name}.{os.getpid()}.tmp")
            staged[target] = temporary
            temporary.write_bytes(content.encode() if isinstance(content, str) else content)
            if target.exists():
                temporary.chmod(target.stat().st_mode)
        for target, temporary in staged.items():
            before[target] = target.read_bytes() if target.exists() else None
            temporary.replace(target)
    except BaseException:
        _restore(before)
        for temporary in staged.values():
            with suppress(OSError):
                temporary.unlink()
        for folder in reversed(made):
            with suppress(OSError):  # someone else may use it by now
                folder.rmdir()
        raise


def _make_parents(target: Path, made: list[Path]) -> None:
    """Make the folders above a target, noting those that were not there, outermost first."""
    missing = [folder for folder in target.parents if not folder.exists()]
    for folder in reversed(missing):
        with suppress(FileExistsError):  # made by someone else since
            folder.mkdir()
            made.append(folder)


def _restore(before: Mapping[Path, bytes | None]) -> None:
    """Give files their old content back; None stands for a file that was not there."""
    for target, content in before.items():
        if content is None:
            target.unlink(missing_ok=True)
        else:
            target.write_bytes(content)
