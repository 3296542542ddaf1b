"""Reading what a user names: regular files of a sensible size only.

A named pipe would be waited for, a device read without end; both are told instead.
"""

from __future__ import annotations

import errno
import os
import stat
from io import TextIOWrapper
from pathlib import Path
from typing import BinaryIO

from tmm_gen.errors import UserError

__all__ = ["LARGEST_TABLE", "LARGEST_TEXT", "kind_of", "open_table", "read_file"]

LARGEST_TEXT = 16 * 2**20
"""Bytes of a scene; one of 5000 links written out has one megabyte."""
LARGEST_TABLE = 256 * 2**20
"""Bytes of a table of inputs or of a record."""


def read_file(path: Path, largest: int = LARGEST_TEXT) -> bytes:
    """Return the content of a regular file.

    Raises
    ------
    OSError
        If it cannot be read, is no regular file or is too large; with the path and the reason.
    """
    with _opened(path, largest) as file:
        content = file.read(largest + 1)
    if len(content) > largest:
        raise _too_large(path, largest)
    return content


def open_table(path: Path, what: str = "") -> TextIOWrapper:
    """Open a table in UTF-8, with or without byte order mark, for the `csv` module.

    Parameters
    ----------
    path
        Of the file.
    what
        Words before the path in errors.

    Raises
    ------
    UserError
        If it cannot be read; with the reason and what to do.
    """
    try:
        file = _opened(path, LARGEST_TABLE)
    except FileNotFoundError:
        raise UserError(f"{what}{path}: no such file. Check the path.") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise UserError(f"{what}{path}: {reason}. Name a CSV file that can be read.") from None
    return TextIOWrapper(file, encoding="utf-8-sig", newline="")


def kind_of(mode: int) -> str:
    """Return what a file is, in words."""
    tests = {
        "a directory": stat.S_ISDIR,
        "a named pipe": stat.S_ISFIFO,
        "a device": lambda mode: stat.S_ISCHR(mode) or stat.S_ISBLK(mode),
        "a socket": stat.S_ISSOCK,
    }
    return next((words for words, test in tests.items() if test(mode)), "a file")


def _opened(path: Path, largest: int) -> BinaryIO:
    # non-blocking: to open a pipe that nobody writes to would otherwise wait for ever
    descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_CLOEXEC", 0))
    try:
        status = os.fstat(descriptor)
        if stat.S_ISDIR(status.st_mode):
            raise IsADirectoryError(errno.EISDIR, "is a directory", str(path))
        if not stat.S_ISREG(status.st_mode):
            raise OSError(errno.EINVAL, f"is {kind_of(status.st_mode)}, not a regular file", str(path))
        if status.st_size > largest:
            raise _too_large(path, largest)
        return os.fdopen(descriptor, "rb")
    except BaseException:
        os.close(descriptor)
        raise


def _too_large(path: Path, largest: int) -> OSError:
    return OSError(errno.EFBIG, f"is larger than {largest // 2**20} MiB", str(path))
