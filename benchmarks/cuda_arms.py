"""Many arms on a GPU: the emitted C in its threads, compared with the host's arms and measured. Needs CuPy and a GPU.

    pip install cupy-cuda12x
    .venv/bin/python benchmarks/cuda_arms.py

Arms of which the first parameter differs are started on the host, run on the GPU, and those of the first batch
compared with the host's own: to 1e-12 of the largest output in float64. It was written where there was no GPU.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path
from typing import Any

import numpy as np

from tmm_gen.csv_text import csv_text
from tmm_gen.extras import install
from tmm_gen.files import write_whole
from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.native.cuda import OPTIONS, cuda_source
from tmm_gen.program.build import build_program
from tmm_gen.scene import load_scene

ROOT = Path(__file__).resolve().parents[1]
SCENES = ("thesis10", "arm10", "arm50")
COUNTS = (10_000, 100_000, 1_000_000)
STEPS, THREADS, DIFFERENT = 200, 128, 16


def started(kernel: NativeKernel, real: Any) -> tuple[Any, Any, list[dict[str, float]]]:
    """Return models and states of a few arms, a column each, and where the host says that they end."""
    program = kernel.program
    first, models, states, ends = program.parameters[0], [], [], []
    for arm in range(DIFFERENT):
        kernel.prepare({first.name: np.asarray(first.default, dtype=float) * (1.0 + 1e-3 * arm)})
        kernel.initialise()
        models.append(np.concatenate([np.ravel(kernel.model[v.name]) for v in program.model]))
        states.append(np.concatenate([np.ravel(kernel.state[v.name]) for v in program.state]))
        for _ in range(STEPS):
            kernel.step({program.inputs[0].name: 0.1})
        ends.append(kernel.output())
    return np.transpose(models).astype(real), np.transpose(states).astype(real), ends


def measured(cupy: Any, name: str, number: str) -> list[dict[str, object]]:
    """Return a row for each number of arms."""
    changes = {"emit.backends": ["c"], "emit.real": number, "integrator.name": "newmark"}
    scene = load_scene(ROOT / "scenes" / f"{name}.toml").replace(**changes)
    program = build_program(scene)
    kernel = compile_kernel(program, scene)
    real = np.float32 if number == "float32" else np.float64
    few_models, few_states, ends = started(kernel, real)
    module = cupy.RawModule(code=cuda_source(program, scene), options=OPTIONS, backend="nvrtc")
    run = module.get_function(f"{name}_run")
    push, rows = cupy.full(1, 0.1, real), []
    for arms in COUNTS:
        models, fresh = (
            cupy.asarray(np.resize(each, (len(each), arms))) for each in (few_models, few_states)
        )
        outputs = cupy.zeros((2, len(program.outputs), arms), real)
        status = cupy.zeros(arms, np.int32)
        acting: list[Any] = []
        for place, _ in enumerate(program.inputs):
            acting += [push if place == 0 else cupy.zeros(1, real), *[np.int64(0)] * 3]
        seconds = []
        for _ in range(4):
            states = fresh.copy()
            cupy.cuda.Device().synchronize()
            begin = time.perf_counter()
            numbers = (np.int64(arms), np.int64(STEPS), np.int64(STEPS))
            run((-(-arms // THREADS),), (THREADS,), (*numbers, models, states, *acting, outputs, status))
            cupy.cuda.Device().synchronize()
            seconds.append(time.perf_counter() - begin)
        assert not status.any()
        found = cupy.asnumpy(outputs[1, :, :DIFFERENT])
        wanted = np.array([[end[v.name] for end in ends] for v in program.outputs])
        difference = float(np.abs(found - wanted).max() / np.abs(wanted).max())
        assert difference < (1e-12 if number == "float64" else 1e-3), difference
        each = 1e9 * min(seconds[1:]) / (arms * STEPS * scene.stations)
        rows.append({"scene": name, "numbers": number, "arms": arms, "ns": each, "difference": difference})
        print(rows[-1], flush=True)
    return rows


def main() -> None:
    """Measure, print and keep: nanoseconds per arm, link and step."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    given = parser.parse_args()
    try:
        import cupy
    except ImportError:
        print(f"left out: CuPy is not installed: {install('cupy-cuda12x')}")
        return
    rows = [
        row for name in SCENES for number in ("float32", "float64") for row in measured(cupy, name, number)
    ]
    given.out.mkdir(parents=True, exist_ok=True)
    write_whole(given.out / "cuda_arms.csv", csv_text(rows))


if __name__ == "__main__":
    main()
