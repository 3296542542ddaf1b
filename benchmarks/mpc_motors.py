"""Closed loops of the arm with two motors: every controller under some conditions, on a finer arm.

    python benchmarks/mpc_motors.py [--out out/bench] [--update]

Encoders round and have no noise; what can be emitted runs as compiled C. `--update` renews docs/mpc.md.
"""

from __future__ import annotations

import argparse
import json
import os
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
from support.marks import renewed

from tmm_gen.cli.console import Column, plain, progress, table
from tmm_gen.closed_loop.compare import made
from tmm_gen.closed_loop.figures import loop_figures
from tmm_gen.closed_loop.loop import Loop, run_loop
from tmm_gen.closed_loop.plant import Plant
from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Command, Controller, Flags, Status
from tmm_gen.control.condition import CONDITIONS, Condition
from tmm_gen.control.controllers import CONTROLLERS
from tmm_gen.files import write_whole
from tmm_gen.onboard.emit import EMITTED
from tmm_gen.onboard.native import EmittedController
from tmm_gen.scene import load_scene

ROOT = Path(__file__).parents[1]
SCENE = ROOT / "scenes" / "elbow.toml"
PAGE = ROOT / "docs" / "mpc.md"
TRIED = ("nominal", "payload", "friction", "soft", "gears")
DURATION = 2.5
REPEATS = 8
NOT_COMPARED = ("pd-zv", "pd-zvd")
"""Shapers are for steps from rest to rest, and here gravity and the other joint vibrate as well."""

Rows = list[dict[str, object]]


def trials(bench: Bench) -> Rows:
    """Return a row for each controller and condition."""
    kinds = [kind for kind in CONTROLLERS if kind.compared(bench) and kind.name not in NOT_COMPARED]
    cases = [case for case in CONDITIONS if case.name in TRIED]
    rows: Rows = []
    with progress("conditions", total=len(kinds) * len(cases)) as advance:
        for kind in kinds:
            in_c = kind.name in EMITTED
            controller = made(kind, bench, in_c)
            for case in cases:
                loop = run_loop(controller, Plant(bench.scene, bench.problem, case), DURATION)
                found = loop_figures(loop)
                assert found.overshoot is not None
                seconds, feedback = times(controller, bench, loop, case)
                rows.append(
                    {
                        "controller": kind.name,
                        "condition": case.name,
                        "compiled": in_c,
                        "settling_s": found.settling,
                        "overshoot_percent": 100.0 * found.overshoot,
                        "residual_mrad": 1e3 * found.residual,
                        "torque_percent": 100.0
                        * float(np.max(np.abs(loop.torque) / bench.problem.torque[1])),
                        "solve_us": 1e6 * float(np.median(seconds)),
                        "feedback_us": 1e6 * float(np.median(feedback)),
                        "fallbacks": found.fallbacks,
                    }
                )
                advance(1, f"{kind.title}, {case.title}")
    return rows


class Noted:
    """Passes measurements on to a controller and keeps them."""

    def __init__(self, controller: Controller) -> None:
        self._controller, self.measured = controller, list[np.ndarray]()

    def reset(self) -> None:
        self.measured.clear()
        self._controller.reset()

    def follow(self, angles: np.ndarray) -> Status:
        return self._controller.follow(angles)

    def prepare(self) -> None:
        self._controller.prepare()

    def command(self, measured: np.ndarray, valid: Flags | None = None) -> Command:
        self.measured.append(measured)
        return self._controller.command(measured, valid)


def times(controller: Controller, bench: Bench, loop: Loop, case: Condition) -> tuple[np.ndarray, np.ndarray]:
    """Return processor times of whole samples and from measurements to torques, s; of C without what calls it."""
    if not isinstance(controller, EmittedController):
        return loop.seconds, loop.feedback
    noted = Noted(controller)
    run_loop(noted, Plant(bench.scene, bench.problem, case), DURATION)
    runs = []
    for _ in range(REPEATS):
        controller.reset()
        runs.append(controller.run(np.array(noted.measured)))
    return np.median([run.seconds for run in runs], axis=0), np.median(
        [run.commanded for run in runs], axis=0
    )


def section(rows: Rows) -> str:
    """Return the page's table."""
    titles = [case.title for case in CONDITIONS if case.name in TRIED]
    lines = [
        "| controller | "
        + " | ".join(titles)
        + " | torque used | a sample takes | of that from measurement to torque |"
    ]
    lines.append("|---" * (4 + len(titles)) + "|")
    for name in dict.fromkeys(row["controller"] for row in rows):
        own = [row for row in rows if row["controller"] == name]
        used = max(float(str(row["torque_percent"])) for row in own)
        solve, feedback = (
            f"{np.median([float(str(row[key])) for row in own]):.0f} µs"
            for key in ("solve_us", "feedback_us")
        )
        told = f"{solve} in {'C' if own[0]['compiled'] else 'Python'} | {feedback}"
        cells = " | ".join(_cell(row) for row in own)
        lines.append(f"| `{name}` | {cells} | {used:.0f} % | {told} |")
    return "\n".join(lines)


def _cell(row: dict[str, object]) -> str:
    """Return settling (s) / overshoot (%) / residual (mrad)."""
    when = "-" if row["settling_s"] is None else f"{float(str(row['settling_s'])):.2f}"
    return f"{when} / {float(str(row['overshoot_percent'])):.1f} / {float(str(row['residual_mrad'])):.1f}"


def main() -> None:
    """Print the table, and renew the page if asked to."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    parser.add_argument("--update", action="store_true", help=f"renew {PAGE.name}")
    given = parser.parse_args()
    rows = trials(Bench.of(load_scene(SCENE)))
    columns: list[Column | str] = [
        "controller",
        "condition",
        Column("compiled", "as C"),
        Column("settling_s", "settles (s)", ".3f"),
        Column("overshoot_percent", "overshoot (%)", ".2f"),
        Column("residual_mrad", "residual (mrad)", ".2f"),
        Column("torque_percent", "torque used (%)", ".0f"),
        Column("solve_us", "solve (µs)", ".0f"),
        Column("feedback_us", "from measurement (µs)", ".0f"),
        "fallbacks",
    ]
    table(rows, columns, title="settling, overshoot, residual")
    given.out.mkdir(parents=True, exist_ok=True)
    write_whole(given.out / "mpc_motors.json", json.dumps(plain(rows), indent=1) + "\n")
    if given.update:
        write_whole(PAGE, renewed(PAGE.read_text(), section(rows), Path(__file__).name))
        print(f"wrote {PAGE}")


if __name__ == "__main__":
    main()
