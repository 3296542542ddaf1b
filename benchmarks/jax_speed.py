"""What JAX kernels cost: compile times, and time per arm, link and step; every scene's step is compared with NumPy's.

    .venv/bin/python benchmarks/jax_speed.py --update

Processor time of one thread, float64. Compiled is one step; then one arm, many arms, and many arms with derivatives of
where they end by all their stiffnesses (one run backward). `--update` writes the table into docs/jax.md.
"""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Callable
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

os.environ["XLA_FLAGS"] = "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"

import numpy as np
from support.marks import renewed

from tmm_gen.csv_text import csv_text
from tmm_gen.extras import install, packages
from tmm_gen.files import write_whole
from tmm_gen.native.python_module import jax_module, numpy_module
from tmm_gen.program.build import build_program
from tmm_gen.scene import load_scene

try:
    import jax
    import jax.numpy as jnp
except ImportError:
    print(f"left out: JAX is not installed: {install(*packages('jax'))}")
    raise SystemExit from None

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "jax.md"
SPACE = ("examples/space/arm6",)
TIMED = ("scenes/thesis10", "scenes/arm10", "scenes/arm50", "scenes/gripper")
ARMS, STEPS, RUNS = 256, 50, 3


def difference(scene: Any, program: Any, ours: Any) -> float:
    """Return how far a step from a random motion is from NumPy's, relative to the largest number of the state."""
    theirs = numpy_module(scene, program)
    draw = np.random.default_rng(1)
    size = 1.0 if scene.model.kind == "chain" else 0.2 / program.stations
    start = theirs.initialise()
    values = {
        v.name: np.asarray(getattr(start, v.name)) + size * draw.normal(size=v.length or ())
        for v in program.state
    }
    acting = {v.name: 0.1 * draw.normal() for v in program.inputs}
    new = jax.jit(ours.step)(ours.prepare(), ours.State(**values), ours.Input(**acting))
    expected = theirs.step(theirs.prepare(), theirs.State(**values), theirs.Input(**acting))
    names = [each.name for each in fields(expected) if each.name != "steps_taken"]
    a, b = (np.concatenate([np.ravel(getattr(x, name)) for name in names]) for x in (new, expected))
    return float(np.abs(a - b).max() / np.abs(b).max())


def seconds(call: Callable[[], Any]) -> float:
    """Return the least processor time of a few calls, the first left out."""
    jax.block_until_ready(call())
    best = float("inf")
    for _ in range(RUNS):
        start = time.process_time()
        jax.block_until_ready(call())
        best = min(best, time.process_time() - start)
    return best


def measured(path: str, timed: bool) -> dict[str, Any]:
    """Return one row."""
    scene = load_scene(ROOT / f"{path}.toml")
    program = build_program(scene)
    ours = jax_module(scene, program)
    model, state = jax.jit(lambda: (ours.prepare(), ours.initialise()))()
    begin = time.process_time()
    lowered = jax.jit(ours.step).lower(model, state, ours.Input())
    traced = time.process_time()
    lowered.compile()
    row = {
        "scene": scene.name,
        "trace": traced - begin,
        "compile": time.process_time() - traced,
        "difference": difference(scene, program, ours),
    }
    print(row, flush=True)
    if not timed:
        return row
    name = program.parameters[[v.name for v in program.parameters].index("stiffness")].name
    usual = np.asarray(getattr(ours.Params(), name))

    def end(scale: Any) -> Any:
        _, last = ours.simulate(STEPS, params=replace(ours.Params(), **{name: usual * scale}))
        return last

    scales = np.linspace(0.9, 1.1, ARMS)
    each = 1e9 / STEPS / scene.stations
    one = jax.jit(end)
    many = jax.jit(jax.vmap(end))
    slopes = jax.jit(jax.vmap(jax.grad(lambda scale: jnp.sum(end(scale).angle ** 2))))
    every = np.broadcast_to(scales.reshape(-1, *[1] * usual.ndim), (ARMS, *usual.shape))
    row |= {
        "one": each * seconds(lambda: one(1.0)),
        "many": each / ARMS * seconds(lambda: many(scales)),
        "slopes": each / ARMS * seconds(lambda: slopes(every)),
    }
    print(row, flush=True)
    return row


def told(rows: list[dict[str, Any]]) -> str:
    """Return the rows as a table of the page."""
    lines = [
        f"JAX {jax.__version__}, float64, one thread; {ARMS} arms, {STEPS} steps.",
        "",
        "| scene | traced in | compiled in | one arm | many | many, with derivatives | beside NumPy |",
        "| --- | ---: | ---: | ---: | ---: | ---: | ---: |",
    ]
    for row in rows:
        times = [f"{row[key]:.0f} ns" if key in row else "" for key in ("one", "many", "slopes")]
        lines.append(
            f"| `{row['scene']}` | {row['trace']:.2f} s | {row['compile']:.2f} s | {' | '.join(times)} "
            f"| {row['difference']:.0e} |"
        )
    return "\n".join(lines)


def main() -> None:
    """Measure, print, keep; write the page where that is asked for."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    parser.add_argument("--update", action="store_true", help="write the table into docs/jax.md")
    options = parser.parse_args()
    jax.config.update("jax_enable_x64", True)
    scenes = [f"scenes/{path.stem}" for path in sorted((ROOT / "scenes").glob("*.toml"))]
    rows = [measured(path, path in TIMED) for path in (*scenes, *SPACE)]
    assert all(row["difference"] < 1e-12 for row in rows)
    options.out.mkdir(parents=True, exist_ok=True)
    keys = ("scene", "trace", "compile", "one", "many", "slopes", "difference")
    write_whole(
        options.out / "jax_speed.csv", csv_text([{key: row.get(key, "") for key in keys} for row in rows])
    )
    print(told(rows))
    if options.update:
        write_whole(PAGE, renewed(PAGE.read_text(), told(rows), "jax_speed.py"))


if __name__ == "__main__":
    main()
