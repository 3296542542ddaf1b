"""An end to work that takes too long, in the main thread of a system that has timers."""

from __future__ import annotations

import math
import signal
from collections.abc import Iterator
from contextlib import contextmanager


class OutOfTime(Exception):  # noqa: N818 - it names an outcome, not a mistake
    """The time is over."""


@contextmanager
def limit(seconds: float) -> Iterator[None]:
    """Raise :class:`OutOfTime` in work that takes longer."""
    if math.isinf(seconds):
        yield
        return

    def end(*_: object) -> None:
        raise OutOfTime

    former = signal.signal(signal.SIGALRM, end)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, former)
