"""Time of the two phases of emitted real-time iterations: before a measurement, and from it to the torque.

    python benchmarks/mpc_phases.py --update

The task, the arm and how time is taken are those of `mpc_speed.py`: medians over repetitions of each sample of a closed
loop on the model itself. `--update` renews docs/mpc-speed.md.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence

import mpc_speed
import numpy as np
from mpc_solvers.record import emitted, record
from mpc_solvers.task import arm
from support.marks import renewed

from tmm_gen.cli.console import Column, table
from tmm_gen.control.bench import Bench
from tmm_gen.files import write_whole

LINKS = (2, 5, 10, 20)
KINDS = ("rti", "rti-zero")
ROUNDS = 12


def phases(counts: Sequence[int]) -> list[dict[str, object]]:
    """Return a row for each number of links and controller; microseconds."""
    rows: list[dict[str, object]] = []
    for links in counts:
        bench = Bench.of(arm(links))
        made = {kind: emitted(bench, kind) for kind in KINDS}
        measured = record(bench, made["rti"], mpc_speed.DURATION).measured
        for kind, controller in made.items():
            runs = []
            for _ in range(ROUNDS):
                controller.reset()
                runs.append(controller.run(measured))
            whole, feedback = (
                1e6 * np.median([getattr(run, name) for run in runs], axis=0)
                for name in ("seconds", "commanded")
            )
            rows.append(
                {
                    "links": links,
                    "controller": mpc_speed.EMITTED[kind],
                    "whole_us": float(np.median(whole)),
                    "feedback_us": float(np.median(feedback)),
                    "feedback_p99_us": float(np.percentile(feedback, 99)),
                }
            )
    return rows


def section(rows: Sequence[dict[str, object]]) -> str:
    """Return the page's table."""
    lines = [
        "| links | controller | whole sample (µs) | from measurement to torque (µs) | 99 % |",
        "|---:|---|---:|---:|---:|",
    ]
    for row in rows:
        whole, *feedback = (float(str(row[key])) for key in ("whole_us", "feedback_us", "feedback_p99_us"))
        told = " | ".join(f"{value:.1f}" for value in feedback)
        lines.append(f"| {row['links']} | {row['controller']} | {whole:.1f} | {told} |")
    return "\n".join(lines)


def main() -> None:
    """Print the table, and renew the page if asked to."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--links", type=int, nargs="+", default=LINKS)
    parser.add_argument("--update", action="store_true", help=f"renew {mpc_speed.PAGE.name}")
    given = parser.parse_args()
    rows = phases(given.links)
    columns: list[Column | str] = [
        "links",
        "controller",
        Column("whole_us", "whole (µs)", ".1f"),
        Column("feedback_us", "feedback (µs)", ".1f"),
        Column("feedback_p99_us", "99 %", ".1f"),
    ]
    table(rows, columns, title="phases of a sample")
    if given.update:
        page = mpc_speed.PAGE
        write_whole(page, renewed(page.read_text(), section(rows), "mpc_phases.py"))
        print(f"wrote {page}")


if __name__ == "__main__":
    main()
