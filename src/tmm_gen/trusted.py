"""What a cache holds is used only if this user wrote it, nobody else could since, and it is whole."""

from __future__ import annotations

import hashlib
import os
import shutil
import stat
from contextlib import suppress
from pathlib import Path

__all__ = ["digest_of", "discard", "own_content", "own_folder"]

_OTHERS = stat.S_IWGRP | stat.S_IWOTH


def digest_of(content: bytes) -> str:
    """Return the hash that tells damage."""
    return hashlib.sha256(content).hexdigest()


def own_folder(folder: Path) -> None:
    """Make a folder that only this user writes to.

    Raises
    ------
    OSError
        If it cannot be made, or belongs to somebody else.
    """
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    status = folder.lstat()
    if not stat.S_ISDIR(status.st_mode) or status.st_uid != os.geteuid():
        raise PermissionError(f"{folder} is not this user's folder")
    if status.st_mode & _OTHERS:
        folder.chmod(stat.S_IMODE(status.st_mode) & ~_OTHERS)


def discard(path: Path) -> None:
    """Remove what lies in a cache in the place of a file, whatever it is; what cannot be removed stays."""
    with suppress(OSError):
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path)
        else:
            path.unlink(missing_ok=True)


def own_content(path: Path, largest: int = 2**28) -> bytes | None:
    """Return the content of a file that this user owns and nobody else may write; None for any other."""
    flags = os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
    try:
        descriptor = os.open(path, flags | getattr(os, "O_CLOEXEC", 0))
    except (OSError, ValueError):
        return None
    try:
        status = os.fstat(descriptor)
        trusted = stat.S_ISREG(status.st_mode) and status.st_uid == os.geteuid()
        if not trusted or status.st_mode & _OTHERS or status.st_size > largest:
            return None
        with os.fdopen(descriptor, "rb", closefd=False) as file:
            return file.read(largest)
    except OSError:
        return None
    finally:
        os.close(descriptor)
