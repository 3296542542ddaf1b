"""What a sample of emitted controllers costs on emulated microcontrollers, in a loop with half as much payload again.

    python benchmarks/mpc_board.py [--out out/bench] [--update]

Instructions are counted, not timed: the figures are exact. `--update` renews the table of docs/mpc-speed.md.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
from dataclasses import asdict
from pathlib import Path

import numpy as np
from support.marks import renewed
from support.mpc_on_board import BoardRun, run_on_board

from tmm_gen.cli.console import plain, progress, table
from tmm_gen.closed_loop.plant import Plant
from tmm_gen.control.bench import Bench
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.controllers import BY_NAME
from tmm_gen.control.estimators.kalman import present_sensors
from tmm_gen.files import write_whole
from tmm_gen.onboard.emit import emit_controller
from tmm_gen.scene import load_scene

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs" / "mpc-speed.md"
SAMPLES = 100
CASES = (
    *(
        ("swing", kind, target, real)
        for kind in ("mpc-links", "mpc-modes")
        for target, real in (("cortex-m7", "float64"), ("cortex-m4f", "float32"))
    ),
    *(("elbow", kind, "cortex-m7", "float32") for kind in ("rti-zero", "rti")),
)
HEADINGS = (
    "scene",
    "controller",
    "processor",
    "number type",
    "instructions, longest sample",
    "median",
    "from measurement to torque, longest",
    "flash",
    "memory",
    "stack",
    "torques as on the host",
)


def measured(bench: Bench, kind: str, condition: str = "payload") -> np.ndarray:
    """Return what the sensors there are show in a closed loop, (samples, sensors)."""
    case = next(case for case in CONDITIONS if case.name == condition)
    controller, plant = BY_NAME[kind].make(bench), Plant(bench.scene, bench.problem, case)
    shown = []
    for _ in range(SAMPLES):
        shown.append(plant.measured())
        plant.advance(controller.command(shown[-1]).torque)
    return np.array(shown)[:, present_sensors(bench.problem)]


def line(scene: str, kind: str, run: BoardRun) -> str:
    """Return a row of the page's table."""
    sizes = " | ".join(f"{size} B" for size in (run.code_bytes, run.ram_bytes, run.stack_bytes))
    counts = f"{run.instructions_per_sample} | {run.instructions_median} | {run.instructions_feedback}"
    bits = "every bit" if run.bits_equal else f"to {_rounded_up(run.torque_off)} N m"
    return f"| `{scene}` | {BY_NAME[kind].title} | {run.title} | {run.real} | {counts} | {sizes} | {bits} |"


def _rounded_up(number: float) -> str:
    """Return a number with one digit, not smaller."""
    power = 10.0 ** math.floor(math.log10(number))
    return f"{math.ceil(number / power) * power:.0e}"


def main() -> int:
    """Print and write the figures; return 1 if a torque of a linear controller has other bits than on the host."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    parser.add_argument("--update", action="store_true", help=f"renew {PAGE.name}")
    given = parser.parse_args()
    runs: list[tuple[str, str, BoardRun]] = []
    with progress("emulating", total=len(CASES)) as advance:
        for scene, kind, target, real in CASES:
            bench = Bench.of(load_scene(ROOT / "scenes" / f"{scene}.toml"))
            name, files = emit_controller(bench, kind, real)
            runs.append((scene, kind, run_on_board(target, name, files, measured(bench, kind), real)))
            advance()
    rows = [{"scene": scene, "controller": kind, **asdict(run)} for scene, kind, run in runs]
    shown = [
        "scene",
        "controller",
        "title",
        "real",
        "instructions_per_sample",
        "instructions_median",
        "instructions_feedback",
        "instructions_reset",
    ]
    table(rows, [*shown, "code_bytes", "ram_bytes", "stack_bytes", "bits_equal", "torque_off", "fallbacks"])
    given.out.mkdir(parents=True, exist_ok=True)
    write_whole(given.out / "mpc_board.json", json.dumps(plain(rows), indent=1) + "\n")
    print(f"wrote {given.out / 'mpc_board.json'}")
    if given.update:
        head = f"| {' | '.join(HEADINGS)} |\n{'|---' * len(HEADINGS)}|"
        text = "\n".join([head, *(line(*each) for each in runs)])
        write_whole(PAGE, renewed(PAGE.read_text(), text, Path(__file__).name))
        print(f"wrote {PAGE}")
    return 0 if all(run.bits_equal for _, kind, run in runs if kind.startswith("mpc")) else 1


if __name__ == "__main__":
    sys.exit(main())
