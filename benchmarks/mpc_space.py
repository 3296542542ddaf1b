"""Closed loops of the arm in space from one place to others drawn at random: who arrives, when, and at what cost.

    python benchmarks/mpc_space.py [--goals 3] [--seed 1] [--conditions nominal] [--out out/bench] [--update]

Goals are joint angles that the motors can hold. The tool has arrived when it stays within a centimetre of where the arm
rests there. Controllers that are written in C run as compiled C, the others in Python. `--update` renews docs/mpc.md.
"""

from __future__ import annotations

import argparse
import json
import os
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
from marks import renewed

from tmm_gen.cli.console import progress
from tmm_gen.closed_loop.compare import made
from tmm_gen.closed_loop.loop import Loop, run_loop
from tmm_gen.closed_loop.space_plant import SpacePlant
from tmm_gen.control.bench import Bench
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.controllers import BY_NAME
from tmm_gen.errors import UserError
from tmm_gen.files import write_whole
from tmm_gen.modal.space.numbers import ArmNumbers
from tmm_gen.modal.space.still import Still
from tmm_gen.onboard.emit import EMITTED
from tmm_gen.scene import load_scene

ROOT = Path(__file__).parents[1]
SCENE = ROOT / "examples" / "space" / "reach3.toml"
PAGE = ROOT / "docs" / "mpc.md"
TRIED = ("pd-id", "lqr", "rti-zero", "rti")
RANGES = {"yaw": (-1.5, 1.5), "shoulder": (-0.8, 0.4), "elbow": (0.2, 1.4)}
DURATION = 1.5
ARRIVED = 0.01
"""Distance from the goal, m."""

Rows = list[dict[str, object]]


def benches(count: int, seed: int) -> list[Bench]:
    """Return the benches of so many goals; those that the motors cannot hold are drawn again."""
    random, scene, found = np.random.default_rng(seed), load_scene(SCENE), []
    while len(found) < count:
        reference = {name: round(float(random.uniform(*ends)), 3) for name, ends in RANGES.items()}
        bench = Bench.of(scene.replace(**{"control.reference": reference}))
        try:
            _ = bench.modes
        except UserError:
            continue
        found.append(bench)
    return found


def distances(plant: SpacePlant, loop: Loop) -> np.ndarray:
    """Return how far the tool is from where it ends if it rests there, at each sample, m.

    The goal is where the arm under its condition rests with its joints at the reference.
    """
    arm = plant.scene.spatial
    assert arm is not None
    numbers, frame = ArmNumbers(arm), arm.frames[-1]
    goal = Still(numbers, plant.resting, {}).place(frame)
    places = [Still(numbers, np.array(state["angle"]), {}).place(frame) for state in loop.states]
    return np.linalg.norm(np.array(places) - goal, axis=1)


def trials(count: int, seed: int, conditions: list[str], out: Path) -> Rows:
    """Return a row for each controller, condition and goal; what is done is kept in a file."""
    rows: Rows = []
    cases = [case for case in CONDITIONS if case.name in conditions]
    with progress("goals", total=count * len(cases) * len(TRIED)) as advance:
        for number, bench in enumerate(benches(count, seed)):
            for name in TRIED:
                controller = made(BY_NAME[name], bench, compiled=True)
                for case in cases:
                    plant = SpacePlant(bench.scene, bench.problem, case, number)
                    loop = run_loop(controller, plant, DURATION)
                    off = distances(plant, loop)
                    late = np.flatnonzero(off > ARRIVED)
                    arrived = None if late[-1] + 1 >= len(off) else float(loop.sampled[late[-1] + 1])
                    low, high = bench.problem.torque
                    rows.append(
                        {
                            "goal": number,
                            "controller": name,
                            "condition": case.name,
                            "arrived_s": arrived,
                            "end_mm": 1e3 * float(off[-1]),
                            "within_bounds": bool(np.all((loop.torque >= low) & (loop.torque <= high))),
                            "sample_ms": 1e3 * float(np.median(loop.seconds)),
                            "feedback_ms": 1e3 * float(np.median(loop.feedback)),
                            "fallbacks": loop.fallbacks,
                        }
                    )
                    advance(1, f"{name}, {case.title}, goal {number}")
            write_whole(out, json.dumps(rows, indent=1) + "\n")
    return rows


def section(rows: Rows) -> str:
    """Return the page's table."""
    conditions = list(dict.fromkeys(str(row["condition"]) for row in rows))
    titles = {case.name: case.title for case in CONDITIONS}
    lines = [
        "| controller | "
        + " | ".join(titles[name] for name in conditions)
        + " | a sample takes | of that from measurement to torque |"
    ]
    lines.append("|---" * (3 + len(conditions)) + "|")
    for name in dict.fromkeys(row["controller"] for row in rows):
        own = [row for row in rows if row["controller"] == name]
        cells = " | ".join(_cell([row for row in own if row["condition"] == each]) for each in conditions)
        sample, feedback = (
            _told(np.median([float(str(row[key])) for row in own])) for key in ("sample_ms", "feedback_ms")
        )
        language = "C" if name in EMITTED else "Python"
        lines.append(f"| `{name}` | {cells} | {sample} in {language} | {feedback} |")
    return "\n".join(lines)


def _told(milliseconds: float) -> str:
    return f"{milliseconds:.2f} ms" if milliseconds >= 1.0 else f"{1e3 * milliseconds:.0f} µs"


def _cell(rows: Rows) -> str:
    """Return how many goals were reached, the median and the latest time (s), the largest distance at the end (mm)."""
    times = [float(str(row["arrived_s"])) for row in rows if row["arrived_s"] is not None]
    told = f"{np.median(times):.2f} / {max(times):.2f}" if times else "-"
    return f"{len(times)} of {len(rows)}: {told} / {max(float(str(row['end_mm'])) for row in rows):.1f}"


def main() -> None:
    """Run, print and keep."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--goals", type=int, default=3)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--conditions", default="nominal")
    parser.add_argument("--out", type=Path, default=ROOT / "out" / "bench")
    parser.add_argument("--update", action="store_true")
    given = parser.parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    rows = trials(given.goals, given.seed, given.conditions.split(","), given.out / "mpc_space.json")
    print(section(rows))
    if given.update:
        write_whole(PAGE, renewed(PAGE.read_text(encoding="utf-8"), section(rows), Path(__file__).name))


if __name__ == "__main__":
    main()
