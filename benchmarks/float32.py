"""What single precision costs in accuracy, by the unknown of the sweep.

    python benchmarks/float32.py --out out/bench

The C kernel of scenes/thesis10.toml in `float`, Newmark 1/4, 20 s under a torque of 1 N m on the tip.
The error is the largest in the tip angle against the same kernel in `double`, relative to the peak;
beside it that of the double against the exact response. Displacement unknowns lose digits to the 1/h^2
of the thesis's B (3-1); increments and accelerations have no such factor. The second table is a million steps of the
scene's own 10 ms under 1 N m and two tones on it.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from support.float32_error import single_precision

from tmm_gen.cli.console import Column, progress, table
from tmm_gen.csv_text import csv_text
from tmm_gen.files import write_whole
from tmm_gen.inputs.signals import Constant
from tmm_gen.native import compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.reference.reference import exact_response
from tmm_gen.scene import Scene, load_scene
from tmm_gen.simulate.metrics import largest_error

UNKNOWNS = ("displacement", "increment", "acceleration")
STEPS = (1e-2, 1e-3, 1e-4)
DURATION = 20.0
MANY = 1_000_000
SCENE = Path(__file__).resolve().parents[1] / "scenes" / "thesis10.toml"


def tip(scene: Scene) -> tuple[np.ndarray, np.ndarray]:
    """Return instants and tip angle of the compiled kernel."""
    times, outputs = compile_kernel(build_program(scene), scene).simulate(DURATION, {"tip_torque": 1.0})
    return times, outputs["tip"]


def measure(unknown: str, step: float) -> dict[str, object]:
    """Compare single with double precision, and double with the exact response."""
    scene = load_scene(SCENE).replace(**{"model.unknown": unknown, "integrator.step": step})
    times, double = tip(scene)
    _, single = tip(scene.replace(**{"emit.real": "float32"}))
    exact = exact_response(scene, {"tip_torque": Constant(1.0)}, times)["tip"]
    peak = float(np.max(exact))
    return {
        "unknown": unknown,
        "step": step,
        "error_float32": largest_error(single, double, peak),
        "error_of_the_method": largest_error(double, exact, peak),
    }


def measure_long(unknown: str) -> dict[str, object]:
    """Compare single with double precision over a million steps."""
    scene = load_scene(SCENE).replace(**{"model.unknown": unknown})
    error, _ = single_precision(
        scene, {"tip_torque": lambda t: 1.0 + np.sin(0.3 * t) + np.sin(0.7 * t)}, MANY
    )
    return {"unknown": unknown, "error_float32": error.largest, "growth": error.growth}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    out = parser.parse_args().out
    rows = []
    with progress("simulating", total=len(UNKNOWNS) * len(STEPS)) as advance:
        for unknown in UNKNOWNS:
            for step in STEPS:
                advance(0, doing=f"{unknown}, step {step:g} s")
                rows.append(measure(unknown, step))
                advance()
    columns: list[Column | str] = [
        "unknown",
        Column("step", "step (s)", "g"),
        Column("error_float32", "error of float", ".1e"),
        Column("error_of_the_method", "error of the method", ".1e"),
    ]
    table(rows, columns, title=f"thesis10 in C, newmark, {DURATION:g} s, relative to the peak")
    long = [measure_long(unknown) for unknown in UNKNOWNS]
    shown: list[Column | str] = [
        "unknown",
        Column("error_float32", "error of float", ".1e"),
        Column("growth", form="+.2f"),
    ]
    table(long, shown, title=f"thesis10 in C, newmark, {MANY} steps, relative to the peak")
    write_whole(out / "float32.csv", csv_text(rows))
    print(f"wrote {out / 'float32.csv'}")


if __name__ == "__main__":
    main()
