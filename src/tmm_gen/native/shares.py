"""How threads share arms: each takes the next ones when it is done with its last."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor

GRAIN = 64
"""Of which all shares but the last are multiples: of any number of arms side by side, and of lines of the cache."""


def shares(arms: int, workers: int) -> Iterator[tuple[int, int]]:
    """Yield ranges of arms: long ones first, short ones at the end, so that no worker waits long for another."""
    first, least = 0, max(1, -(-arms // GRAIN) // (8 * workers))  # each share costs some time of Python's
    while first < arms:
        left = -(-(arms - first) // GRAIN)
        each = left if workers == 1 else max(least, 3 * left // (4 * workers))
        end = min(first + each * GRAIN, arms)
        yield first, end
        first = end


def shared(work: Callable[[int, int], None], arms: int, workers: int) -> None:
    """Have all arms worked on, by the calling thread and as many more as there is work for.

    Parameters
    ----------
    work : callable
        Takes the first arm of a range and the one behind its last.
    arms : int
        How many there are.
    workers : int
        Threads, the calling one among them.
    """
    left = list(shares(arms, workers))[::-1]

    def take() -> None:
        while True:
            try:
                share = left.pop()  # of a list, which never gives two threads the same
            except IndexError:
                return
            work(*share)

    others = min(workers, len(left)) - 1
    if others == 0:
        take()
        return
    with ThreadPoolExecutor(others) as pool:
        helpers = [pool.submit(take) for _ in range(others)]
        take()
        for helper in helpers:
            helper.result()
