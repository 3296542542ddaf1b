"""A study on Dask workers: one dies half way, and nothing but the task it was at is computed twice."""

from __future__ import annotations

import os
import random
import signal
import subprocess
import sys
from collections import Counter
from pathlib import Path

import pytest
from distributed import Client, LocalCluster

from tmm_gen.cli import main
from tmm_gen.errors import UserError
from tmm_gen.scene import Scene
from tmm_gen.study.cluster import Cluster, _started
from tmm_gen.study.excitation import excitation
from tmm_gen.study.grid import Axes, configurations
from tmm_gen.study.outcome import Result
from tmm_gen.study.store import Store
from tmm_gen.study.study import Study, run_study
from tmm_gen.study.tasks import make_tasks

POINTS = 500
UNTIL = 2.0
LOOKS = 200


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
            for _ in range(LOOKS):  # tasks are short: on a busy machine a single look may find none at one
                busy = [process for key, process in store.computing() if process in processes]
                if busy:
                    self.killed = busy[0]
                    os.kill(self.killed, signal.SIGKILL)
                    return


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
    with pytest.raises(UserError, match=r"which is not installed: "):
        run_study(chain, went, grid, Cluster(2), rounds=0)


def test_no_scheduler_answers(chain: Scene, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tmm_gen.study.cluster._CONNECT", 0.5)
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


ELSEWHERE = """
import time
from distributed import LocalCluster
if __name__ == "__main__":
    cluster = LocalCluster(n_workers=1, threads_per_worker=1, processes=False, protocol="tcp", host="127.0.0.1",
                           dashboard_address="127.0.0.1:0", memory_limit=0)
    print(cluster.scheduler_address, flush=True)
    time.sleep(600)
"""


def test_a_scheduler_is_killed(chain: Scene, tmp_path: Path) -> None:
    """Somewhere in the middle, at random; the study says so, and goes on from its store."""
    went = excitation(chain, until=UNTIL)
    steps = tuple(UNTIL / (20 + k) for k in range(40))
    grid = configurations(chain, Axes(integrators=("newmark",), steps=steps), UNTIL)
    store = tmp_path / "study.sqlite"
    doomed = random.randrange(1, 30)
    with subprocess.Popen([sys.executable, "-c", ELSEWHERE], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        address = process.stdout.readline().strip()

        def watch(client: Client, count: int) -> None:
            if count == doomed:
                process.kill()

        with pytest.raises(UserError, match="the scheduler went away") as caught:
            run_study(chain, went, grid, Cluster(0, address, watch=watch), store=store, rounds=0)
        process.kill()
    assert "it then goes on where it stopped" in str(caught.value)
    assert "\n" not in str(caught.value)
    with Store(store) as kept:
        begun = len(kept.computations())
    assert begun >= doomed
    assert results(run_study(chain, went, grid, store=store, rounds=0)) == results(
        run_study(chain, went, grid, rounds=0)
    )


def test_a_cluster_without_workers_is_given_up(
    chain: Scene, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tmm_gen.study.cluster._LOOK", 0.1)
    monkeypatch.setattr("tmm_gen.study.cluster._ALONE", 0.3)
    went = excitation(chain, until=1.0)
    grid = configurations(chain, Axes(integrators=("newmark",), steps=(0.1,)), 1.0)
    with (
        LocalCluster(
            n_workers=0,
            host="127.0.0.1",
            dashboard_address="127.0.0.1:0",
            memory_limit=0,
        ) as cluster,
        pytest.raises(UserError, match=r"has had no workers for 0\.3 s. Start some by `dask worker tcp:"),
    ):
        run_study(chain, went, grid, Cluster(0, cluster.scheduler_address), rounds=0)


@pytest.mark.parametrize("deaths", [1, 2, 3])
def test_workers_die_as_they_start(deaths: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Dask then says that a nanny failed; `benchmarks/kill_studies.py` kills real ones."""
    left = deaths

    def local(**given: object) -> str:
        nonlocal left
        left -= 1
        if left >= 0:
            raise RuntimeError("Nanny failed to start.")
        return "cluster"

    if deaths < 3:
        assert _started(local, 2) == "cluster"
    else:
        with pytest.raises(UserError, match="the processes died 3 times as they started"):
            _started(local, 2)


def test_help_says_that_tasks_are_trusted_code(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["trade", "--help"]) == 0
    assert "trusted code" in " ".join(capsys.readouterr().out.split())
