"""After a violent release: a bent arm is let go, and stages solved at once are no worse than those of sdirk4.

    python benchmarks/release.py --update

The arms of `time_to_error.py`, clamped, with 0.2 kg and a force of 4 N at the tip that bends them, which lets go at
once. Steps iterate as often as they take, as `run` does. Error: the largest of the tip's place at 0.1, 0.2 ... 1 s
against Lagrange's equations. Time: of the second in C, by turns, thread time, medians. `--update` writes the table into
docs/integrators.md.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from support.marks import renewed
from time_to_error import CHECKPOINTS, FLAGS, Make, arm

from tmm_gen.files import write_whole
from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.native.recording import record
from tmm_gen.program.build import build_program
from tmm_gen.reference.planar_reference import planar_response
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

PAGE = Path(__file__).resolve().parents[1] / "docs" / "integrators.md"
FORCE, TIP = -4.0, 0.2
"""N, upward; kg."""
LINKS = 10
PER_INTERVAL = (2, 4, 8, 16, 32, 64)
INTEGRATORS = ("sdirk4", "radau3")
ROUNDS = 9


def bent(scene: Scene) -> Array:
    """Return the angles at which springs hold the force, rad."""
    stiffness = np.array([joint.stiffness for joint in scene.joints])
    lengths = np.array([link.length for link in scene.links])
    joints = np.eye(len(lengths)) - np.eye(len(lengths), k=-1)
    springs = joints.T @ (stiffness[:, None] * joints)
    angles = np.zeros(len(lengths))
    for _ in range(50):
        left = springs @ angles - FORCE * lengths * np.cos(angles)
        angles -= np.linalg.solve(springs + np.diag(FORCE * lengths * np.sin(angles)), left)
    return angles


def released(integrator: str) -> Scene:
    """Return the arm at the instant it is let go."""
    scene = arm("gravity", LINKS, integrator, make=Make(tip=TIP)).replace(**{"model.gravity": None})
    return scene.replace(initial={"angles": bent(scene).tolist()})


def second(kernel: NativeKernel, per_interval: int) -> Callable[[], tuple[Array, float, float]]:
    """Return what takes a second, and yields the tip at the checkpoints, sweeps a step and time, s."""
    kernel.prepare(step=0.1 / per_interval)
    steps = 10 * per_interval

    def run() -> tuple[Array, float, float]:
        kernel.prepare(step=0.1 / per_interval)
        kernel.initialise()
        begun = time.thread_time()
        found = record(kernel, {}, steps)
        taken = time.thread_time() - begun
        if found.failed is not None:
            return np.full((10, 2), np.inf), np.inf, taken
        tip = np.column_stack([found.outputs["tip_x"], found.outputs["tip_y"]])
        return tip[per_interval - 1 :: per_interval], float(found.states["sweeps"][-1]) / steps, taken

    return run


def measured() -> list[str]:
    """Return the table."""
    response = planar_response(released("sdirk4"), {}, np.concatenate([[0.0], CHECKPOINTS]))
    exact = np.column_stack([response["tip_x"], response["tip_y"]])[1:]
    kernels = {}
    for name in INTEGRATORS:
        scene = released(name)
        kernels[name] = compile_kernel(build_program(scene, auto=True), scene, flags=FLAGS)
    lines = [
        "| steps a second | error, `sdirk4` | error, `radau3` | its iterations a step | its time over `sdirk4` |",
        "|---:|---:|---:|---:|---:|",
    ]
    for per_interval in PER_INTERVAL:
        runs = {name: second(kernel, per_interval) for name, kernel in kernels.items()}
        errors, rounds = {}, 0.0
        for name, run in runs.items():
            places, rounds, _ = run()
            errors[name] = float(np.max(np.linalg.norm(places - exact, axis=1)))
        ratio = statistics.median(runs["radau3"]()[2] / runs["sdirk4"]()[2] for _ in range(ROUNDS))
        one, other = (f"{errors[name]:.1e}" for name in INTEGRATORS)
        lines.append(f"| {10 * per_interval} | {one} | {other} | {rounds:.1f} | {ratio:.2f} |")
    return lines


def main() -> None:
    """Measure and print, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--update", action="store_true", help="write the table into docs/integrators.md")
    given = parser.parse_args()
    lines = measured()
    print("\n".join(lines))
    if given.update:
        write_whole(PAGE, renewed(PAGE.read_text(), "\n".join(lines), "release.py"))
        print(f"updated {PAGE}")


if __name__ == "__main__":
    main()
