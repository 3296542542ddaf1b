"""Kernels for GPUs: NVRTC compiles them, registers suffice, and threads do what the C code does."""

from __future__ import annotations

import ctypes
import os
import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from tmm_gen.errors import UserError
from tmm_gen.native import compile_kernel
from tmm_gen.native.cuda import compile_cuda, cuda_source
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene, load_scene

SCENES = Path(__file__).resolve().parents[2] / "scenes"
ARMS, STEPS, EVERY = 3, 6, 2
HOST = """
#include <cmath>
#define __global__
static struct { int x; } blockIdx = {0}, blockDim = {1}, threadIdx = {0};
extern "C" void thread(int arm) { blockIdx.x = arm; }
"""
"""A processor that plays one thread of a GPU after another."""


def scene_of(name: str, integrator: str, real: str = "float64") -> Scene:
    emit = {"backends": ["c"], "real": real}
    return load_scene(SCENES / f"{name}.toml").replace(**{"integrator.name": integrator}, emit=emit)


@pytest.mark.parametrize("name", ["thesis10", "arm10"])
def test_in_float32_registers_suffice(name: str) -> None:
    """Nothing is spilled, and in memory are but the 32 bytes that sines of large angles take: for an H100."""
    if not os.environ.get("CI"):
        pytest.importorskip("nvidia.cuda_nvrtc")
    scene = scene_of(name, "newmark", "float32")
    made = compile_cuda(cuda_source(build_program(scene), scene), "sm_90")
    assert made.spilled == 0
    assert made.stack <= 32
    assert 32 <= made.registers <= 255
    assert made.cubin.startswith(b"\x7fELF")
    assert f"{name}_run".encode() in made.cubin


def test_what_nvrtc_refuses_is_said() -> None:
    if not os.environ.get("CI"):
        pytest.importorskip("nvidia.cuda_nvrtc")
    with pytest.raises(UserError, match=r"NVRTC refuses the source for sm_90: .* error: "):
        compile_cuda("no C at all")


@pytest.mark.compiler
@pytest.mark.parametrize(("name", "integrator"), [("thesis2", "zhou"), ("arm2", "sdirk2")])
def test_threads_take_the_steps_of_the_c_code(
    name: str, integrator: str, tmp_path: Path, need_tool: Callable[..., str]
) -> None:
    """Start-up steps, stages; arms that differ, and one that is refused on its way. Bits are those of the C code."""
    scene = scene_of(name, integrator)
    program = build_program(scene)
    (tmp_path / "arms.cpp").write_text(HOST + cuda_source(program, scene))
    flags = ["-O1", "-ffp-contract=off", "-w", "-fPIC", "-shared", "arms.cpp", "-o", "arms.so"]
    subprocess.run([need_tool("g++"), *flags], cwd=tmp_path, check=True)
    library = ctypes.CDLL(str(tmp_path / "arms.so"))

    kernel = compile_kernel(program, scene)
    stages = max(map(len, program.stage_instants))
    draw = np.random.default_rng(2)
    signals = {v.name: draw.normal(size=(STEPS, stages, ARMS)) for v in program.inputs}
    signals[program.inputs[0].name][3, :, 1] = np.inf
    models, states, started, expected = [], [], [], []
    for arm in range(ARMS):
        first = program.parameters[0]
        kernel.prepare({first.name: np.multiply(first.default, 1.0 + 0.01 * arm)})
        kernel.initialise()
        models.append(np.concatenate([np.ravel(kernel.model[v.name]) for v in program.model]))
        states.append(np.concatenate([np.ravel(kernel.state[v.name]) for v in program.state]))
        started.append(kernel.state.get("start_steps_taken", 0))
        rows = [list(kernel.output().values())]
        for k in range(STEPS):
            acting = {v.name: signals[v.name][k, : v.length or 1, arm] for v in program.inputs}
            try:
                kernel.step(
                    {name: value if value.size > 1 else float(value[0]) for name, value in acting.items()}
                )
            except FloatingPointError:
                break
            rows.append(list(kernel.output().values()))
        rows += [[np.nan] * len(program.outputs)] * (STEPS + 1 - len(rows))
        expected.append(rows[::EVERY])

    model, state = (np.ascontiguousarray(np.transpose(each)) for each in (models, states))
    outputs = np.zeros((STEPS // EVERY + 1, len(program.outputs), ARMS))
    status, counted = np.full(ARMS, -1, np.intc), np.array(started, np.intc)
    acting = []
    for v in program.inputs:
        jumps = [jump // 8 for jump in signals[v.name].strides]
        acting += [_pointer(signals[v.name]), *map(ctypes.c_longlong, jumps)]
    counter = [_pointer(counted)] if program.startup else []
    arrays = (_pointer(model), _pointer(state), *counter, *acting, _pointer(outputs), _pointer(status))
    for arm in range(ARMS):
        library.thread(arm)
        getattr(library, f"{name}_run")(*map(ctypes.c_longlong, (ARMS, STEPS, EVERY)), *arrays)
    assert status.tolist() == [0, 1, 0]
    np.testing.assert_array_equal(outputs, np.moveaxis(expected, 0, 2))
    assert np.isnan(outputs[2:, :, 1]).all()
    assert np.isfinite(outputs[..., [0, 2]]).all()


def test_arms_with_numbers_built_in_are_refused() -> None:
    scene = scene_of("thesis2", "newmark").replace(**{"emit.parameters": "bound"})
    with pytest.raises(UserError, match="on a GPU arms may differ"):
        cuda_source(build_program(scene), scene)


def _pointer(array: np.ndarray) -> ctypes.c_void_p:
    return ctypes.c_void_p(array.ctypes.data)
