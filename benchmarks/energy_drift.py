"""How well undamped planar arms keep their energy over 100 s: Newmark 1/4 and sdirk4, beside the step.

The arm of ``scenes/fall10.toml`` without its dampers. Drift is the largest departure of the total energy from its
first value, relative to the largest kinetic energy.
"""

from __future__ import annotations

import argparse
import csv
from pathlib import Path

import numpy as np

from tmm_gen.native import compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.reference.energy import energy
from tmm_gen.scene import Scene, load_scene

DURATION = 100.0
CASES = (("newmark", (4e-3, 2e-3, 1e-3, 5e-4)), ("sdirk4", (2e-2, 1e-2, 5e-3, 2.5e-3)))
SAMPLES = 4000


def undamped() -> Scene:
    """Return the falling arm without dampers."""
    scene = load_scene(Path(__file__).parents[1] / "scenes" / "fall10.toml")
    return scene.replace(**{"beam.damping_time": None})


def drift(scene: Scene) -> tuple[float, float]:
    """Return the drift over the first tenth and over all of the duration."""
    kernel = compile_kernel(build_program(scene), scene)
    kernel.prepare()
    kernel.initialise()
    steps = round(DURATION / scene.integrator.step)
    every = max(1, steps // SAMPLES)
    times, angles, rates = [], [], []
    for k in range(steps + 1):
        if k % every == 0:
            state = kernel.state
            times.append(k * scene.integrator.step)
            angles.append(np.array(state["angle"]))
            rates.append(np.array(state["rate"]))
        if k < steps:
            kernel.step()
    found = energy(scene, {}, np.array(times), np.array(angles), np.array(rates))
    away = np.abs(found.total - found.total[0]) / found.kinetic.max()
    return float(away[: len(away) // 10].max()), float(away.max())


def main() -> None:
    """Measure, print a table and write it as CSV."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    out = parser.parse_args().out
    out.mkdir(parents=True, exist_ok=True)
    scene = undamped()
    rows = []
    print(f"{'integrator':<10} {'step, s':>9} {'drift in 10 s':>14} {'drift in 100 s':>15}")
    for name, steps in CASES:
        for step in steps:
            early, whole = drift(scene.replace(**{"integrator.name": name, "integrator.step": step}))
            rows.append((name, step, early, whole))
            print(f"{name:<10} {step:>9g} {early:>14.2e} {whole:>15.2e}", flush=True)
    with (out / "energy_drift.csv").open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(("integrator", "step_s", "drift_10_s", "drift_100_s"))
        writer.writerows(rows)


if __name__ == "__main__":
    main()
