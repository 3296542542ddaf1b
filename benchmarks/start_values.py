"""Start values of radau3's iterations: the last step's polynomial, its line, or its last acceleration held.

    python benchmarks/start_values.py --update

Steps of a second to an error of the tip of 1e-6 m by a kernel, with one iteration and two in the first step, on the
arms of `time_to_error.py`; and iterations of a step that `run` takes for scenes/arm10.toml in 0.4 s, whose tip is let
go at 0.2 s under a motor torque, or which a torque turns smoothly. Counts, no times. `--update` writes the table into
docs/integrators.md.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path
from unittest.mock import patch

import numpy as np
import sympy as sp
from support.marks import renewed
from time_to_error import CHECKPOINTS, FLAGS, Run, Swing, arm, fewest

from tmm_gen.derive.integrators.spectrum import Spectrum
from tmm_gen.files import write_whole
from tmm_gen.inputs.given import input_names, read_inputs
from tmm_gen.native import compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.reference.planar_reference import planar_response
from tmm_gen.scene import load_scene
from tmm_gen.simulate.run import simulate

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "integrators.md"
WANTED = 1e-6
LINKS = 10
LOADS = {
    "let go": ("hub_torque=4", "tip_force=step:5:0:0.2s"),
    "smooth": ("hub_torque=smooth:0:4:0.3s",),
}
STEPS = (1e-2, 5e-3)


def line(spectrum: Spectrum) -> sp.ImmutableMatrix:
    """Return weights of the straight line through the accelerations of the last two stages."""
    before, last = spectrum.nodes[-2:]
    rows = []
    for node in spectrum.nodes:
        share = sp.expand(sp.radsimp((1 + node - before) / (last - before)))
        rows.append([0] * (len(spectrum.nodes) - 2) + [1 - share, share])
    return sp.ImmutableMatrix(rows)


def held(spectrum: Spectrum) -> sp.ImmutableMatrix:
    """Return weights of the last acceleration, for all stages alike."""
    size = len(spectrum.nodes)
    return sp.ImmutableMatrix([[0] * (size - 1) + [1]] * size)


STARTS: dict[str, Callable[[Spectrum], sp.ImmutableMatrix]] = {
    "polynomial": Spectrum.__dict__["ahead"].func,
    "line": line,
    "held": held,
}


def steps_needed(kind: str) -> int | None:
    """Return the fewest steps of a second with the wanted error and the iterations that kernels take."""
    signal = None if kind == "gravity" else Swing()
    scene = arm(kind, LINKS, "radau3", favour="size")
    given = {} if signal is None else {"motor": signal}
    response = planar_response(scene, given, np.concatenate([[0.0], CHECKPOINTS]))
    exact = np.column_stack([response["tip_x"], response["tip_y"]])[1:]
    least = fewest(Run(compile_kernel(build_program(scene), scene, flags=FLAGS), signal, exact), WANTED)
    return None if least is None else 10 * least


def iterations(load: str, step: float) -> float | None:
    """Return how many iterations a step of a run takes in the mean."""
    changes = {"integrator.name": "radau3", "model.iterations": "auto", "emit.box": None}
    scene = load_scene(ROOT / "scenes" / "arm10.toml").replace(**changes, **{"integrator.step": step})
    signals = read_inputs(LOADS[load], *input_names(scene))
    return simulate(scene, signals, 0.4, "c", judge=False, refuse=False).sweeps_per_step


def main() -> None:
    """Count and print, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--update", action="store_true", help="write the table into docs/integrators.md")
    given = parser.parse_args()
    cases = [(load, step) for load in LOADS for step in STEPS]
    titles = [
        *(f"steps to 1e-6, {kind}" for kind in ("gravity", "motor")),
        *(f"iterations, {load}, {1e3 * step:g} ms" for load, step in cases),
    ]
    lines = ["| begins on | " + " | ".join(titles) + " |", "|---|" + "---:|" * len(titles)]
    for name, weights in STARTS.items():
        build_program.cache_clear()  # another start is another program of the same scene
        with patch.object(Spectrum, "ahead", property(weights)):
            found = [str(steps_needed(kind)) for kind in ("gravity", "motor")]
            found += [f"{iterations(load, step):.2f}" for load, step in cases]
        lines.append(f"| {name} | " + " | ".join(found) + " |")
        print(lines[-1], flush=True)
    if given.update:
        write_whole(PAGE, renewed(PAGE.read_text(), "\n".join(lines), "start_values.py"))
        print(f"updated {PAGE}")


if __name__ == "__main__":
    main()
