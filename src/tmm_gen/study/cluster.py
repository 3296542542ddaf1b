"""Tasks computed by Dask: on a local cluster of processes, or by the workers of a running scheduler.

Kernels are derived, compiled and cached by the workers, under the hash of what is compiled. Workers of a local cluster
write each result to the store before they do anything else; a worker that dies takes with it no more than the task it
was at, which another one computes again. Results from elsewhere are written here, as they arrive.

A cluster is trusted as this machine is: tasks are pickled code that workers run, what they answer is unpickled here.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import CancelledError
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tmm_gen.errors import UserError
from tmm_gen.extras import extra
from tmm_gen.study.outcome import Outcome, Result
from tmm_gen.study.store import Store
from tmm_gen.study.tasks import Task, compute
from tmm_gen.study.truth import Truth

if TYPE_CHECKING:
    from distributed import Client

_CONNECT = 10.0
"""s to wait for a scheduler."""

_STARTS = 3
"""How often a local cluster is started: a worker may be killed before it answers."""

_LOOK = 5.0
"""s without a result after which workers are counted."""

_ALONE = 60.0
"""s a running scheduler may be without workers."""


def require_dask() -> None:
    """Refuse to go on without Dask.

    Raises
    ------
    UserError
        If it is not installed.
    """
    extra("study", "a cluster (--workers, --scheduler)")


class _AloneError(TimeoutError):
    """A cluster has had no workers for too long."""


@dataclass(frozen=True)
class Cluster:
    """Computes tasks by Dask.

    Parameters
    ----------
    workers : int
        Processes of a local cluster, where there is no address.
    address : str, optional
        Of a running scheduler, such as ``tcp://10.0.0.1:8786``.
    watch : callable, optional
        Called with the client and the number of results after each of them, for who wants to look on.
    """

    workers: int = 2
    address: str | None = None
    watch: Callable[[Client, int], None] | None = None

    def results(
        self, tasks: Iterable[Task], truths: Mapping[int | None, Truth], store: Path | None
    ) -> Iterator[tuple[Task, Result]]:
        """Yield each task with its result as it is done; results the store has already come first.

        Raises
        ------
        UserError
            If Dask is not installed, there is no such scheduler, or it or all its workers go away.
        """
        known, missing = _sorted_out(tasks, store)
        yield from known
        if not missing:
            return
        here = None if self.address else store
        require_dask()
        with _quiet(), self._client() as client, self._while_it_lives(store):
            for count, (task, result) in enumerate(_computed(client, missing, truths, here), start=1):
                if store is not None and here is None and result.outcome is not Outcome.LOST:
                    with Store(store) as kept:
                        kept.begin(task.key)
                        kept.keep(task.key, result)
                if self.watch is not None:
                    self.watch(client, count)
                yield task, result

    @contextmanager
    def _while_it_lives(self, store: Path | None) -> Iterator[None]:
        """Say in words that a scheduler went away."""
        try:
            yield
        except (OSError, CancelledError, TimeoutError) as error:
            which = f"--scheduler {self.address}: the scheduler" if self.address else "--workers: the cluster"
            again = (
                "goes on where it stopped" if store is not None else "begins anew (with --store it would not)"
            )
            what = "went away during the study. Start it again"
            if isinstance(error, _AloneError):
                what = (
                    f"{error}. Start some by `dask worker {self.address or 'ADDRESS'}`, and the study again"
                )
            raise UserError(f"{which} {what}; it then {again}.") from error

    @contextmanager
    def _client(self) -> Iterator[Client]:
        from distributed import Client, LocalCluster

        if self.address is not None:
            try:
                client = Client(self.address, timeout=_CONNECT, set_as_default=False)
            except (OSError, ValueError) as error:
                raise UserError(
                    f"--scheduler {self.address}: no Dask scheduler answers there ({error}). Start one by "
                    "`dask scheduler`, or use --workers for a cluster on this machine."
                ) from None
            with _closing(client):
                yield client
            return
        cluster = _started(LocalCluster, self.workers)
        with cluster, Client(cluster, set_as_default=False) as client:
            yield client


def _started(local: Any, workers: int) -> Any:
    """Start a cluster of processes on this machine.

    Raises
    ------
    UserError
        If its workers die whenever they start.
    """
    for left in reversed(range(_STARTS)):
        try:
            return local(
                n_workers=workers,
                threads_per_worker=1,
                processes=True,
                host="127.0.0.1",  # there where no network is
                dashboard_address="127.0.0.1:0",  # any port: another study may have the usual one
                memory_limit=0,
                silence_logs=logging.CRITICAL,
            )
        except (OSError, RuntimeError, TimeoutError) as error:
            if not left:
                raise UserError(
                    f"--workers {workers}: the processes died {_STARTS} times as they started ({error}). Start fewer, "
                    "or leave --workers out."
                ) from error
    raise AssertionError("unreachable")


@contextmanager
def _closing(client: Client) -> Iterator[None]:
    """Close a client in the end, be its scheduler there or not."""
    try:
        yield
    finally:
        with suppress(OSError, CancelledError, TimeoutError):
            client.close(timeout=_CONNECT)


@contextmanager
def _quiet() -> Iterator[None]:
    """Keep Dask's logs of lost connections off the terminal; what matters comes as an error."""
    loggers = [
        logging.getLogger(name) for name in logging.root.manager.loggerDict if name.startswith("distributed")
    ]
    levels = [logger.level for logger in loggers]
    for logger in loggers:
        logger.setLevel(logging.CRITICAL + 1)
    try:
        yield
    finally:
        for logger, level in zip(loggers, levels, strict=True):
            logger.setLevel(level)


def _sorted_out(tasks: Iterable[Task], store: Path | None) -> tuple[list[tuple[Task, Result]], list[Task]]:
    """Return the tasks whose results the store has, and the others."""
    if store is None:
        return [], list(tasks)
    known: list[tuple[Task, Result]] = []
    missing: list[Task] = []
    with Store(store) as kept:
        for task in tasks:
            found = kept.result(task.key)
            if found is None:
                missing.append(task)
            else:
                known.append((task, found))
    return known, missing


def _computed(
    client: Client, tasks: list[Task], truths: Mapping[int | None, Truth], store: Path | None
) -> Iterator[tuple[Task, Result]]:
    from distributed import KilledWorker

    # As results of tasks, not as data: what a worker that dies has held can then be made again.
    wanted = {task.configuration.family.links for task in tasks}
    references = {links: client.submit(_itself, truths[links], pure=False) for links in wanted}
    futures: dict[Any, Task] = {
        client.submit(
            compute,
            task,
            references[task.configuration.family.links],
            None if store is None else store.resolve(),
            key=f"tmm-gen-{task.key}",
            pure=False,
        ): task
        for task in tasks
    }
    while futures:
        for future in _patiently(client, lambda patience: _first_done(client, futures, patience)):
            task = futures.pop(future)
            error = _patiently(client, future.exception)
            if isinstance(error, KilledWorker):
                yield task, Result(Outcome.LOST, "every worker that computed it died")
            elif isinstance(error, UserError | OSError):
                raise UserError(f"a worker failed: {' '.join(str(error).split())}") from error
            elif error is not None:
                raise error
            else:
                yield task, _patiently(client, future.result)
            future.release()


def _first_done(client: Client, futures: Mapping[Any, Task], patience: float) -> list[Any]:
    """Return the futures that are done, one at least."""
    from distributed import wait

    with client.as_current():
        return list(wait(list(futures), timeout=patience, return_when="FIRST_COMPLETED").done)


def _patiently(client: Client, call: Callable[[float], Any]) -> Any:
    """Wait for what a cluster is to answer, as long as it has workers.

    Parameters
    ----------
    client : Client
        Of the cluster.
    call : callable
        Waits some seconds, and raises TimeoutError then.

    Raises
    ------
    TimeoutError
        If there are no workers for a while.
    """
    last = time.monotonic()
    while True:
        try:
            return call(_LOOK)
        except TimeoutError:
            if client.nthreads():
                last = time.monotonic()
            elif time.monotonic() - last > _ALONE:
                raise _AloneError(f"has had no workers for {_ALONE:g} s") from None


def _itself(truth: Truth) -> Truth:
    return truth
