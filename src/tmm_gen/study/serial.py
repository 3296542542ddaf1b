"""One task after the other, in this process."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

from tmm_gen.study.outcome import Result
from tmm_gen.study.tasks import Task, compute
from tmm_gen.study.truth import Truth


class Serial:
    """Computes tasks here."""

    def results(
        self, tasks: Iterable[Task], truths: Mapping[int | None, Truth], store: Path | None
    ) -> Iterator[tuple[Task, Result]]:
        """Yield each task with its result as it is done."""
        for task in tasks:
            yield task, compute(task, truths[task.configuration.family.links], store)
