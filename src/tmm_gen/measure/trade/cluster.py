"""Tasks computed by Dask: on a local cluster of processes, or by the workers of a running scheduler.

Kernels are derived, compiled and cached by the workers, under the hash of what is compiled. Workers of a local cluster
write each result to the store before they do anything else; a worker that dies takes with it no more than the task it
was at, which another one computes again. Results from elsewhere are written here, as they arrive.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tmm_gen.errors import UserError
from tmm_gen.measure.trade.outcome import Outcome, Result
from tmm_gen.measure.trade.store import Store
from tmm_gen.measure.trade.tasks import Task, compute
from tmm_gen.measure.trade.truth import Truth

if TYPE_CHECKING:
    from distributed import Client

_CONNECT = 10.0
"""s to wait for a scheduler."""


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
            If Dask is not installed, or there is no such scheduler.
        """
        known, missing = _sorted_out(tasks, store)
        yield from known
        if not missing:
            return
        here = None if self.address else store
        with self._client() as client:
            for count, (task, result) in enumerate(_computed(client, missing, truths, here), start=1):
                if store is not None and here is None and result.outcome is not Outcome.LOST:
                    with Store(store) as kept:
                        kept.begin(task.key)
                        kept.keep(task.key, result)
                if self.watch is not None:
                    self.watch(client, count)
                yield task, result

    @contextmanager
    def _client(self) -> Iterator[Client]:
        try:
            from distributed import Client, LocalCluster
        except ImportError:
            raise UserError(
                "--workers and --scheduler need Dask, which is not installed: pip install 'tmm-gen[study]'."
            ) from None
        if self.address is not None:
            try:
                client = Client(self.address, timeout=_CONNECT, set_as_default=False)
            except (OSError, ValueError) as error:
                raise UserError(
                    f"--scheduler {self.address}: no Dask scheduler answers there ({error}). Start one by "
                    "`dask scheduler`, or use --workers for a cluster on this machine."
                ) from None
            with client:
                yield client
            return
        with (
            LocalCluster(
                n_workers=self.workers,
                threads_per_worker=1,
                processes=True,
                host="127.0.0.1",  # there where no network is
                dashboard_address="127.0.0.1:0",  # any port: another study may have the usual one
                memory_limit=0,
                silence_logs=logging.CRITICAL,
            ) as cluster,
            Client(cluster, set_as_default=False) as client,
        ):
            yield client


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
    from distributed import KilledWorker, as_completed

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
    for future in as_completed(futures, loop=client.loop):
        task = futures.pop(future)
        error = future.exception()
        if isinstance(error, KilledWorker):
            yield task, Result(Outcome.LOST, "every worker that computed it died")
        elif error is not None:
            raise error
        else:
            yield task, future.result()
        future.release()


def _itself(truth: Truth) -> Truth:
    return truth
