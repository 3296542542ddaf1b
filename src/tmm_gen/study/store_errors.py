"""What goes wrong with a store, in words: which file, and what to do with it."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from tmm_gen.errors import UserError

_BUSY = (sqlite3.SQLITE_BUSY, sqlite3.SQLITE_LOCKED)
_DAMAGED = (sqlite3.SQLITE_CORRUPT, sqlite3.SQLITE_ERROR, sqlite3.SQLITE_SCHEMA, sqlite3.SQLITE_FORMAT)
_SHORT_READ = 522
"""SQLITE_IOERR_SHORT_READ: the file ends before its pages do."""


class StoreError(UserError):
    """A store that cannot be used."""


class ForeignStoreError(Exception):
    """A file that is no store of this version of tmm-gen."""


def damaged(path: Path, what: str) -> StoreError:
    """Return what to say of a store that does not hold what was put in."""
    return StoreError(f"--store {path}: is damaged: {what}. {_delete(path)}")


def _delete(path: Path) -> str:
    beside = [f"{path}{end}" for end in ("-wal", "-shm") if Path(f"{path}{end}").exists()]
    also = f" and {' and '.join(beside)}" if beside else ""
    return f"Delete {path}{also}; what it held is computed again."


@contextmanager
def told(path: Path) -> Iterator[None]:
    """Turn what SQLite raises into errors that name the file and the remedy.

    Raises
    ------
    StoreError
        Instead of it.
    """
    try:
        yield
    except ForeignStoreError as error:
        raise StoreError(
            f"--store {path}: cannot be used: {error}. Name another file; if it was a store once, delete it."
        ) from error
    except UnicodeDecodeError as error:  # in the message that SQLite made of what it read
        raise damaged(path, "it holds texts that are none") from error
    except (sqlite3.Error, OSError) as error:
        raise _said(path, error) from error


def _said(path: Path, error: Exception) -> StoreError:
    extended = getattr(error, "sqlite_errorcode", None)
    code = None if extended is None else extended & 0xFF
    if code in _BUSY:
        return StoreError(
            f"--store {path}: cannot be used: another process is writing to it ({error}). Wait until it is done, or "
            "name another file."
        )
    if code == sqlite3.SQLITE_NOTADB:
        return StoreError(
            f"--store {path}: cannot be used: it is no SQLite file. Name another file; if it was a store once, it is "
            "damaged: delete it."
        )
    # without a code: a column that is none, a text that is not UTF-8
    if code in _DAMAGED or extended == _SHORT_READ or (code is None and isinstance(error, sqlite3.Error)):
        return damaged(path, str(error))
    if code == sqlite3.SQLITE_FULL:
        return StoreError(
            f"--store {path}: cannot be used: {error}. Make room, or name a file on another disk."
        )
    return StoreError(
        f"--store {path}: cannot be used: {error}. Name a new file in a folder that can be written."
    )
