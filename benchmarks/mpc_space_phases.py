"""Time of the two phases of emitted real-time iterations of arms in space, by joints.

    python benchmarks/mpc_space_phases.py --update

The arm is that of `examples/space/wall3.toml`, its links of other numbers of cells. What sensors showed in a closed
loop of `rti` with the arm as the scene says is shown again to each controller, by turns: medians over the repetitions
of each sample, then over the samples. Compiled for this machine, one thread, processor time. `--update` renews
docs/mpc-speed.md.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
from mpc_solvers.record import emitted
from mpc_solvers.task import arm_in_space
from numpy.typing import NDArray
from support.marks import renewed

from tmm_gen.cli.console import Column, table
from tmm_gen.closed_loop.loop import run_loop
from tmm_gen.closed_loop.space_plant import SpacePlant
from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Command, Flags, Status
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.files import write_whole
from tmm_gen.onboard.native import EmittedController

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "mpc-speed.md"
CELLS = ((3, 2), (3, 3), (5, 5))
"""Of both links; each cell is two joints."""
KINDS = ("rti", "rti-zero")
ROUNDS = 12
DURATION = 2.0

Array = NDArray[np.float64]


class Heard:
    """A controller that keeps what it is shown."""

    def __init__(self, controller: EmittedController) -> None:
        self.controller, self.measured = controller, list[Array]()

    def reset(self) -> None:
        """Forget all."""
        self.controller.reset()
        self.measured.clear()

    def follow(self, angles: Array) -> Status:
        """Take a reference that moves."""
        return self.controller.follow(angles)

    def prepare(self) -> None:
        """Do what needs no measurement."""
        self.controller.prepare()

    def command(self, measured: Array, valid: Flags | None = None) -> Command:
        """Return the torques."""
        self.measured.append(measured)
        return self.controller.command(measured, valid)


def phases(cells: Sequence[tuple[int, int]]) -> list[dict[str, object]]:
    """Return a row for each arm and controller; microseconds."""
    rows: list[dict[str, object]] = []
    nominal = next(case for case in CONDITIONS if case.name == "nominal")
    for each in cells:
        bench = Bench.of(arm_in_space(each))
        made = {kind: emitted(bench, kind) for kind in KINDS}
        heard = Heard(made["rti"])
        run_loop(heard, SpacePlant(bench.scene, bench.problem, nominal, 0), DURATION, timed=False)
        measured = np.array(heard.measured)
        runs: dict[str, list[tuple[Array, Array]]] = {kind: [] for kind in KINDS}
        for _ in range(ROUNDS):
            for kind, controller in made.items():
                controller.reset()
                found = controller.run(measured)
                runs[kind].append((found.seconds, found.commanded))
        for kind in KINDS:
            whole, feedback = 1e6 * np.median(np.array(runs[kind]), axis=0)
            rows.append(
                {
                    "joints": 3 + 2 * sum(each),
                    "controller": kind,
                    "whole_us": float(np.median(whole)),
                    "whole_p99_us": float(np.percentile(whole, 99)),
                    "feedback_us": float(np.median(feedback)),
                }
            )
    return rows


def section(rows: Sequence[dict[str, object]]) -> str:
    """Return the page's table."""
    lines = [
        "| joints | controller | whole sample (µs) | 99 % | from measurement to torque (µs) |",
        "|---:|---|---:|---:|---:|",
    ]
    for row in rows:
        whole, late, feedback = (float(str(row[key])) for key in ("whole_us", "whole_p99_us", "feedback_us"))
        lines.append(
            f"| {row['joints']} | `{row['controller']}` | {whole:.0f} | {late:.0f} | {feedback:.1f} |"
        )
    return "\n".join(lines)


def main() -> None:
    """Print the table, and renew the page if asked to."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--update", action="store_true", help=f"renew {PAGE.name}")
    given = parser.parse_args()
    rows = phases(CELLS)
    columns: list[Column | str] = [
        "joints",
        "controller",
        Column("whole_us", "whole (µs)", ".0f"),
        Column("whole_p99_us", "99 %", ".0f"),
        Column("feedback_us", "feedback (µs)", ".1f"),
    ]
    table(rows, columns, title="phases of a sample")
    if given.update:
        write_whole(PAGE, renewed(PAGE.read_text(encoding="utf-8"), section(rows), Path(__file__).name))


if __name__ == "__main__":
    main()
