"""Where a study keeps its results: one SQLite file, so that an interrupted study goes on where it stopped.

Several processes write to it at once (write-ahead log). A result is in it completely or not at all. Entries of another
scene, another version or another grid do no harm: they have other keys. Each entry has a checksum over key and content,
as SQLite has none: what a disk or another program has changed is noticed, and never taken for a result.
"""

from __future__ import annotations

import hashlib
import json
import os
import sqlite3
import stat
import time
from pathlib import Path
from types import TracebackType
from typing import Any

from tmm_gen.study.outcome import Outcome, Result
from tmm_gen.study.store_errors import ForeignStoreError, StoreError, damaged, told

_LAYOUT = 2
"""Changes with the tables below; a file of another layout is refused."""

_APPLICATION = 0x746D6D67
"""Marks a SQLite file as ours ("tmmg")."""

_ENTRY = "(key TEXT PRIMARY KEY, content BLOB NOT NULL, digest TEXT NOT NULL) WITHOUT ROWID"
_TABLES = {
    "result": f"CREATE TABLE result {_ENTRY}",
    "reference": f"CREATE TABLE reference {_ENTRY}",
    "computation": "CREATE TABLE computation (key TEXT NOT NULL, process INTEGER NOT NULL, begun REAL NOT NULL)",
}

_PATIENCE = 60.0
"""s; how long one process waits for another to finish writing."""


class Store:
    """An open store. To be used in a ``with`` block, by one thread.

    Every method raises :class:`StoreError`, a `UserError`, if the file is damaged, or cannot be read or written.

    Parameters
    ----------
    path : Path
        The file; it is made if it does not exist.

    Raises
    ------
    StoreError
        If the file is something else, or cannot be written.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        with told(path):
            if path.exists() and not stat.S_ISREG(path.stat().st_mode):
                raise ForeignStoreError("it is no regular file")
            self._connection = sqlite3.connect(path, timeout=_PATIENCE, isolation_level=None)
            try:
                self._prepare()
            except BaseException:
                self._connection.close()
                raise

    def __enter__(self) -> Store:
        """Return the store."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Close it."""
        self._connection.close()

    def inspect(self) -> None:
        """Look through the whole file, and compare every entry with its checksum."""
        with told(self.path):
            (found,) = self._connection.execute("PRAGMA quick_check(1)").fetchone()
            if found != "ok":
                raise damaged(self.path, " ".join(found.split()))
            for table in ("result", "reference"):
                for row in self._connection.execute(f"SELECT key, content, digest FROM {table}"):
                    self._content(table, row[0], *row)

    def result(self, key: str) -> Result | None:
        """Return a result, if it is there."""
        found = self._entry("result", key)
        if found is None:
            return None
        try:
            values: dict[str, Any] = json.loads(found)
            return Result(**{**values, "outcome": Outcome(values["outcome"])})
        except (ValueError, TypeError, KeyError) as error:
            raise damaged(self.path, f"a result cannot be read ({error})") from error

    def keep(self, key: str, result: Result) -> None:
        """Put a result in."""
        self._keep("result", key, json.dumps(result.values(), allow_nan=False).encode())

    def reference(self, key: str) -> bytes | None:
        """Return a reference motion, if it is there."""
        return self._entry("reference", key)

    def keep_reference(self, key: str, content: bytes) -> None:
        """Put a reference motion in."""
        self._keep("reference", key, content)

    def counts(self) -> tuple[int, int]:
        """Return how many results and how many reference motions there are, of all studies that used the file."""
        (found,) = self._run("SELECT (SELECT COUNT(*) FROM result), (SELECT COUNT(*) FROM reference)")
        return int(found[0]), int(found[1])

    def begin(self, key: str) -> None:
        """Note that a result is being computed."""
        self._run("INSERT INTO computation VALUES (?, ?, ?)", key, os.getpid(), time.time())

    def computations(self) -> list[str]:
        """Return the keys of all computations ever begun, one entry for each."""
        return [key for (key,) in self._run("SELECT key FROM computation ORDER BY begun")]

    def computing(self) -> list[tuple[str, int]]:
        """Return keys whose computation was begun but has left no result, each with the process that began it."""
        query = (
            "SELECT key, process FROM computation WHERE key NOT IN (SELECT key FROM result) ORDER BY begun"
        )
        return self._run(query)

    def _entry(self, table: str, key: str) -> bytes | None:
        for row in self._run(f"SELECT key, content, digest FROM {table} WHERE key = ?", key):
            return self._content(table, key, *row)
        return None

    def _content(self, table: str, asked: object, key: object, content: object, digest: object) -> bytes:
        """Return the content of an entry, if it is what was put in."""
        if not isinstance(key, str) or not isinstance(content, bytes) or key != asked:
            raise damaged(self.path, "an entry is none")
        if digest != _digest(table, key, content):
            raise damaged(self.path, "an entry does not match its checksum")
        return content

    def _keep(self, table: str, key: str, content: bytes) -> None:
        self._run(
            f"INSERT OR REPLACE INTO {table} VALUES (?, ?, ?)", key, content, _digest(table, key, content)
        )

    def _run(self, query: str, *values: object) -> list[Any]:
        with told(self.path):
            return self._connection.execute(query, values).fetchall()

    def _prepare(self) -> None:
        """Lay the tables out in a new file, all or none; look whether an old one is ours."""
        if self._marks() != (_APPLICATION, _LAYOUT):
            if self._tables() or self._marks() != (0, 0):
                # another process may just have laid them out
                if self._marks() != (_APPLICATION, _LAYOUT):
                    raise ForeignStoreError(
                        "it holds something else, or results of another version of tmm-gen"
                    )
            else:
                self._lay_out()
        if self._tables() != _TABLES:
            raise damaged(self.path, "its tables are not those of a store")

    def _lay_out(self) -> None:
        self._connection.execute("PRAGMA journal_mode = WAL")
        self._connection.execute("BEGIN IMMEDIATE")
        try:
            if not self._tables():  # nobody was faster
                for create in _TABLES.values():
                    self._connection.execute(create)
                self._connection.execute(f"PRAGMA application_id = {_APPLICATION}")
                self._connection.execute(f"PRAGMA user_version = {_LAYOUT}")
            self._connection.execute("COMMIT")
        except BaseException:
            self._connection.execute("ROLLBACK")
            raise

    def _marks(self) -> tuple[int, int]:
        (application,) = self._connection.execute("PRAGMA application_id").fetchone()
        (layout,) = self._connection.execute("PRAGMA user_version").fetchone()
        return application, layout

    def _tables(self) -> dict[str, str]:
        """Return how the tables were made, by name."""
        found = self._connection.execute(
            "SELECT name, sql FROM sqlite_master WHERE type = 'table'"
        ).fetchall()
        return dict(found)


def kept_in(path: Path) -> str:
    """Return what a store has for who goes on with an interrupted study, in words that follow its name."""
    if not path.exists():
        return "was not begun: nothing is kept."
    try:
        with Store(path) as store:
            results, references = store.counts()
    except StoreError:
        return "cannot be read: what it keeps is not known."
    if results:
        return f"keeps {results} result{'s' * (results > 1)}: the same command goes on from there."
    if references:
        return "keeps the reference motion, but no result yet: the same command goes on from there."
    return "keeps nothing yet."


def _digest(table: str, key: str, content: bytes) -> str:
    return hashlib.sha256(f"{table} {key}\0".encode() + content).hexdigest()
