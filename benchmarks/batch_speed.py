"""Many arms side by side in C beside the same arms one after another, in one run.

    .venv/bin/python benchmarks/batch_speed.py --update

Both from the scene's own C, without reading outputs; the arms differ. One after another: the kernel as emitted, own
sines too. gcc -O3 -march=native without fused multiply-add, processor time of one thread, by turns; ratios within a
round, then their median. What a second thread gains is told by the clock on the wall, of whole calls with more arms,
start and all: on an idle machine only, or with `--busy`, where it is less than it could be.
`--update` writes the table into docs/batch.md.
"""

from __future__ import annotations

import argparse
import math
import os
import statistics
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from support.marks import renewed

from tmm_gen.cli.console import Column, progress, table
from tmm_gen.csv_text import csv_text
from tmm_gen.files import write_whole
from tmm_gen.native import FLAGS, compile_kernel
from tmm_gen.native.batch import compile_batch
from tmm_gen.native.machine import machine_flags, processors
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene, load_scene

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "batch.md"
SCENES = ("scenes/thesis10", "scenes/arm10", "scenes/arm50", "scenes/elbow", "examples/space/yaw3")
LANES = ((4, "float64"), (8, "float64"), (16, "float32"))
ARMS = 512
SHARED = 4096
"""Arms that threads share."""
ROUNDS = 15
_SECONDS = 0.05
"""Of processor time, about, that a round of a batch takes."""
_WHOLE = 0.2
"""Seconds, about, that one thread takes for a whole call with what threads share."""
_BUSY = 0.5
"""Mean load of the machine at the start above which a second thread has no processor of its own."""


def measured(scene: Scene, rounds: int, idle: bool) -> dict[str, object]:
    """Return one row: nanoseconds per arm, link and step, and ratios; what threads gain where the machine is idle."""
    program = build_program(scene)
    batch = compile_batch(program, scene)
    kernel = compile_kernel(program, scene, flags=("-O3", *FLAGS[1:], *machine_flags("gcc")))
    alone = kernel.timer()
    drawn = {
        arms: {program.parameters[0].name: np.multiply.outer(default, np.linspace(0.999, 1.001, arms))}
        for default in (np.asarray(program.parameters[0].default),)
        for arms in (ARMS, SHARED)
    }
    per_link = 1.0 / scene.stations

    def seconds(
        steps: int, threads: int = 1, arms: int = ARMS, clock: Callable[[], float] = time.process_time
    ) -> float:
        start = clock()
        duration = steps * scene.integrator.step
        run = batch.simulate(duration, params=drawn[arms], threads=threads, every=max(1, steps), arms=arms)
        assert not run.status.any()
        return clock() - start

    steps = 10
    while (spent := seconds(steps) - seconds(0)) < 0.5 * _SECONDS:
        steps *= 2
    each = spent / steps
    steps = max(10, int(_SECONDS / each))
    many_steps = max(100, int(_WHOLE * ARMS / SHARED / each))
    together, ratios, gains = [], [], []
    for _ in range(rounds):
        one = alone()
        many = 1e9 * (seconds(steps) - seconds(0)) / (steps * ARMS)
        together.append(many * per_link)
        ratios.append(many / one)
        if idle and processors() > 1:
            first, second = (seconds(many_steps, threads, SHARED, time.perf_counter) for threads in (1, 2))
            gains.append(first / second)
    return {
        "scene": scene.name,
        "numbers": f"{scene.emit.batch} x {scene.emit.real}",
        "ns": statistics.median(together),
        "ratio": statistics.median(ratios),
        "threads": statistics.median(gains) if gains else float("nan"),
    }


def told(rows: list[dict[str, object]], rounds: int) -> str:
    """Return the rows as a table of the page."""
    lines = [
        f"Medians of {rounds} rounds of {ARMS} arms; times are of one thread. Two threads: how many times as fast as "
        f"one they are with {SHARED} arms, whole calls of {_WHOLE:g} s or, where 100 steps take longer, more. "
        "A dash: others were busy on this machine.",
        "",
        "| scene | side by side | ns per arm, link and step | over one after another | two threads |",
        "| --- | --- | ---: | ---: | ---: |",
    ]
    lines += [
        f"| `{row['scene']}` | {row['numbers']} | {row['ns']:.2f} | {row['ratio']:.3f} | {gained(row['threads'])} |"
        for row in rows
    ]
    return "\n".join(lines)


def gained(times: object) -> str:
    """Return what a second thread gains, or a dash."""
    assert isinstance(times, float)
    return "–" if math.isnan(times) else f"{times:.2f}"


def main() -> None:
    """Measure and print, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    parser.add_argument("--rounds", type=int, default=ROUNDS)
    parser.add_argument("--busy", action="store_true", help="measure threads though others are busy")
    parser.add_argument("--update", action="store_true", help="write the table into docs/batch.md")
    given = parser.parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    rows: list[dict[str, object]] = []
    idle = given.busy or os.getloadavg()[0] < _BUSY
    with progress("arms side by side", len(SCENES) * len(LANES)) as advance:
        for path in SCENES:
            for lanes, real in LANES:
                changes = {"emit.batch": lanes, "emit.real": real, "emit.trigonometry": "own"}
                scene = load_scene(ROOT / f"{path}.toml").replace(**{"emit.parameters": "free", **changes})
                rows.append(measured(scene, given.rounds, idle))
                advance()
    columns: list[Column | str] = [
        "scene",
        Column("numbers", "side by side"),
        Column("ns", "ns per arm, link and step", ".2f"),
        Column("ratio", "over one after another", ".3f"),
        Column("threads", "two threads", ".2f"),
    ]
    table(rows, columns, title=f"{ARMS} arms, medians of {given.rounds} rounds")
    write_whole(given.out / "batch_speed.csv", csv_text(rows))
    print(f"wrote {given.out / 'batch_speed.csv'}")
    if given.update:
        PAGE.write_text(renewed(PAGE.read_text(), told(rows, given.rounds), "batch_speed.py"))
        print(f"updated {PAGE}")


if __name__ == "__main__":
    main()
