"""A study on Dask workers: one dies half way, and nothing but the task it was at is computed twice."""

from __future__ import annotations

import os
import signal
import sys
from collections import Counter
from pathlib import Path

import pytest
from distributed import Client, LocalCluster

from tmm_gen.errors import UserError
from tmm_gen.measure.trade.cluster import Cluster
from tmm_gen.measure.trade.excitation import excitation
from tmm_gen.measure.trade.grid import Axes, configurations
from tmm_gen.measure.trade.outcome import Result
from tmm_gen.measure.trade.store import Store
from tmm_gen.measure.trade.study import Study, run_study
from tmm_gen.measure.trade.tasks import make_tasks
from tmm_gen.scene import Scene

POINTS = 500
UNTIL = 2.0


class Murder:
    """Kills one of the workers while it is at a task, once half of the study is done."""

    def __init__(self, store: Path) -> None:
        self.store = store
        self.killed: int | None = None

    def __call__(self, client: Client, count: int) -> None:
        if self.killed is not None or count < POINTS // 2:
            return
        processes = set(client.run(os.getpid).values())
        assert len(processes) == 2
        with Store(self.store) as store:
            busy = [process for key, process in store.computing() if process in processes]
        if busy:
            self.killed = busy[0]
            os.kill(self.killed, signal.SIGKILL)


def results(study: Study) -> list[Result]:
    return [point.result for point in study.points]


def test_a_worker_is_killed_half_way(chain: Scene, tmp_path: Path) -> None:
    went = excitation(chain, until=UNTIL)
    steps = tuple(UNTIL / (20 + k) for k in range(POINTS // 2))
    grid = configurations(chain, Axes(integrators=("newmark", "wilson"), steps=steps), UNTIL)[:POINTS]
    assert len(grid) == POINTS
    serial = run_study(chain, went, grid, rounds=0)

    store = tmp_path / "study.sqlite"
    murder = Murder(store)
    study = run_study(chain, went, grid, Cluster(2, watch=murder), store=store, rounds=0)

    assert murder.killed is not None
    assert results(study) == results(serial)
    with Store(store) as kept:
        times = Counter(kept.computations())
    assert set(times) == {task.key for task in make_tasks(chain, went, grid)}
    # what it was at; the kill may just have missed it, but hits no other
    assert sum(times.values()) - POINTS <= 1
    assert max(times.values()) <= 2

    again = run_study(chain, went, grid, Cluster(2), store=store, rounds=0)
    assert results(again) == results(serial)
    with Store(store) as kept:
        assert Counter(kept.computations()) == times


def test_dask_is_not_installed(chain: Scene, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    went = excitation(chain, until=1.0)
    grid = configurations(chain, Axes(integrators=("newmark",), steps=(0.1,)), 1.0)
    with pytest.raises(UserError, match=r"pip install 'tmm-gen\[study\]'"):
        run_study(chain, went, grid, Cluster(2), rounds=0)


def test_no_scheduler_answers(chain: Scene, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tmm_gen.measure.trade.cluster._CONNECT", 0.5)
    went = excitation(chain, until=1.0)
    grid = configurations(chain, Axes(integrators=("newmark",), steps=(0.1,)), 1.0)
    with pytest.raises(UserError, match="no Dask scheduler answers there"):
        run_study(chain, went, grid, Cluster(0, "tcp://127.0.0.1:9"), rounds=0)


def test_a_running_scheduler_is_used(chain: Scene, tmp_path: Path) -> None:
    """Its workers may have other disks: results are written where the study runs."""
    went = excitation(chain, until=1.0)
    grid = configurations(chain, Axes(integrators=("newmark",), steps=(0.1, 0.05)), 1.0)
    store = tmp_path / "here.sqlite"
    # by loopback, which is there where no network is
    with LocalCluster(
        n_workers=1,
        threads_per_worker=1,
        host="127.0.0.1",
        dashboard_address="127.0.0.1:0",  # any port: another cluster may have the usual one
        memory_limit=0,
    ) as cluster:
        study = run_study(chain, went, grid, Cluster(0, cluster.scheduler_address), store=store, rounds=0)
    assert results(study) == results(run_study(chain, went, grid, rounds=0))
    with Store(store) as kept:
        assert all(kept.result(task.key) is not None for task in make_tasks(chain, went, grid))
