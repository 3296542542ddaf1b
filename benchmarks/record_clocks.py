"""Fit records with clocks of every sort: the number that made them, or a refusal; and how often intervals hold it.

Clocks start anywhere (zero, a moment later, seconds, days or Unix time away, before zero), count seconds or others,
rows and cells are missing. Then clocks that jitter. Exits with 1 if a number is wrong, or intervals hold it too seldom.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tmm_gen.calibration.calibrate import calibrate
from tmm_gen.cli.console import progress, table
from tmm_gen.errors import UserError
from tmm_gen.inputs.signals import Table
from tmm_gen.native import compile_kernel
from tmm_gen.native.series import Series
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene, load_scene

Array = NDArray[np.float64]
KEY, TRUTH, STEP, UNTIL = "beam.bending_stiffness", 9.0, 2e-3, 1.0
UNITS = {"s": 1.0, "ms": 1e3, "us": 1e6, "ns": 1e9, "minutes": 1.0 / 60.0}
NEVER = 0.9
"""Share of the intervals of 95 % that must hold the truth at least."""


def torque(time: Array) -> Array:
    wanted: Array = np.interp(time, [0.0, 0.2, 0.4, 0.6, 0.8], [1.0, 1.0, -1.0, 1.0, 0.0])
    return wanted


def recorded(scene: Scene) -> dict[str, Table]:
    """Return what the arm does whose stiffness is to be found."""
    truth = scene.replace(**{KEY: TRUTH})
    kernel = compile_kernel(build_program(truth), truth)
    steps = round(UNTIL / STEP)
    outputs = Series(kernel, {"hub_torque": torque}, steps, STEP).run()
    times = STEP * np.arange(steps + 1, dtype=float)
    found = {name: Table(times, outputs[name]) for name in ("hub", "tip_x", "tip_y")}
    return {**found, "hub_torque": Table(times, torque(times))}


def clocked(record: dict[str, Table], unit: float, random: np.random.Generator) -> dict[str, Table]:
    """Return the record with rows and cells missing, on another clock."""
    starts = [
        0.0,
        random.uniform(0, 0.01),
        random.uniform(-5, 5),
        random.uniform(1, 1e5),
        random.uniform(1.6e9, 1.9e9),
    ]
    start = starts[int(random.integers(len(starts)))]
    kept = random.random(len(record["hub"].times)) < random.uniform(0.2, 1.0)
    kept[0] = True
    found = {}
    for name, each in record.items():
        rows = kept & (random.random(len(kept)) > 0.3) if name != "hub_torque" else np.ones_like(kept)
        rows[0] = True
        found[name] = Table(unit * (each.times[rows] + start), each.values[rows])
    return found


def jittered(record: dict[str, Table], random: np.random.Generator) -> dict[str, Table]:
    """Return the record every 10 ms, each row up to 4 ms too early or too late."""
    times = record["hub"].times[::5]
    taken = np.clip(times + random.uniform(-4e-3, 4e-3, len(times)), 0.0, UNTIL)
    noisy = {
        name: Table(
            times, np.interp(taken, each.times, each.values) + 1e-4 * random.standard_normal(len(times))
        )
        for name, each in record.items()
    }
    return {**noisy, "hub_torque": record["hub_torque"]}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--each", type=int, default=100, help="records for each unit, and with jitter")
    parser.add_argument("--seed", type=int, default=0)
    chosen = parser.parse_args()
    swing = load_scene(Path(__file__).resolve().parents[1] / "scenes" / "swing.toml")
    scene = swing.replace(**{"beam.links": 2, "integrator.step": STEP})
    record = recorded(scene)
    random = np.random.default_rng(chosen.seed)
    rows: list[dict[str, object]] = []
    bad = False
    with progress("fitting", total=(len(UNITS) + 1) * chosen.each) as advance:
        for name, unit in UNITS.items():
            counts: Counter[str] = Counter()
            for _ in range(chosen.each):
                try:
                    (found,) = calibrate(scene, clocked(record, unit, random), [KEY]).found
                    counts["right" if abs(found.value / TRUTH - 1.0) < 2e-3 else "wrong"] += 1
                except UserError:
                    counts["refused"] += 1
                advance(1, name)
            bad |= counts["wrong"] > 0
            rows.append({"clock": name, **{key: counts[key] for key in ("right", "refused", "wrong")}})
        held = 0
        for _ in range(chosen.each):
            (found,) = calibrate(scene, jittered(record, random), [KEY]).found
            held += found.interval[0] <= TRUTH <= found.interval[1]
            advance(1, "jitter")
    table(rows, ["clock", "right", "refused", "wrong"], title="Clocks of records")
    print(f"with clocks that jitter, {held} of {chosen.each} intervals of 95 % hold the truth")
    return 1 if bad or held < NEVER * chosen.each else 0


if __name__ == "__main__":
    sys.exit(main())
