"""Pick and place with the arm of two motors: how its end trembles at stops, by controller, with payloads told or not.

    python benchmarks/pick_and_place.py [--evaluations 72] [--loops 12] [--out out/bench] [--update]

The gripper (0.1 kg) fetches one object and then another from below and lays them down above, along quintics. Where it
goes next nobody knows before it sets off; weights come on the arm at that moment, and leave it likewise. Each
controller is tuned by the same search with the same number of loops, on two objects; it is judged on objects and noises
drawn afterwards, and what is shown is the worst. Real-time iterations are tuned at zero order. All that can be runs as
compiled C. `--update` renews docs/mpc.md.
"""

from __future__ import annotations

import argparse
import json
import math
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
from support.carrying import CarryingPlant, Loads, Told, Unfolding, loads_of
from support.marks import renewed

from tmm_gen.cli.console import progress
from tmm_gen.closed_loop.compare import made
from tmm_gen.closed_loop.loop import run_loop
from tmm_gen.closed_loop.search import search_nearby, search_widely
from tmm_gen.closed_loop.tracking import end_places
from tmm_gen.control.arm.arms import arm_of
from tmm_gen.control.arm.plane_frame import PlaneFrame
from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Controller
from tmm_gen.control.controllers import BY_NAME
from tmm_gen.control.estimators.kalman import present_sensors
from tmm_gen.control.goals.target import rest_with
from tmm_gen.control.goals.way import Way, shaped_way
from tmm_gen.control.goals.window import Window
from tmm_gen.control.laws.pd import PdController
from tmm_gen.control.laws.rti import RealTimeIteration
from tmm_gen.files import write_whole
from tmm_gen.onboard.emit import emit_controller
from tmm_gen.onboard.native import EmittedController
from tmm_gen.scene import Scene, load_scene
from tmm_gen.scene.each import by_names

ROOT = Path(__file__).parents[1]
SCENE = ROOT / "scenes" / "elbow.toml"
PAGE = ROOT / "docs" / "mpc.md"
GRIPPER = 0.1
"""kg."""
LIGHTEST, HEAVIEST = 0.05, 0.35
"""Objects, kg."""
TUNED_ON = ((LIGHTEST, HEAVIEST), (HEAVIEST, LIGHTEST))
BELOW, ABOVE = {"shoulder": 0.0, "elbow": -1.0}, {"shoulder": 0.7, "elbow": -0.4}
"""Joint angles, rad."""
DURATION, DWELL = 1.0, 0.6
"""Of each way and each stop, s."""
TREMBLES, OFF = 1.0, 5.0
"""What is aimed at: by how much the end may tremble at a stop, and how far it may be off, mm."""
DECADES = (1.0, 0.3)
"""How far up and down each number is searched: a third of the tries each about two beginnings, then about the best."""
LOOSELY = {"hub": 0.1, "tip_rate": 0.1, "disturbance": 0.3}
"""Factors of the second beginning, of what a controller has: hubs that may make up for beams that bend, and less noise
in its torques. The first beginning is what the scene says, which was found for steps of the reference."""


@dataclass(frozen=True)
class Row:
    """A controller, and what is tuned for it: numbers of the scene, each by a factor or each motor's by its own."""

    title: str
    controller: str
    knobs: tuple[str, ...]
    told: bool = False

    @property
    def beginnings(self) -> tuple[np.ndarray, np.ndarray]:
        """Factors of the numbers about which the search begins."""
        loosely = [LOOSELY.get(knob.rpartition(".")[2], 1.0) for knob in self.knobs]
        return np.ones(self.count), np.ones(self.count) if self.knobs is OF_PD else np.array(loosely)

    @property
    def count(self) -> int:
        """How many numbers are searched."""
        return 2 * len(self.knobs) if self.knobs is OF_PD else len(self.knobs)


OF_PD = ("proportional", "derivative")
OF_FILTER = ("control.estimator.torque", "control.estimator.disturbance")
OF_LQR = tuple(f"control.baselines.lqr.{name}" for name in ("hub", "tip_rate", "hub_rate", "torque"))
OF_MPC = tuple(f"control.weights.{name}" for name in ("hub", "tip_rate", "hub_rate", "torque"))
ROWS = (
    Row("`pd`", "pd", OF_PD),
    Row("`pd-id`", "pd-id", OF_PD),
    Row("`pd-id`, payload told", "pd-id", OF_PD, told=True),
    Row("`lqr`", "lqr", (*OF_LQR, *OF_FILTER)),
    Row("`rti-zero`", "rti-zero", (*OF_MPC, *OF_FILTER)),
    Row("`rti`", "rti", (*OF_MPC, *OF_FILTER)),
    Row("`rti-zero`, payload told", "rti-zero", (*OF_MPC, *OF_FILTER), told=True),
    Row("`rti`, payload told", "rti", (*OF_MPC, *OF_FILTER), told=True),
)


@dataclass(frozen=True)
class Figures:
    """Of a loop: the largest tremble of the arm's end at a stop, and the farthest that it is off there, mm."""

    trembles: float
    off: float
    fallbacks: int

    @property
    def price(self) -> float:
        """What is minimised."""
        price = max(self.trembles / TREMBLES, self.off / OFF)
        return price if math.isfinite(price) else 1e6


def task() -> Scene:
    """Return the arm with its trajectory."""
    poses = [{"angles": at, "duration": DURATION, "dwell": DWELL} for at in (BELOW, ABOVE, BELOW, ABOVE)]
    middle = {name: 0.5 * (BELOW[name] + ABOVE[name]) for name in BELOW}
    return load_scene(SCENE).replace(**{"control.trajectory": {"pose": poses}, "control.reference": middle})


def turned(scene: Scene, row: Row, factors: np.ndarray) -> Scene:
    """Return the scene with a controller's numbers multiplied."""
    assert scene.control is not None
    names = ("shoulder", "elbow")
    if row.knobs is OF_PD:
        key = row.controller.replace("-", "_")
        gains = np.array(by_names(getattr(scene.control.baselines, key), names))
        scaled = gains * factors.reshape(2, 2)
        return scene.replace(**{f"control.baselines.{key}": dict(zip(names, scaled.tolist(), strict=True))})
    changes = {}
    for key, factor in zip(row.knobs, factors, strict=True):
        value: object = scene
        for part in key.split("."):
            value = getattr(value, part)
        each = np.array(by_names(value, names)) * factor
        changes[key] = dict(zip(names, each.tolist(), strict=True))
    return scene.replace(**changes)


def loop(bench: Bench, controller: Controller, row: Row, objects: Sequence[float], seed: int) -> Figures:
    """Run a controller through the task, and judge its stops."""
    course = bench.course
    assert course is not None
    samples = len(course.angles) - 1
    stops = course.stops(samples)
    carried = loads_of(stops, GRIPPER, objects)
    plant = CarryingPlant(bench.scene, bench.problem, carried, seed)
    if row.told and isinstance(controller, PdController):
        controller.way = rigid_way(bench, plant, carried)
    elif row.told:
        assert isinstance(controller, EmittedController | RealTimeIteration), row.controller
        controller = Told(controller, carried)
    ran = run_loop(
        controller,
        plant,
        samples * bench.problem.sample_time,
        timed=False,
        course=Unfolding(course.angles, tuple(last for _, last in stops[:-1])),
    )
    places, frame = end_places(plant, ran), PlaneFrame.of(plant.scene, plant.scene.parts[-1].name)
    trembles, off = [], []
    for first, last in stops:
        late = places[(first + last) // 2 : last + 1]
        trembles.append(float(np.hypot(*np.ptp(late, axis=0))))
        rest = rest_with(plant.laden(carried.at(first)), course.angles[first], "control.trajectory")
        off.append(float(np.linalg.norm(late.mean(axis=0) - frame.place(rest.angles))))
    return Figures(1e3 * max(trembles), 1e3 * max(off), ran.fallbacks)


def rigid_way(bench: Bench, plant: CarryingPlant, carried: Loads) -> Way:
    """Return the way with the torques that a rigid arm would need with what it carries."""
    assert bench.course is not None
    motion = Window.of(bench.course.angles, bench.problem.sample_time).motion
    loads = np.array([carried.at(sample) for sample in range(len(motion[0]))])
    torque = np.zeros_like(motion[0])
    for mass in np.unique(loads):
        there = loads == mass
        torque[there] = arm_of(plant.laden(float(mass))).rigid_torques(*(each[there] for each in motion))
    return shaped_way(motion[0], motion[1], torque)


def quickly_made(bench: Bench, controller: str) -> Controller:
    """Return a controller for a single loop: real-time iterations at zero order, as C that compiles quickly."""
    if not controller.startswith("rti"):
        return BY_NAME[controller].make(bench)
    name, files = emit_controller(bench, "rti-zero")
    return EmittedController(
        name, files, present_sensors(bench.problem), flags=("-O1",), motors=bench.problem.count
    )


def tuned(bench: Bench, row: Row, evaluations: int) -> tuple[Scene, float]:
    """Return the scene with the best numbers found for a controller, its own among them, and their price."""
    best = (math.inf, tuple(np.ones(row.count)))

    def prices(points: Sequence[np.ndarray], about: np.ndarray, decades: float) -> list[float]:
        nonlocal best
        found = []
        for places in points:
            factors = about * 10.0 ** (decades * (2.0 * places - 1.0))
            tried = bench.retuned(turned(bench.scene, row, factors))
            controller = quickly_made(tried, row.controller)
            runs = [loop(tried, controller, row, objects, seed) for seed, objects in enumerate(TUNED_ON)]
            found.append(max(run.price for run in runs))
            best = min(best, (found[-1], tuple(factors)))
        return found

    (wide, near), middle, each = DECADES, np.full(row.count, 0.5), evaluations // 3

    def widely(about: np.ndarray, seed: int) -> None:
        prices([middle], about, wide)
        search_widely(lambda points, _: prices(points, about, wide), row.count, each - 1, seed)

    for seed, beginning in enumerate(row.beginnings):
        widely(beginning, seed)
    about = np.array(best[1])
    search_nearby(lambda points, _: prices(points, about, near), [middle], evaluations - 2 * each, seed=0)
    return turned(bench.scene, row, np.array(best[1])), best[0]


def judged(bench: Bench, row: Row, loops: int) -> list[Figures]:
    """Return the figures of loops with objects and noises that no search has seen."""
    random, controller = np.random.default_rng(1000), made(BY_NAME[row.controller], bench, compiled=True)
    drawn = random.uniform(LIGHTEST, HEAVIEST, (loops, 2))
    return [loop(bench, controller, row, objects, 1000 + k) for k, objects in enumerate(drawn)]


def trials(evaluations: int, loops: int) -> list[dict[str, object]]:
    """Return a row of the table for each controller."""
    bench, searched, rows = Bench.of(task()), dict[tuple[object, ...], tuple[Scene, float]](), []
    with progress("controllers", total=len(ROWS)) as advance:
        for row in ROWS:
            key = (row.controller.partition("-zero")[0], row.told)
            if key not in searched:
                searched[key] = tuned(bench, row, evaluations)
            scene, price = searched[key]
            every = judged(bench.retuned(scene), row, loops)
            trembling = [each.trembles for each in every]
            rows.append(
                {
                    "controller": row.title,
                    "trembles_mm": max(trembling),
                    "trembles_median_mm": float(np.median(trembling)),
                    "off_mm": max(each.off for each in every),
                    "fallbacks": sum(each.fallbacks for each in every),
                    "price_tuned": price,
                }
            )
            print(rows[-1], flush=True)
            advance(1, row.title)
    return rows


def section(rows: Sequence[dict[str, object]]) -> str:
    """Return the page's table."""
    lines = [
        "| controller | trembles at stops, worst / median (mm) | off at stops, worst (mm) |",
        "|---|---|---|",
    ]
    for row in rows:
        worst, median, off = (
            f"{float(str(row[key])):.{digits}f}"
            for key, digits in (("trembles_mm", 2), ("trembles_median_mm", 2), ("off_mm", 1))
        )
        lines.append(f"| {row['controller']} | {worst} / {median} | {off} |")
    return "\n".join(lines)


def main() -> None:
    """Run, print and keep."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--evaluations", type=int, default=72, help="numbers tried in each search")
    parser.add_argument("--loops", type=int, default=12, help="that judge a controller")
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    parser.add_argument("--update", action="store_true", help=f"renew {PAGE.name}")
    given = parser.parse_args()
    rows = trials(given.evaluations, given.loops)
    print(section(rows))
    given.out.mkdir(parents=True, exist_ok=True)
    write_whole(given.out / "pick_and_place.json", json.dumps(rows, indent=1) + "\n")
    if given.update:
        write_whole(PAGE, renewed(PAGE.read_text(), section(rows), Path(__file__).name))
        print(f"wrote {PAGE}")


if __name__ == "__main__":
    main()
