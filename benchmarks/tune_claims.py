"""What `tmm-gen tune` claims against what another run finds, on three scenes: error and time.

    python benchmarks/tune_claims.py

For each scene a configuration is tuned and written; the written file is then read in a process of its own, which
knows nothing of the search: it runs the compiled C by `simulate`, holds it against the reference at every step, and
times the kernel on another motion, free of loads after the start. Error and time have to be within 20 % of the claim.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from tmm_gen.cli.console import Column, progress, table
from tmm_gen.native import NativeKernel

SCENES = Path(__file__).resolve().parents[1] / "scenes"
TASKS = (
    ("thesis10", ("--max-error", "1e-4", "--max-time", "1ms")),
    ("arm10", ("--max-error", "0.1mm", "--max-time", "10ms", "--integrators", "newmark,sdirk4")),
    ("fall10", ("--max-error", "1e-3", "--max-time", "1ms", "--integrators", "newmark,bathe,sdirk4")),
)
ROUNDS = 9
ALLOWED = 0.2


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--verify", nargs=2, metavar=("FILE", "UNTIL"), help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.verify:
        print(json.dumps(verified(Path(given.verify[0]), float(given.verify[1]))))
        return 0
    rows = []
    with progress("tuning", total=len(TASKS)) as advance, tempfile.TemporaryDirectory() as folder:
        for name, bounds in TASKS:
            rows.append(compared(name, bounds, Path(folder) / f"{name}.toml"))
            advance()
    columns: list[Column | str] = [
        "scene",
        "configuration",
        Column("claimed_error", form=".3e"),
        Column("found_error", form=".3e"),
        Column("claimed_us", "claimed (µs per simulated s)", ".4g"),
        Column("found_us", "found", ".4g"),
        Column("holds"),
    ]
    table(rows, columns, title="claims of `tmm-gen tune` and what another run finds")
    return 0 if all(row["holds"] for row in rows) else 1


def compared(name: str, bounds: tuple[str, ...], target: Path) -> dict[str, object]:
    """Tune a scene, and let another process look at the result."""
    words = [sys.executable, "-m", "tmm_gen", "tune", str(SCENES / f"{name}.toml"), *bounds]
    told = subprocess.run(
        [*words, "--out", str(target), "--json"], capture_output=True, text=True, check=True
    )
    claim = json.loads(told.stdout)
    again = [sys.executable, __file__, "--verify", str(target), str(claim["until"])]
    found = json.loads(subprocess.run(again, capture_output=True, text=True, check=True).stdout)
    chosen = claim["chosen"]
    claimed_us = 1e6 * chosen["seconds_per_simulated_second"]
    apart = max(abs(found["error"] / chosen["error"] - 1.0), abs(found["us"] / claimed_us - 1.0))
    return {
        "scene": name,
        "configuration": f"{chosen['integrator']}, {chosen['step']:g} s",
        "claimed_error": chosen["error"],
        "found_error": found["error"],
        "claimed_us": claimed_us,
        "found_us": found["us"],
        "holds": apart <= ALLOWED,
    }


def verified(path: Path, until: float) -> dict[str, float]:
    """Run a scene file as it is: its error, and its time for a simulated second."""
    from tmm_gen.native import compile_kernel
    from tmm_gen.program.build import build_program
    from tmm_gen.reference.reference import exact_response
    from tmm_gen.scene import load_scene
    from tmm_gen.simulate.run import simulate
    from tmm_gen.study.excitation import columns, excitation

    scene = load_scene(path)
    went = excitation(scene, until=until)
    kernel = compile_kernel(build_program(scene), scene)
    run = simulate(scene, went.signals, until, "c", kernel=kernel)
    inside = run.time <= until * (1.0 + 1e-9)
    exact = exact_response(scene, went.signals, run.time[inside])
    names = columns(scene, went.output)
    true = np.array([exact[column] for column in names])
    found = np.array([run.outputs[column][inside] for column in names])
    travel = np.max(np.linalg.norm(true - true[:, :1], axis=0))
    error = float(np.max(np.linalg.norm(found - true, axis=0)) / travel)
    step = min(scene.integrator.step, until / 4000)  # short steps: thousands of them stay within the motion
    samples = [timed(kernel, step) for _ in range(ROUNDS)]
    return {"error": error, "us": 1e-3 * float(np.median(samples)) / scene.integrator.step}


def timed(kernel: NativeKernel, step: float, steps: int = 2000) -> float:
    """Return nanoseconds per step of a loop over the kernel in C, the fastest of some."""
    from time import thread_time

    samples = []
    series, results = ((kernel.types[which] * steps)() for which in ("inputs", "outputs"))
    for _ in range(5):
        kernel.prepare(step=step)
        kernel.initialise()
        begun = thread_time()
        kernel.run(series, results)
        samples.append(1e9 * (thread_time() - begun) / steps)
    return min(samples)


if __name__ == "__main__":
    sys.exit(main())
