"""A damaged store gives what was put in, or an error that says which file to delete; never a traceback.

A sample of `benchmarks/damage_stores.py`, which does each kind of damage hundreds of times.
"""

from __future__ import annotations

import gc
import shutil
import sqlite3
import tempfile
import warnings
from collections.abc import Iterator
from importlib import util
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from tmm_gen.cli import main
from tmm_gen.study.store import Store
from tmm_gen.study.store_errors import StoreError

ROOT = Path(__file__).resolve().parents[2]


def _benchmark() -> ModuleType:
    spec = util.spec_from_file_location("damage_stores", ROOT / "benchmarks" / "damage_stores.py")
    assert spec is not None
    assert spec.loader is not None
    module = util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


DAMAGE = _benchmark()


@pytest.fixture
def folder(monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder that others may read, in memory if there is such: syncing a disk takes long."""
    monkeypatch.setattr("tmm_gen.study.store._PATIENCE", 0.05)
    made = Path(tempfile.mkdtemp(dir=DAMAGE.MEMORY if Path(DAMAGE.MEMORY).is_dir() else None))
    made.chmod(0o755)
    yield made
    made.chmod(0o755)
    shutil.rmtree(made)


@pytest.mark.parametrize("name", DAMAGE.KINDS)
def test_damage_is_noticed(name: str, folder: Path) -> None:
    """Another seed each run: what fails says which."""
    seed = int(np.random.SeedSequence().generate_state(1)[0] % 4000)
    assert DAMAGE.try_one(name, folder, seed) in ("whole", "partly", "refused"), f"seed {seed}"


def test_an_error_names_every_file_to_delete(folder: Path) -> None:
    path = folder / "study.sqlite"
    DAMAGE.make(path, 1)
    with Store(path) as open_store:  # its log lies beside
        open_store.begin("a")
        path.write_bytes(path.read_bytes()[:4096] + b"\0" * 4096 * 20)
        with pytest.raises(StoreError) as caught, Store(path) as store:
            store.inspect()
    assert f"Delete {path} and {path}-wal and {path}-shm; what it held is computed again." in str(
        caught.value
    )


def test_a_study_says_it_in_one_line(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = folder / "study.sqlite"
    scene = str(ROOT / "scenes" / "thesis2.toml")
    words = ["trade", scene, "--integrators", "newmark", "--steps", "0.1", "--until", "1", "--rounds", "0"]
    words += ["--store", str(path)]
    assert main(words) == 0
    whole = path.read_bytes()
    capsys.readouterr()
    random = np.random.default_rng()
    for _ in range(5):
        damaged = bytearray(whole)
        begin = int(random.integers(0, len(whole) - 2000))
        damaged[begin : begin + 2000] = random.bytes(2000)
        path.write_bytes(bytes(damaged))
        code = main(words)
        said = capsys.readouterr().err
        assert code in (0, 2)
        if code == 2:
            assert said.startswith(f"error: --store {path}: ")
            assert len(said.splitlines()) == 1
    path.write_bytes(whole)
    assert main(words) == 0


def test_every_connection_is_closed(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Newer Pythons warn of one that is not."""
    opened: list[sqlite3.Connection] = []
    connect = sqlite3.connect

    def noted(*given: object, **named: object) -> sqlite3.Connection:
        opened.append(connect(*given, **named))  # type: ignore[call-overload]
        return opened[-1]

    monkeypatch.setattr("tmm_gen.study.store.sqlite3.connect", noted)
    path = folder / "study.sqlite"
    DAMAGE.make(path, 2)
    path.write_bytes(path.read_bytes()[:5000])
    with pytest.raises(StoreError), Store(path) as store:
        store.inspect()
    path.write_text("a text" * 200)
    with pytest.raises(StoreError):
        Store(path)
    assert len(opened) == 3
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for connection in opened:
            with pytest.raises(sqlite3.ProgrammingError, match="closed"):
                connection.execute("SELECT 1")
        gc.collect()
