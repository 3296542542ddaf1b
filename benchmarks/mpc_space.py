"""Closed loops of the arm beside a wall to goals drawn at random: who arrives, when, and how far through the wall.

    python benchmarks/mpc_space.py [--goals 50] [--seed 1] [--conditions nominal,payload] [--out out/bench] [--update]

Goals are joint angles that the motors can hold, half of them such that the tool rests within 5 cm of the wall. The tool
has arrived when it stays within a centimetre of where the arm rests there. Controllers that are written in C run as
compiled C, one for all goals, told of them by `_aim()`, and of what the arm carries by `_carry()` where it is told; the
others in Python, made for each goal. What is done is kept in a file, and not done again. `--update` renews docs/mpc.md.
"""

from __future__ import annotations

import argparse
import json
import os
from dataclasses import dataclass
from functools import cache
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
from numpy.typing import NDArray
from support.carrying import payload_of
from support.marks import renewed

from tmm_gen.cli.console import progress
from tmm_gen.closed_loop.compare import made
from tmm_gen.closed_loop.loop import Loop, run_loop
from tmm_gen.closed_loop.space_plant import SpacePlant
from tmm_gen.control.arm.motors import motors_of
from tmm_gen.control.arm.space_frame import SpaceFrame
from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Command, Controller, Flags, Status
from tmm_gen.control.condition import CONDITIONS, Condition
from tmm_gen.control.controllers import BY_NAME
from tmm_gen.control.goals.target import require_within, rest_with
from tmm_gen.control.quadratic.walls import Wall
from tmm_gen.control.task.problem import control_problem
from tmm_gen.errors import UserError
from tmm_gen.files import write_whole
from tmm_gen.onboard.emit import EMITTED
from tmm_gen.onboard.native import EmittedController
from tmm_gen.scene import load_scene

ROOT = Path(__file__).parents[1]
SCENE = ROOT / "examples" / "space" / "wall3.toml"
PAGE = ROOT / "docs" / "mpc.md"
TRIED = ("pd-id", "lqr", "rti-zero", "rti")
TOLD = Condition("told", "the same, told", payload=1.5)
"""Of those that can be told."""
SHOWN = ("nominal", "payload", "told", "soft", "delay")
RANGES = {"yaw": (-1.5, 1.5), "shoulder": (-0.8, 0.4), "elbow": (0.2, 1.4)}
NEAR = 0.05
"""Goals of which half are no farther from the wall, m."""
DURATION = 2.0
ARRIVED = 0.01
"""Distance from the goal, m."""

CASES = {case.name: case for case in (*CONDITIONS, TOLD)}

Array = NDArray[np.float64]
Rows = list[dict[str, object]]


def goals(count: int, seed: int) -> list[Array]:
    """Return joint angles of so many goals, by turns near the wall and farther away, none behind it, (m,) each, rad.

    Those that the motors cannot hold are drawn again.
    """
    random, scene = np.random.default_rng(seed), load_scene(SCENE)
    problem = control_problem(scene)
    found: list[Array] = []
    walls = [Wall.of(scene, keep) for keep in problem.keeps]
    while len(found) < count:
        angles = np.array([round(float(random.uniform(*ends)), 3) for ends in RANGES.values()])
        straight = problem.motors.turned @ angles
        if abs(_off(walls[0], straight) - 0.5 * NEAR) > NEAR and len(found) % 2 == 0:
            continue  # far from where one is looked for, sagging or not
        rest = rest_with(scene, angles, "goal")
        try:
            require_within(scene, problem, rest, "goal")
        except UserError:
            continue
        off = [_off(wall, rest.angles) for wall in walls]
        allowed = all(each > keep.margin for each, keep in zip(off, problem.keeps, strict=True))
        if allowed and (off[0] <= NEAR) == (len(found) % 2 == 0):
            found.append(angles)
    return found


def _off(wall: Wall, angles: Array) -> float:
    """Return how far from a wall its part is, m."""
    return float(wall.along(angles[None])[0]) - wall.offset


def towards(goal: Array) -> Bench:
    """Return the bench of a goal."""
    scene = load_scene(SCENE)
    names = motors_of(scene).names
    return Bench.of(scene.replace(**{"control.reference": dict(zip(names, map(float, goal), strict=True))}))


@dataclass(frozen=True, eq=False)
class Aimed:
    """Emitted C that is told of a goal whenever it starts anew.

    Parameters
    ----------
    controller : EmittedController
        For any goal.
    goal : array, (m,)
        rad.
    payload : float, optional
        What it is told that the arm carries, kg.
    """

    controller: EmittedController
    goal: Array
    payload: float | None = None

    def reset(self) -> None:
        """Forget all measurements, and aim at the goal."""
        self.controller.reset()
        if self.payload is not None and self.controller.carry(self.payload) is not Status.OK:
            raise SystemExit(f"no rest with {self.payload} kg")
        if self.controller.aim(self.goal) is not Status.OK:
            raise SystemExit(f"no rest at {self.goal}")

    def follow(self, angles: Array) -> Status:
        """Take a reference that moves."""
        return self.controller.follow(angles)

    def prepare(self) -> None:
        """Do what needs no measurement."""
        self.controller.prepare()

    def command(self, measured: Array, valid: Flags | None = None) -> Command:
        """Return the torques."""
        return self.controller.command(measured, valid)


@cache
def emitted(name: str, delay: float) -> EmittedController:
    """Return compiled C that is told a delay."""
    scene = load_scene(SCENE).replace(**{"control.delay": delay})
    found = made(BY_NAME[name], Bench.of(scene), compiled=True)
    assert isinstance(found, EmittedController)
    return found


def controller_of(name: str, goal: Array, bench: Bench, case: Condition) -> Controller:
    """Return a controller for a goal, told of the delay, which is no secret."""
    if name in EMITTED:
        told = case.payload * payload_of(bench.scene) if case is TOLD else None
        return Aimed(emitted(name, bench.problem.delay + case.delay), goal, told)
    return made(BY_NAME[name], bench.told(case), compiled=False)


def distances(plant: SpacePlant, loop: Loop) -> Array:
    """Return how far the tool is from where it ends if it rests there, at each sample, m.

    The goal is where the arm under its condition rests with its joints at the reference.
    """
    arm = plant.scene.spatial
    assert arm is not None
    frame = SpaceFrame(arm, arm.frames[-1])
    places = frame.place(np.array([state["angle"] for state in loop.states]))
    found: Array = np.linalg.norm(places - frame.place(plant.resting), axis=1)
    return found


def violation(plant: SpacePlant, loop: Loop) -> list[float]:
    """Return by how much each part came nearer to its wall than its margin, m."""
    angles = np.array([state["angle"] for state in loop.states])
    walls = [(Wall.of(plant.scene, keep), keep) for keep in plant.problem.keeps]
    return [max(0.0, keep.offset + keep.margin - float(np.min(wall.along(angles)))) for wall, keep in walls]


def trial(name: str, number: int, goal: Array, case: Condition) -> dict[str, object]:
    """Return what came of one controller with one goal under one condition."""
    bench = towards(goal)
    plant = SpacePlant(bench.scene, bench.problem, case, number)
    loop = run_loop(controller_of(name, goal, bench, case), plant, DURATION)
    off = distances(plant, loop)
    late = np.flatnonzero(off > ARRIVED)
    low, high = bench.problem.torque
    return {
        "goal": number,
        "controller": name,
        "condition": case.name,
        "arrived_s": None if late[-1] + 1 >= len(off) else float(loop.sampled[late[-1] + 1]),
        "end_mm": 1e3 * float(off[-1]),
        "through_mm": [1e3 * each for each in violation(plant, loop)],
        "fastest": np.max(np.abs(np.diff(loop.hub, axis=0)), axis=0).tolist(),
        "within_bounds": bool(np.all((loop.torque >= low) & (loop.torque <= high))),
        "sample_ms": 1e3 * float(np.median(loop.seconds)),
        "sample_p99_ms": 1e3 * float(np.quantile(loop.seconds, 0.99)),
        "feedback_ms": 1e3 * float(np.median(loop.feedback)),
        "fallbacks": loop.fallbacks,
    }


def trials(count: int, seed: int, conditions: list[str], out: Path) -> Rows:
    """Return a row for each condition, controller and goal; what a file has already is not done again."""
    rows: Rows = json.loads(out.read_text()) if out.exists() else []
    done = {(row["condition"], row["controller"], row["goal"]) for row in rows}
    drawn = goals(count, seed)
    with progress("goals", total=count * len(conditions) * len(TRIED)) as advance:
        for condition in conditions:
            for name in TRIED:
                if condition == TOLD.name and name not in EMITTED:
                    continue
                for number, goal in enumerate(drawn):
                    if (condition, name, number) not in done:
                        rows.append(trial(name, number, goal, CASES[condition]))
                    advance(1, f"{name}, {CASES[condition].title}, goal {number}")
                write_whole(out, json.dumps(rows, indent=1) + "\n")
    return rows


def section(rows: Rows) -> str:
    """Return the page's table."""
    conditions = list(dict.fromkeys(str(row["condition"]) for row in rows))
    titles = [CASES[name].title for name in conditions]
    lines = [f"| controller | {' | '.join(titles)} | a sample takes | of that from measurement to torque |"]
    lines.append("|---" * (3 + len(conditions)) + "|")
    for name in dict.fromkeys(str(row["controller"]) for row in rows):
        own = [row for row in rows if row["controller"] == name]
        cells = " | ".join(_cell([row for row in own if row["condition"] == each]) for each in conditions)
        sample, feedback = (
            _told(np.median([float(str(row[key])) for row in own])) for key in ("sample_ms", "feedback_ms")
        )
        language = "C" if name in EMITTED else "Python"
        lines.append(f"| `{name}` | {cells} | {sample} in {language} | {feedback} |")
    return "\n".join(lines)


def _told(milliseconds: np.floating) -> str:
    return f"{milliseconds:.2f} ms" if milliseconds >= 1.0 else f"{1e3 * milliseconds:.0f} µs"


def _cell(rows: Rows) -> str:
    """Return how many goals were reached, median and latest time (s), how far tool and elbow were through (mm)."""
    if not rows:
        return "-"
    times = [float(str(row["arrived_s"])) for row in rows if row["arrived_s"] is not None]
    told = f"{np.median(times):.2f} / {max(times):.2f}" if times else "-"
    through = np.max([np.asarray(row["through_mm"], float) for row in rows], axis=0)
    return f"{len(times)} of {len(rows)}: {told}; {through[0]:.1f} / {through[1]:.1f}"


def main() -> None:
    """Run, print and keep."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--goals", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--conditions", default=",".join(SHOWN))
    parser.add_argument("--out", type=Path, default=ROOT / "out" / "bench")
    parser.add_argument("--update", action="store_true")
    given = parser.parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    rows = trials(
        given.goals, given.seed, given.conditions.split(","), given.out / f"mpc_space_{given.seed}.json"
    )
    print(section(rows))
    if given.update:
        write_whole(PAGE, renewed(PAGE.read_text(encoding="utf-8"), section(rows), Path(__file__).name))


if __name__ == "__main__":
    main()
