"""Where a study keeps its results: one SQLite file, so that an interrupted study goes on where it stopped.

Several processes write to it at once (write-ahead log). A result is in it completely or not at all. Entries of another
scene, another version or another grid do no harm: they have other keys.
"""

from __future__ import annotations

import json
import os
import sqlite3
import time
from pathlib import Path
from types import TracebackType
from typing import Any

from tmm_gen.errors import UserError
from tmm_gen.measure.trade.outcome import Outcome, Result

_LAYOUT = 1
"""Changes with the tables below; a file of another layout is refused."""

_APPLICATION = 0x746D6D67
"""Marks a SQLite file as ours ("tmmg")."""

_TABLES = """
CREATE TABLE IF NOT EXISTS result (key TEXT PRIMARY KEY, content TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS reference (key TEXT PRIMARY KEY, content BLOB NOT NULL) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS computation (key TEXT NOT NULL, process INTEGER NOT NULL, begun REAL NOT NULL);
"""

_PATIENCE = 60.0
"""s; how long one process waits for another to finish writing."""


class Store:
    """An open store. To be used in a ``with`` block, by one thread.

    Parameters
    ----------
    path : Path
        The file; it is made if it does not exist.

    Raises
    ------
    UserError
        If the file is something else, or cannot be written.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        try:
            self._connection = sqlite3.connect(path, timeout=_PATIENCE, isolation_level=None)
            try:
                self._prepare()
            except BaseException:
                self._connection.close()  # nobody else will: there is no store to leave
                raise
        except sqlite3.Error as error:
            raise UserError(
                f"--store {path}: cannot be used: {error}. Name a new file in a folder that can be written."
            ) from error

    def __enter__(self) -> Store:
        """Return the store."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Close it."""
        self._connection.close()

    def result(self, key: str) -> Result | None:
        """Return a result, if it is there."""
        found = self._one("SELECT content FROM result WHERE key = ?", key)
        if found is None:
            return None
        values: dict[str, Any] = json.loads(found)
        return Result(**{**values, "outcome": Outcome(values["outcome"])})

    def keep(self, key: str, result: Result) -> None:
        """Put a result in."""
        content = json.dumps(result.values(), allow_nan=False)
        self._connection.execute("INSERT OR REPLACE INTO result VALUES (?, ?)", (key, content))

    def reference(self, key: str) -> bytes | None:
        """Return a reference motion, if it is there."""
        found: bytes | None = self._one("SELECT content FROM reference WHERE key = ?", key)
        return found

    def keep_reference(self, key: str, content: bytes) -> None:
        """Put a reference motion in."""
        self._connection.execute("INSERT OR REPLACE INTO reference VALUES (?, ?)", (key, content))

    def begin(self, key: str) -> None:
        """Note that a result is being computed."""
        self._connection.execute("INSERT INTO computation VALUES (?, ?, ?)", (key, os.getpid(), time.time()))

    def computations(self) -> list[str]:
        """Return the keys of all computations ever begun, one entry for each."""
        found = self._connection.execute("SELECT key FROM computation ORDER BY begun").fetchall()
        return [key for (key,) in found]

    def computing(self) -> list[tuple[str, int]]:
        """Return keys whose computation was begun but has left no result, each with the process that began it."""
        query = (
            "SELECT key, process FROM computation WHERE key NOT IN (SELECT key FROM result) ORDER BY begun"
        )
        return self._connection.execute(query).fetchall()

    def _one(self, query: str, key: str) -> Any:
        row = self._connection.execute(query, (key,)).fetchone()
        return None if row is None else row[0]

    def _prepare(self) -> None:
        """Lay the tables out in a new file; look whether an old one is ours."""
        (application,) = self._connection.execute("PRAGMA application_id").fetchone()
        (layout,) = self._connection.execute("PRAGMA user_version").fetchone()
        if (application, layout) == (_APPLICATION, _LAYOUT):
            return
        (tables,) = self._connection.execute("SELECT count(*) FROM sqlite_master").fetchone()
        if tables and (application, layout) != (0, 0):
            raise sqlite3.DatabaseError("it is no store of this version of tmm-gen")
        if tables and application == 0 and not self._ours():
            raise sqlite3.DatabaseError("it holds something else")
        self._connection.execute("PRAGMA journal_mode = WAL")
        self._connection.executescript(f"BEGIN IMMEDIATE; {_TABLES} COMMIT;")
        self._connection.execute(f"PRAGMA application_id = {_APPLICATION}")
        self._connection.execute(f"PRAGMA user_version = {_LAYOUT}")

    def _ours(self) -> bool:
        """Whether the tables are those another process is just laying out."""
        names = self._connection.execute("SELECT name FROM sqlite_master WHERE type = 'table'").fetchall()
        return {name for (name,) in names} <= {"result", "reference", "computation"}
