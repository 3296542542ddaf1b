"""Parameters bound at generation: constants, with the bits that prepare would give."""

from __future__ import annotations

import ctypes
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tmm_gen.c_language.real import REALS
from tmm_gen.emit.c import emit_kernel, free_scene
from tmm_gen.emit.c.bind import bind
from tmm_gen.emit.c.lower import lower
from tmm_gen.emit.c.structs import structs_of
from tmm_gen.errors import UserError
from tmm_gen.native import compile_kernel
from tmm_gen.native.compiler import compile_library
from tmm_gen.native.layout import structure_of
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene, load_scene

SCENES = Path(__file__).resolve().parents[3] / "scenes"


def _scene(name: str, real: str, parameters: str = "bound") -> Scene:
    return load_scene(SCENES / f"{name}.toml").replace(**{"emit.real": real, "emit.parameters": parameters})


@pytest.mark.compiler
@pytest.mark.parametrize("real", ["float32", "float64"])
@pytest.mark.parametrize("name", ["thesis10", "arm10", "drivetrain"])
def test_bound_numbers_are_those_that_prepare_computes(name: str, real: str) -> None:
    scene = _scene(name, real)
    program = build_program(scene)
    kernel = compile_kernel(program, scene)
    kernel.prepare()
    bound = bind(lower(program), REALS[real])
    model = kernel.model
    assert model
    for variable, values in bound.items():
        if variable.name in model:
            assert np.array_equal(np.atleast_1d(model[variable.name]), np.array(values)), variable.name


def _state_after(scene: Scene, steps: int) -> bytes:
    """Run the bound C itself: it has neither params nor model."""
    program = build_program(scene)
    real = REALS[scene.emit.real]
    library: Any = ctypes.CDLL(str(compile_library(emit_kernel(program, scene))))
    types = {s.name: structure_of(s, real) for s in structs_of(program) if s.name not in ("params", "model")}
    state, inputs = types["state"](), types["inputs"]()
    number = ctypes.c_float if real.size == 4 else ctypes.c_double
    given = [(number * (v.length or 1))(*([0.05] * (v.length or 1))) for v in program.given]
    assert getattr(library, f"{scene.name}_initialise")(*map(ctypes.byref, (state, *given, inputs))) == 0
    for k in range(steps):
        setattr(inputs, program.inputs[0].name, 0.25 * (k % 5 - 2))
        assert getattr(library, f"{scene.name}_step")(ctypes.byref(state), ctypes.byref(inputs)) == 0
    return bytes(state)


@pytest.mark.compiler
@pytest.mark.parametrize("real", ["float32", "float64"])
@pytest.mark.parametrize("name", ["thesis10", "arm10"])
def test_a_bound_kernel_gives_the_bits_of_a_free_one(name: str, real: str) -> None:
    scene = _scene(name, real)
    program = build_program(scene)
    kernel = compile_kernel(program, scene)  # free
    kernel.prepare()
    kernel.initialise(**{v.name: 0.05 for v in program.given})
    for k in range(50):
        kernel.step({program.inputs[0].name: 0.25 * (k % 5 - 2)})
    assert _state_after(scene, 50) == bytes(kernel._state)


def test_a_bound_header_offers_three_functions() -> None:
    scene = _scene("arm10", "float32")
    files = emit_kernel(build_program(scene), scene)
    for word in ("arm10_params", "arm10_model", "arm10_prepare"):
        assert word not in files["c/arm10.h"]
    assert "static const real joint_impedance[ARM10_STATIONS] = {" in files["c/arm10.c"]
    assert (
        "length = 0.1f; /* link length" in files["c/arm10.c"]
    )  # the shortest that reads back as the same float


def test_only_what_is_read_is_kept() -> None:
    scene = _scene("thesis10", "float32")
    source = emit_kernel(build_program(scene), scene)["c/thesis10.c"]
    for line in source.splitlines():
        if line.startswith("static const real "):
            name = line.split()[3].partition("[")[0]
            assert source.count(name) > 1, name


def test_parameters_no_arm_has_cannot_be_bound() -> None:
    scene = _scene("thesis10", "float64")
    program = lower(build_program(scene))
    from dataclasses import replace

    upside_down = tuple(replace(p, default=-1.0) if p.name == "inertia" else p for p in program.parameters)
    with pytest.raises(UserError, match="not positive; they cannot be bound"):
        bind(replace(program, parameters=upside_down), REALS["float64"])


def test_wrappers_get_free_parameters() -> None:
    scene = _scene("thesis10", "float32")
    assert free_scene(scene).emit.parameters == "free"
    assert free_scene(free_scene(scene)) == _scene("thesis10", "float32", "free")
