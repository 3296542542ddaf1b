"""Time of one step: C in double and single precision, CasADi, NumPy for one arm and for a thousand at once.

    python benchmarks/speed.py --out out/bench

Every backend is measured in turn, several times over; shown are medians. Ratios are formed within one
round, so that a machine that is busy for a while slows both sides, and then their median is taken.
CasADi's step takes the parameters as an argument, so that it computes in every step what the others
`prepare` once.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable
from pathlib import Path

import casadi as ca
import numpy as np

from tmm_gen.cli.console import Column, progress, table
from tmm_gen.csv_text import csv_text
from tmm_gen.files import write_whole
from tmm_gen.native import compile_kernel
from tmm_gen.native.python_module import casadi_module, numpy_module
from tmm_gen.program.build import build_program
from tmm_gen.program.count import count_routine
from tmm_gen.scene import Scene, load_scene

ROUNDS = 7
ARMS = 1000
SCENES = sorted((Path(__file__).resolve().parents[1] / "scenes").glob("*.toml"))

Timer = Callable[[], float]
"""Returns nanoseconds per step."""


def timers(scene: Scene) -> dict[str, Timer]:
    """Return a measurement for each backend."""
    program = build_program(scene)
    double = compile_kernel(program, scene)
    single_scene = scene.replace(**{"emit.real": "float32"})
    single = compile_kernel(build_program(single_scene), single_scene)
    return {
        "c_double": double.timer(),
        "c_float": single.timer(),
        "casadi": casadi_timer(scene, program),
        "numpy": numpy_timer(scene, program, ()),
        "numpy_batch": numpy_timer(scene, program, (ARMS,)),
    }


def casadi_timer(scene: Scene, program: object, steps: int = 200) -> Timer:
    """Time CasADi's own virtual machine over many steps in one call."""
    module = casadi_module(scene, program)
    p = module.default_parameters()
    u = ca.DM.zeros(len(module.INPUT_NAMES), 1)
    initial = module.initial_function()
    zeros = [ca.DM.zeros(initial.size_in(k)) for k in range(initial.n_in() - 2)]
    many = module.step_function().mapaccum("many", steps)
    x = initial(*zeros, u, p)

    def measure() -> float:
        start = time.thread_time_ns()
        many(x, u, p)
        return (time.thread_time_ns() - start) / steps

    return measure


def numpy_timer(scene: Scene, program: object, batch: tuple[int, ...], steps: int = 50) -> Timer:
    """Time the NumPy kernel, per arm where there are many."""
    module = numpy_module(scene, program)
    model, given = module.prepare(), module.Input(**{i.name: np.zeros(batch) for i in scene.inputs})
    start_state = module.initialise(module.Params(), given)

    def measure() -> float:
        state = start_state
        start = time.thread_time_ns()
        for _ in range(steps):
            state = module.step(model, state, given)
        return (time.thread_time_ns() - start) / steps / (batch[0] if batch else 1)

    return measure


def measure(scene: Scene, rounds: int, advance: Callable[[], None]) -> dict[str, object]:
    """Measure all backends in turn, several times over."""
    program = build_program(scene)
    each = timers(scene)
    found: dict[str, list[float]] = {name: [] for name in each}
    for _ in range(rounds):
        for name, timer in each.items():
            found[name].append(timer())
        advance()
    row: dict[str, object] = {
        "scene": scene.name,
        "stations": scene.stations,
        "integrator": scene.integrator.name,
        "operations_per_station": count_routine(program.main).total / scene.stations,
    }
    row |= {f"{name}_ns": statistics.median(values) for name, values in found.items()}
    row["c_double_ns_per_station"] = statistics.median(found["c_double"]) / scene.stations
    for name in [name for name in found if name != "c_double"]:
        ratios = [value / base for value, base in zip(found[name], found["c_double"], strict=True)]
        row[f"{name}_over_c_double"] = statistics.median(ratios)
    return row


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    parser.add_argument("--rounds", type=int, default=ROUNDS)
    given = parser.parse_args()
    rows = []
    with progress("measuring", total=len(SCENES) * given.rounds) as advance:
        for path in SCENES:
            scene = load_scene(path)
            advance(0, doing=scene.name)
            rows.append(measure(scene, given.rounds, advance))
    columns: list[Column | str] = [
        "scene",
        "stations",
        "integrator",
        Column("operations_per_station", "operations per station", ".0f"),
        Column("c_double_ns", "C double (ns)", ".0f"),
        Column("c_double_ns_per_station", "per station", ".1f"),
        Column("c_float_over_c_double", "C float", lambda x: f"{x:.2f} x"),
        Column("casadi_over_c_double", "CasADi", lambda x: f"{x:.1f} x"),
        Column("numpy_over_c_double", "NumPy", lambda x: f"{x:.0f} x"),
        Column("numpy_batch_over_c_double", f"NumPy, {ARMS} arms", lambda x: f"{x:.1f} x"),
    ]
    table(rows, columns, title=f"time of one step; medians of {given.rounds} rounds, ratios to C double")
    write_whole(given.out / "speed.csv", csv_text(rows))
    print(f"wrote {given.out / 'speed.csv'}")


if __name__ == "__main__":
    main()
