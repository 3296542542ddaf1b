"""Results survive; foreign files are left alone."""

from __future__ import annotations

import gc
import sqlite3
import warnings
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest

from tmm_gen.errors import UserError
from tmm_gen.scene import Scene
from tmm_gen.study.configuration import Configuration
from tmm_gen.study.excitation import Excitation, excitation
from tmm_gen.study.grid import Axes, configurations
from tmm_gen.study.outcome import Outcome, Result
from tmm_gen.study.serial import Serial
from tmm_gen.study.store import Store
from tmm_gen.study.study import run_study
from tmm_gen.study.tasks import make_tasks


def test_a_result_comes_back_as_it_went(tmp_path: Path) -> None:
    result = Result(Outcome.FINISHED, error=0.1 + 0.2, rms_error=1e-300, operations=7)
    with Store(tmp_path / "s.sqlite") as store:
        assert store.result("a") is None
        store.keep("a", result)
        store.keep_reference("b", b"\x00\xff")
    with Store(tmp_path / "s.sqlite") as store:
        assert store.result("a") == result
        assert store.reference("b") == b"\x00\xff"
        assert store.reference("a") is None


def test_other_files_are_refused_and_left_as_they_are(tmp_path: Path) -> None:
    text, other = tmp_path / "notes.txt", tmp_path / "other.sqlite"
    text.write_text("no database, but long enough to look like one\n" * 40)
    with closing(sqlite3.connect(other)) as connection, connection:
        connection.execute("CREATE TABLE mine (x)")
    before = text.read_bytes(), other.read_bytes()
    for path in (text, other, tmp_path, tmp_path / "no" / "folder.sqlite"):
        with pytest.raises(UserError, match=r"--store .*cannot be used"):
            Store(path)
    assert (text.read_bytes(), other.read_bytes()) == before


def test_a_refused_file_is_closed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Python 3.13 warns of a connection left open; here whoever opens one is watched, on any Python."""
    opened: list[Watched] = []

    class Watched(sqlite3.Connection):
        closed = False

        def close(self) -> None:
            self.closed = True
            super().close()

    def connect(path: Path, **options: Any) -> Watched:
        opened.append(real(path, factory=Watched, **options))
        return opened[-1]

    real = sqlite3.connect
    text = tmp_path / "notes.txt"
    text.write_text("no database, but long enough to look like one\n" * 40)
    monkeypatch.setattr(sqlite3, "connect", connect)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(UserError, match="cannot be used"):
            Store(text)
        with Store(tmp_path / "good.sqlite"):
            pass
        gc.collect()
    assert [each.closed for each in opened] == [True, True]


class StudyInterruptedError(Exception):
    pass


class Impatient(Serial):
    """Gives up after some tasks."""

    def __init__(self, patience: int) -> None:
        self.patience = patience

    def results(self, *given: object) -> Iterator[tuple[object, Result]]:  # type: ignore[override]
        for count, pair in enumerate(super().results(*given)):  # type: ignore[arg-type]
            if count == self.patience:
                raise StudyInterruptedError
            yield pair


def test_an_interrupted_study_goes_on_where_it_stopped(tmp_path: Path, arm: Scene) -> None:
    path = tmp_path / "study.sqlite"
    went = excitation(arm, until=0.2)
    grid = configurations(arm, Axes(integrators=("newmark",), steps=(0.02, 0.01, 0.004, 0.002)), 0.2)
    with pytest.raises(StudyInterruptedError):
        run_study(arm, went, grid, Impatient(2), store=path, rounds=0)
    with Store(path) as store:
        begun = len(store.computations())
    assert 2 <= begun < len(grid)
    resumed = run_study(arm, went, grid, store=path, rounds=0)
    with Store(path) as store:
        assert sorted(store.computations()) == sorted({task.key for task in make_tasks(arm, went, grid)})
    plain = run_study(arm, went, grid, rounds=0)
    assert 2 <= resumed.stored < len(grid)
    assert plain.stored == 0
    assert [point.result for point in resumed.points] == [point.result for point in plain.points]


def test_keys_tell_apart_all_that_matters(chain: Scene, chain_excitation: Excitation) -> None:
    grid: tuple[Configuration, ...] = configurations(chain, Axes(), 5.0)
    keys = {task.key for task in make_tasks(chain, chain_excitation, grid)}
    assert len(keys) == len(grid)
    other_load = excitation(chain, until=4.0)
    other_scene = chain.replace(**{"joint.1.damping": 0.41})
    for scene, went in ((chain, other_load), (other_scene, chain_excitation)):
        assert not keys & {task.key for task in make_tasks(scene, went, grid)}
