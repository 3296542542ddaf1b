"""What accuracy costs: integrators, steps, links and number types beside each other."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any

from tmm_gen.api.acting import excited
from tmm_gen.api.frames import pandas
from tmm_gen.api.guard import guarded
from tmm_gen.api.html import html_table
from tmm_gen.api.picture import Picture, target_of
from tmm_gen.api.several import Few, axes_given
from tmm_gen.api.wording import in_python
from tmm_gen.api.words import path_of, whole
from tmm_gen.csv_text import csv_text
from tmm_gen.errors import UserError
from tmm_gen.files import write_whole
from tmm_gen.scene import Scene
from tmm_gen.study.executors import executor
from tmm_gen.study.findings import Finding, findings, summary
from tmm_gen.study.grid import configurations
from tmm_gen.study.point import Point
from tmm_gen.study.study import Study, run_study

__all__ = ["Trade", "traded"]

_COLUMNS = {
    "configuration": "configuration",
    "step": "step (s)",
    "error": "time error",
    "modelling_error": "modelling error",
    "us_per_simulated_second": "µs per simulated s",
    "operations": "operations per step",
    "code_bytes": "code (bytes)",
    "state_bytes": "state (bytes)",
}


@dataclass(frozen=True, eq=False, repr=False)
class Trade:
    """Error and cost of each configuration.

    Parameters
    ----------
    study : Study
        What was measured.
    """

    study: Study

    @property
    def points(self) -> tuple[Point, ...]:
        """Every configuration with ``result`` and ``cost``, in the order of the grid."""
        return self.study.points

    @property
    def front(self) -> list[Point]:
        """Those that no other beats in both error and cost, cheapest first."""
        return self.study.front()

    @property
    def rows(self) -> list[dict[str, object]]:
        """What ``tmm-gen trade --json`` has of every configuration."""
        return self.study.rows(self.points)

    @property
    def findings(self) -> tuple[Finding, ...]:
        """The cheapest ways to some errors."""
        return findings(self.study)

    @property
    def statement(self) -> str:
        """What was tried, under what, and who wins, in sentences."""
        return in_python("\n".join(summary(self.study)))

    @guarded
    def plot(self, file: str | PathLike[str] | None = None) -> Picture:
        """Draw error against cost; write the picture if a file is named."""
        from tmm_gen.study.figures import require_finished, trade_figure

        require_finished(self.study)
        return Picture(trade_figure(self.study), self._title, file)

    @guarded
    def csv(self, file: str | PathLike[str] | None = None) -> str:
        """Return all configurations as CSV, with every digit; write it if a file is named."""
        text = csv_text([point.values() for point in self.points])
        if file is not None:
            write_whole(target_of(file, (".csv",)), text)
        return text

    @guarded
    def report(self, file: str | PathLike[str]) -> Path:
        """Write one page that needs no other file; return where."""
        from tmm_gen.study.figures import require_finished
        from tmm_gen.study.report import report

        require_finished(self.study)
        target = target_of(file, (".html",))
        write_whole(target, report(self.study))
        return target

    @guarded
    def to_pandas(self) -> Any:
        """Return all configurations as a data frame of pandas, which must be installed."""
        return pandas().DataFrame(self.rows)

    @property
    def _title(self) -> str:
        return f"{self.study.scene.name}: error of '{self.study.excitation.output}' against cost"

    def __len__(self) -> int:
        """Return how many configurations were tried."""
        return len(self.points)

    def __repr__(self) -> str:
        """Say how many configurations were tried, and how many are worth a look."""
        return f"<Trade of {self._title}, {len(self)} configurations, {len(self.front)} that no other beats>"

    def _repr_html_(self) -> str:
        rows = self.study.rows(self.front)
        for row, point in zip(rows, self.front, strict=True):
            ns = point.ns_per_second
            row["us_per_simulated_second"] = None if ns is None else 1e-3 * ns
        told = {key: head for key, head in _COLUMNS.items() if any(row[key] is not None for row in rows)}
        return html_table(self._title, told, rows, self.statement.splitlines())


def traded(
    scene: Scene,
    options: Mapping[str, Few],
    until: float | None,
    output: str | None,
    acting: Mapping[str, object],
    workers: int | None,
    scheduler: str | None,
    store: object,
    rounds: int,
) -> Trade:
    """Study a scene; arguments as of :meth:`tmm_gen.Arm.trade`, what is varied in `options`."""
    if scheduler is not None and not isinstance(scheduler, str):
        raise UserError(f"scheduler: {scheduler!r} is no address. Write for example 'tcp://10.0.0.1:8786'.")
    computes = executor(None if workers is None else whole("workers", workers, 1), scheduler)
    kept = None if store is None else path_of("store", store)
    measured = whole("rounds", rounds, 0)
    went = excited(scene, until, output, acting)
    grid = configurations(scene, axes_given(scene, options), went.until)
    return Trade(run_study(scene, went, grid, computes, kept, measured))
