"""Damage stores of studies in every way at random: what was put in comes back, or an error names the file to delete.

Prints, for each kind of damage, how many stores gave all back or part of it (what is missing is computed again), how
many were refused in words, and how many gave a traceback or something that was never put in: none may. Exits with 1 if
one does.
"""

from __future__ import annotations

import argparse
import os
import shutil
import sqlite3
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from pathlib import Path

import numpy as np

from tmm_gen.cli.console import Column, progress, table
from tmm_gen.study import store as stores
from tmm_gen.study.outcome import Outcome, Result
from tmm_gen.study.store import Store
from tmm_gen.study.store_errors import StoreError

Random = np.random.Generator
Damage = Callable[[Path, Random], None]

KINDS: dict[str, Damage] = {}
"""Ways to damage a store, by name."""

_NOBODY = 65534

MEMORY = "/dev/shm"
"""Where stores are made if it is there: on a disk, waiting for each entry to be on it takes most of the time."""


def kind(name: str) -> Callable[[Damage], Damage]:
    def note(damage: Damage) -> Damage:
        KINDS[name] = damage
        return damage

    return note


def truth(seed: int) -> tuple[dict[str, Result], dict[str, bytes]]:
    """Return what is put into a store."""
    random = np.random.default_rng(seed)
    results = {
        f"{seed:04x}{k:060x}": Result(Outcome.FINISHED, error=float(random.random()), operations=int(k))
        for k in range(60)
    }
    return results, {f"r{seed:03x}{k:060x}": random.bytes(9000) for k in range(3)}


def make(path: Path, seed: int) -> None:
    results, references = truth(seed)
    with Store(path) as store:
        for key, result in results.items():
            store.begin(key)
            store.keep(key, result)
        for key, content in references.items():
            store.keep_reference(key, content)


def judge(path: Path, seed: int) -> str:
    """Return "whole", "partly", "refused", or what is wrong."""
    results, references = truth(seed)
    try:
        with Store(path) as store:
            store.inspect()
            there = [(store.result(key), result) for key, result in results.items()]
            blobs = [(store.reference(key), content) for key, content in references.items()]
            store.keep("new", Result(Outcome.FINISHED, error=0.5))
            if store.result("new") != Result(Outcome.FINISHED, error=0.5):
                return "wrong: forgets"
    except StoreError as error:
        said = str(error)
        remedy = "elete" in said or "Name a" in said or "ame another file" in said
        return "refused" if str(path) in said and remedy and "\n" not in said else f"wrong: says {said}"
    except Exception as error:
        return f"traceback: {type(error).__name__}: {error}"
    pairs = [*there, *blobs]
    if any(found is not None and found != wanted for found, wanted in pairs):
        return "wrong: gives what was never put in"
    return "whole" if all(found is not None for found, _ in pairs) else "partly"


@contextmanager
def as_nobody() -> Iterator[None]:
    """Be a user who may not write everywhere, if this one may."""
    if os.geteuid() != 0:
        yield
        return
    os.seteuid(_NOBODY)
    try:
        yield
    finally:
        os.seteuid(0)


def try_one(name: str, folder: Path, seed: int) -> str:
    """Make a store in an empty folder, damage it, and see what becomes of it."""
    path = folder / "study.sqlite"
    make(path, seed)
    random = np.random.default_rng([seed, sorted(KINDS).index(name)])
    KINDS[name](path, random)
    if name == "read-only":
        folder.chmod(0o555)
        with as_nobody():
            return judge(path, seed)
    if name == "locked by another process":
        with closing(sqlite3.connect(path, isolation_level=None)) as other:
            other.execute("PRAGMA journal_mode = DELETE" if random.random() < 0.5 else "SELECT 1").fetchall()
            other.execute("BEGIN EXCLUSIVE")
            return judge(path, seed)
    return judge(path, seed)


def _edit(path: Path, change: Callable[[bytearray], None]) -> None:
    content = bytearray(path.read_bytes())
    change(content)
    path.write_bytes(content)


def _flip(path: Path, random: Random, most: int, first: int = 0, last: int | None = None) -> None:
    """Change up to so many bytes of a file, between two places."""
    content = bytearray(path.read_bytes())
    for place in random.integers(first, last or len(content), int(random.integers(1, most + 1))):
        content[int(place)] ^= int(random.integers(1, 256))
    path.write_bytes(content)


def _sql(path: Path, *statements: str) -> None:
    with closing(sqlite3.connect(path, isolation_level=None)) as connection:
        for statement in statements:
            connection.execute(statement)


@kind("bytes flipped")
def _(path: Path, random: Random) -> None:
    _flip(path, random, 30)


@kind("bytes of the header flipped")
def _(path: Path, random: Random) -> None:
    _flip(path, random, 5, 0, 100)


@kind("bytes of the schema's page flipped")
def _(path: Path, random: Random) -> None:
    _flip(path, random, 20, 100, 4096)


@kind("truncated")
def _(path: Path, random: Random) -> None:
    os.truncate(path, int(random.integers(1, path.stat().st_size)))


@kind("truncated to whole pages")
def _(path: Path, random: Random) -> None:
    os.truncate(path, 4096 * int(random.integers(1, path.stat().st_size // 4096)))


@kind("empty")
def _(path: Path, random: Random) -> None:
    path.write_bytes(b"")


@kind("a stretch of zeros")
def _(path: Path, random: Random) -> None:
    def change(content: bytearray) -> None:
        begin = int(random.integers(0, len(content)))
        end = min(begin + int(random.integers(1, 20_000)), len(content))
        content[begin:end] = bytes(end - begin)

    _edit(path, change)


@kind("pages swapped")
def _(path: Path, random: Random) -> None:
    def change(content: bytearray) -> None:
        one, two = (4096 * random.choice(len(content) // 4096, 2, replace=False)).tolist()
        content[one : one + 4096], content[two : two + 4096] = (
            content[two : two + 4096],
            content[one : one + 4096],
        )

    _edit(path, change)


@kind("bytes appended")
def _(path: Path, random: Random) -> None:
    path.write_bytes(path.read_bytes() + random.bytes(int(random.integers(1, 10_000))))


@kind("noise instead")
def _(path: Path, random: Random) -> None:
    path.write_bytes(random.bytes(int(random.integers(1, 50_000))))


@kind("a text instead")
def _(path: Path, random: Random) -> None:
    path.write_text("step,error\n0.1,0.2\n" * int(random.integers(1, 1000)))


@kind("another program's database")
def _(path: Path, random: Random) -> None:
    path.unlink()
    _sql(path, "CREATE TABLE mine (x)", "INSERT INTO mine VALUES (1)")


@kind("another study's store")
def _(path: Path, random: Random) -> None:
    path.unlink()
    make(path, int(random.integers(5000, 9000)))


@kind("contents of entries swapped")
def _(path: Path, random: Random) -> None:
    with closing(sqlite3.connect(path, isolation_level=None)) as c:
        which = "result" if random.random() < 0.7 else "reference"
        rows = c.execute(f"SELECT key, content, digest FROM {which}").fetchall()
        one, two = random.choice(len(rows), 2, replace=False).tolist()
        c.execute(f"UPDATE {which} SET content = ?, digest = ? WHERE key = ?", (*rows[one][1:], rows[two][0]))
        c.execute(f"UPDATE {which} SET content = ?, digest = ? WHERE key = ?", (*rows[two][1:], rows[one][0]))


@kind("a content edited")
def _(path: Path, random: Random) -> None:
    with closing(sqlite3.connect(path, isolation_level=None)) as c:
        rows = c.execute("SELECT key, content FROM result").fetchall()
        key, content = rows[int(random.integers(len(rows)))]
        changed = bytearray(content)
        changed[int(random.integers(len(changed)))] ^= 1 << int(random.integers(8))
        c.execute("UPDATE result SET content = ? WHERE key = ?", (bytes(changed), key))


@kind("a checksum edited")
def _(path: Path, random: Random) -> None:
    which = f"key LIKE '%{int(random.integers(60)):02x}'"
    _sql(path, f"UPDATE result SET digest = substr(digest, 2) || 'f' WHERE {which}")


@kind("contents of other types")
def _(path: Path, random: Random) -> None:
    value = ["1", "1.5", "'a text'", "x'00ff'", "zeroblob(10)"][int(random.integers(5))]
    which = ["result", "reference"][int(random.integers(2))]
    _sql(path, f"UPDATE {which} SET content = {value}")


@kind("columns of other names")
def _(path: Path, random: Random) -> None:
    which = ["result", "reference", "computation"][int(random.integers(3))]
    _sql(path, f"ALTER TABLE {which} RENAME COLUMN key TO name")


@kind("a table dropped")
def _(path: Path, random: Random) -> None:
    _sql(path, f"DROP TABLE {['result', 'reference', 'computation'][int(random.integers(3))]}")


@kind("a table more")
def _(path: Path, random: Random) -> None:
    _sql(path, "CREATE TABLE more (x)")


@kind("a table without its checksums")
def _(path: Path, random: Random) -> None:
    _sql(path, "DROP TABLE result", "CREATE TABLE result (key TEXT PRIMARY KEY, content TEXT) WITHOUT ROWID")


@kind("another layout")
def _(path: Path, random: Random) -> None:
    _sql(path, f"PRAGMA user_version = {[0, 1, 3, 99, -1][int(random.integers(5))]}")


@kind("another application's mark")
def _(path: Path, random: Random) -> None:
    _sql(path, f"PRAGMA application_id = {int(random.integers(0, 2**31))}")


@kind("locked by another process")
def _(path: Path, random: Random) -> None:
    pass


@kind("read-only")
def _(path: Path, random: Random) -> None:
    path.chmod(0o444)


@kind("a folder instead")
def _(path: Path, random: Random) -> None:
    path.unlink()
    path.mkdir()


@kind("a pipe instead")
def _(path: Path, random: Random) -> None:
    path.unlink()
    os.mkfifo(path)


@kind("a link to itself")
def _(path: Path, random: Random) -> None:
    path.unlink()
    path.symlink_to(path)


@kind("a link to nothing")
def _(path: Path, random: Random) -> None:
    path.unlink()
    path.symlink_to(path.parent / ["gone", "no/folder"][int(random.integers(2))])


@kind("a log of noise beside")
def _(path: Path, random: Random) -> None:
    Path(f"{path}-wal").write_bytes(random.bytes(int(random.integers(1, 50_000))))


@kind("an index of noise beside")
def _(path: Path, random: Random) -> None:
    Path(f"{path}-shm").write_bytes(random.bytes(int(random.integers(1, 50_000))))


@kind("a journal of noise beside")
def _(path: Path, random: Random) -> None:
    Path(f"{path}-journal").write_bytes(random.bytes(int(random.integers(1, 50_000))))


def _killed(path: Path) -> Path:
    """Leave the files of a process that was killed: its log is not yet in the store."""
    copy = path.with_name("copy")
    with closing(sqlite3.connect(path, isolation_level=None)) as c:
        c.execute("PRAGMA wal_autocheckpoint = 0")
        c.execute("UPDATE computation SET begun = begun + 1")
        c.execute("CREATE TABLE passing (x)")
        c.execute("DROP TABLE passing")
        shutil.copy(path, copy)
        shutil.copy(f"{path}-wal", f"{copy}-wal")
    copy.replace(path)
    return Path(f"{copy}-wal").replace(f"{path}-wal")


@kind("killed while writing")
def _(path: Path, random: Random) -> None:
    _killed(path)


@kind("killed, and bytes of the log flipped")
def _(path: Path, random: Random) -> None:
    _flip(_killed(path), random, 30)


@kind("killed, and the log truncated")
def _(path: Path, random: Random) -> None:
    log = _killed(path)
    os.truncate(log, int(random.integers(0, log.stat().st_size)))


@kind("killed, and the store truncated")
def _(path: Path, random: Random) -> None:
    _killed(path)
    os.truncate(path, int(random.integers(1, path.stat().st_size)))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--each", type=int, default=100, help="stores for each kind of damage")
    parser.add_argument("--seed", type=int, default=0, help="of the first store")
    parser.add_argument("--json", action="store_true", help="one JSON object instead of a table")
    chosen = parser.parse_args()
    stores._PATIENCE = 0.05  # a lock that stays need not be waited for
    rows: list[dict[str, object]] = []
    bad = 0
    with progress("damaging", total=len(KINDS) * chosen.each) as advance:
        for name in KINDS:
            counts: Counter[str] = Counter()
            for seed in range(chosen.seed, chosen.seed + chosen.each):
                folder = Path(tempfile.mkdtemp(dir=MEMORY if Path(MEMORY).is_dir() else None))
                folder.chmod(0o755)
                try:
                    said = try_one(name, folder, seed)
                finally:
                    folder.chmod(0o755)
                    shutil.rmtree(folder)
                counts[said.partition(":")[0]] += 1
                if said.startswith(("wrong", "traceback")):
                    bad += 1
                    print(f"{name}, seed {seed}: {said}", file=sys.stderr)
                advance(1, name)
            rows.append({"damage": name, "stores": chosen.each, **_counted(counts)})
    rows.append({"damage": "all", **{key: sum(int(str(row[key])) for row in rows) for key in _KEYS}})
    columns: list[Column | str] = ["damage", *_KEYS]
    table(rows, columns, chosen.json, title="Damaged stores")
    return 1 if bad else 0


_KEYS = ("stores", "whole", "partly", "refused", "wrong", "traceback")


def _counted(counts: Counter[str]) -> dict[str, object]:
    return {key: counts[key] for key in _KEYS[1:]}


if __name__ == "__main__":
    sys.exit(main())
