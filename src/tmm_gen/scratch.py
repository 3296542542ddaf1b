"""Scratch files and folders: random names made exclusively, and no trace of runs that were killed.

A name says which process of which machine made it. What a killed process left behind is removed by the next one that
writes in the same folder.
"""

from __future__ import annotations

import errno
import hashlib
import os
import platform
import re
import secrets
import shutil
import stat
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path

from tmm_gen.errors import UserError

__all__ = ["new_file", "scratch_folder", "scratch_name", "sweep"]

_PATTERN = re.compile(r"\.tmm-gen-(?P<host>[0-9a-f]{8})-(?P<process>\d{1,10})-[0-9a-f]{16}\.tmp")
_FULL = (errno.ENOSPC, errno.EFBIG, errno.EDQUOT)
_FOREIGN_AGE = 86400.0
"""s; after this what another machine left in a shared folder is taken for left behind."""


def scratch_name() -> str:
    """Return a name that nobody can foresee, and that tells whose it is."""
    return f".tmm-gen-{_host()}-{os.getpid()}-{secrets.token_hex(8)}.tmp"


def new_file(folder: Path) -> tuple[int, Path]:
    """Make and open a scratch file that is certainly new.

    Returns
    -------
    descriptor : int
        To be closed by the caller.
    path : Path
        Of the file.

    Raises
    ------
    OSError
        If none can be made.
    """
    path = folder / scratch_name()
    flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_CLOEXEC", 0)
    return os.open(path, flags, 0o666), path


@contextmanager
def scratch_folder(parent: Path | None = None) -> Iterator[Path]:
    """Make a folder for this process alone, and remove it in the end; what killed runs left goes first.

    Parameters
    ----------
    parent
        Where; by default the system's folder of temporary files.

    Yields
    ------
    Path
        The folder, empty.

    Raises
    ------
    UserError
        If there is no room for it, or for what is written there.
    """
    place, option = (Path(tempfile.gettempdir()), "TMPDIR") if parent is None else (parent, "XDG_CACHE_HOME")
    folder: Path | None = None
    try:
        folder = new_folder(place)
        yield folder
    except OSError as error:
        # without a name where a file was open already: nothing else is written here
        if error.errno not in _FULL or not str(error.filename or place).startswith(str(place)):
            raise
        raise UserError(
            f"{place}: {error.strerror}, and scratch is written there. Make room, or name another folder by the "
            f"environment variable {option}."
        ) from error
    finally:
        if folder is not None:
            shutil.rmtree(folder, ignore_errors=True)


def new_folder(parent: Path | None = None) -> Path:
    """Make a scratch folder, which the next run removes once this process has ended."""
    place = Path(tempfile.gettempdir()) if parent is None else parent
    sweep(place)
    folder = place / scratch_name()
    folder.mkdir(mode=0o700)
    return folder


def sweep(folder: Path) -> None:
    """Remove scratch of this user whose process has ended; what cannot be removed stays."""
    with suppress(OSError), os.scandir(folder) as entries:
        for entry in entries:
            if found := _PATTERN.fullmatch(entry.name):
                with suppress(OSError):
                    _remove_if_left(entry, found)


def _remove_if_left(entry: os.DirEntry[str], name: re.Match[str]) -> None:
    status = entry.stat(follow_symlinks=False)
    if status.st_uid != os.geteuid():
        return
    if name["host"] == _host():
        if _lives(int(name["process"])):
            return
    elif time.time() - status.st_mtime < _FOREIGN_AGE:
        return
    if stat.S_ISDIR(status.st_mode):
        shutil.rmtree(entry.path, ignore_errors=True)
    else:
        Path(entry.path).unlink()


def _lives(process: int) -> bool:
    if process == os.getpid():
        return True
    try:
        os.kill(process, 0)
    except (ProcessLookupError, OverflowError):
        return False
    except PermissionError:
        return True
    return True


@cache
def _host() -> str:
    """Return what tells machines, and starts of one, apart: process numbers mean nothing elsewhere."""
    boot = ""
    with suppress(OSError):
        boot = Path("/proc/sys/kernel/random/boot_id").read_text(encoding="ascii").strip()
    with suppress(OSError):
        boot += str(Path("/proc/self/ns/pid").readlink())
    return hashlib.sha256(f"{platform.node()} {boot}".encode()).hexdigest()[:8]
