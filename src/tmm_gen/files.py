"""Writing files whole: a reader, or a run that is cut short, never sees half of one.

Only regular files are written, or new ones: a device, a pipe or a folder in the place of a file is told, never
replaced. Symbolic links are followed to their target.
"""

from __future__ import annotations

import errno
import os
import shutil
import stat
import sys
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from tmm_gen.reading import kind_of
from tmm_gen.scratch import new_file, scratch_name, sweep

__all__ = ["require_target", "write_tree_whole", "write_whole"]


def write_whole(path: Path, content: str | bytes) -> list[Path]:
    """Write one file whole: the old content stays until the new one is complete.

    Parameters
    ----------
    path
        File to write; missing parent folders are made, a symbolic link is followed.
    content
        Text (written as UTF-8, its line ends as they are) or bytes.

    Returns
    -------
    list of Path
        Folders that were made, outermost first.

    Raises
    ------
    OSError
        If it cannot be written, naming `path` and the reason; nothing has changed then.
    """
    return write_tree_whole({path: content})


def write_tree_whole(files: Mapping[Path, str | bytes]) -> list[Path]:
    """Write several files, all or none.

    Every file is first written beside its target; only when all are complete do they take their
    places. Should one of these renames fail, the files already replaced get their old content back
    and folders that were made are removed.

    Parameters
    ----------
    files
        Content by path; see `write_whole`.

    Returns
    -------
    list of Path
        Folders that were made, outermost first.

    Raises
    ------
    OSError
        If one cannot be written, naming it and the reason; the tree is then as it was.
    """
    made: list[Path] = []
    staged: list[_Staged] = []
    try:
        for path, content in files.items():
            try:
                _stage(path, content, made, staged)
            except OSError as error:
                raise _about(path, error) from None
        for item in staged:
            try:
                item.keep_old()
                item.temporary.replace(item.target)
                item.done = True
            except OSError as error:
                raise _about(item.path, error) from None
    except BaseException:
        for item in reversed(staged):
            item.undo()
        for folder in reversed(made):
            with suppress(OSError):  # someone else may use it by now
                folder.rmdir()
        raise
    for item in staged:
        item.forget_old()
    return made


def require_target(path: Path) -> Path:
    """Return the file that writing to a path would make or replace.

    Raises
    ------
    OSError
        If the path is there and is no regular file, or its links lead in a circle.
    """
    try:
        status = path.stat()
    except (FileNotFoundError, NotADirectoryError):
        pass  # new, or behind a link that leads nowhere yet; a file among its parents is met when they are made
    else:
        if stat.S_ISDIR(status.st_mode):
            raise IsADirectoryError(errno.EISDIR, "is a directory; name a file in it", str(path))
        if not stat.S_ISREG(status.st_mode):
            words = f"is {kind_of(status.st_mode)}, not a regular file; name another"
            raise OSError(errno.EINVAL, words, str(path))
        if _is_printed_to(status):
            raise OSError(errno.EINVAL, "is where the output is printed; name another", str(path))
    try:
        return path.resolve()
    except RuntimeError:  # Python up to 3.12 tells circles of links like this
        raise OSError(errno.ELOOP, os.strerror(errno.ELOOP), str(path)) from None


@dataclass
class _Staged:
    """A file on its way.

    Parameters
    ----------
    path : Path
        As the caller names it.
    target : Path
        What is replaced.
    temporary : Path
        The complete new file.
    old : Path, optional
        What was there before, under another name.
    done : bool
        Whether the new file has taken its place.
    """

    path: Path
    target: Path
    temporary: Path
    old: Path | None = None
    done: bool = False

    def keep_old(self) -> None:
        """Give what is there a second name, by which it can come back."""
        if not self.target.exists():
            return
        old = self.target.with_name(scratch_name())
        try:
            os.link(self.target, old)
        except OSError:  # not every file system knows hard links
            shutil.copy2(self.target, old)
        self.old = old

    def undo(self) -> None:
        """Put things back as they were."""
        with suppress(OSError):
            if not self.done:
                self.temporary.unlink()
            elif self.old is not None:
                self.old.replace(self.target)
                self.old = None
            else:
                self.target.unlink()
        self.forget_old()

    def forget_old(self) -> None:
        """Drop the second name."""
        if self.old is not None:
            with suppress(OSError):
                self.old.unlink()


def _stage(path: Path, content: str | bytes, made: list[Path], staged: list[_Staged]) -> None:
    """Write the new content beside its target."""
    target = require_target(path)
    _make_parents(target, made)
    sweep(target.parent)
    descriptor, temporary = new_file(target.parent)
    staged.append(_Staged(path, target, temporary))
    with os.fdopen(descriptor, "wb") as file:
        file.write(content.encode() if isinstance(content, str) else content)
    with suppress(FileNotFoundError):
        temporary.chmod(stat.S_IMODE(target.stat().st_mode))


def _about(path: Path, error: OSError) -> OSError:
    """Return an error that names the file it is about: not the scratch beside it, nor none at all."""
    reason = error.strerror or str(error)
    if (
        isinstance(error, FileNotFoundError | PermissionError)
        and error.filename
        and Path(error.filename) != path
    ):
        reason = f"cannot be made in {Path(error.filename).parent}: {reason}"
    return type(error)(error.errno or errno.EIO, reason, str(path))


def _is_printed_to(status: os.stat_result) -> bool:
    """Whether a file is what standard output or standard error goes to."""
    for stream in (sys.__stdout__, sys.__stderr__):
        with suppress(OSError, ValueError):  # it may be closed, or no file
            if stream is not None and os.path.samestat(os.fstat(stream.fileno()), status):
                return True
    return False


def _make_parents(target: Path, made: list[Path]) -> None:
    """Make the folders above a target, noting those that were not there, outermost first."""
    missing = [folder for folder in target.parents if not folder.exists()]
    for folder in reversed(missing):
        with suppress(FileExistsError):  # made by someone else since
            folder.mkdir()
            made.append(folder)
    if not target.parent.is_dir():
        raise NotADirectoryError(errno.ENOTDIR, f"{target.parent} is a file, not a folder", str(target))
