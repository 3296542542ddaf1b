"""Prices of tunings, found one after the other or side by side in processes: the same numbers either way."""

from __future__ import annotations

import multiprocessing
import os
import threading
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from functools import partial

from tmm_gen.closed_loop.objective import objective
from tmm_gen.control.bench import Bench
from tmm_gen.scene import Scene

Cost = Callable[[Bench, Sequence[str], float], float]
"""From a bench, names of controllers and a price that is bad enough, to a price."""
Pricing = Callable[[Sequence[Scene], Sequence[str], float], Iterable[float]]
"""From scenes of one arm, names of controllers and a price that is bad enough, to the scenes' prices in turn."""

_KEPT = 32
"""Benches kept by a process; each payload that is reckoned with has models of its own."""


class OneByOne:
    """Prices found in this process, each when it is asked for; models are made once for each assumed payload.

    Parameters
    ----------
    bench : Bench, optional
        Of one of the scenes.
    cost : callable
        What each of them costs.
    """

    def __init__(self, bench: Bench | None = None, cost: Cost = objective) -> None:
        self._benches = {} if bench is None else {_payload(bench.scene): bench}
        self._cost = cost

    def __call__(self, scenes: Sequence[Scene], controllers: Sequence[str], enough: float) -> Iterator[float]:
        """Yield the scenes' prices."""
        for scene in scenes:
            yield self._cost(self._bench(scene), controllers, enough)

    def _bench(self, scene: Scene) -> Bench:
        payload = _payload(scene)
        known = self._benches.pop(payload, None)
        found = self._benches[payload] = Bench.of(scene) if known is None else known.retuned(scene)
        if len(self._benches) > _KEPT:
            del self._benches[next(iter(self._benches))]
        return found


def _payload(scene: Scene) -> float:
    return 1.0 if scene.control is None else scene.control.payload


@contextmanager
def side_by_side(workers: int) -> Iterator[Pricing]:
    """Give prices by the objective, found in so many processes, which end with the block.

    Parameters
    ----------
    workers : int
        Processes.
    """
    # not forked: what this process has begun in threads would be half there
    apart = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(workers, apart, initializer=_end_with_parent) as pool:

        def prices(scenes: Sequence[Scene], controllers: Sequence[str], enough: float) -> Iterator[float]:
            return pool.map(partial(_price, controllers=tuple(controllers), enough=enough), scenes)

        yield prices


def _end_with_parent() -> None:
    """Let this worker end when the process that started it is killed, instead of waiting for work for ever."""
    parent = multiprocessing.parent_process()
    assert parent is not None

    def wait() -> None:
        parent.join()
        os._exit(1)

    threading.Thread(target=wait, daemon=True).start()


_here = OneByOne()
"""Of a worker process."""


def _price(scene: Scene, controllers: Sequence[str], enough: float) -> float:
    (found,) = _here([scene], controllers, enough)
    return found
