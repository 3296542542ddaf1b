"""Own sine and cosine in emitted C: within the stated error, the same bits however they are compiled."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sympy as sp
from numpy.typing import NDArray

from tmm_gen.c_language.real import REALS
from tmm_gen.emit.c import emit_kernel
from tmm_gen.emit.c.circle import ERROR, Turns, angles_in, constants
from tmm_gen.native import compile_kernel
from tmm_gen.native.compiler import compile_library
from tmm_gen.native.library import OutOfRangeError
from tmm_gen.program.build import build_program
from tmm_gen.program.variables import Role, Variable
from tmm_gen.scene import Scene, load_scene

SCENES = Path(__file__).resolve().parents[3] / "scenes"
WRAPPER = """
#include "arm10.c"
void turn(const arm10_real *angle, arm10_real *sine, arm10_real *cosine, int count)
{
    for (int k = 0; k < count; ++k) {
        const circle found = circle_of(angle[k]);
        sine[k] = found.sine;
        cosine[k] = found.cosine;
    }
}
"""
KINDS = {"float32": np.float32, "float64": np.float64}


def _scene(real: str, **changes: object) -> Scene:
    keys = {"emit.real": real, "emit.trigonometry": "own", "emit.box": None, "emit.budget": None, **changes}
    return load_scene(SCENES / "arm10.toml").replace(**keys)


def _turn(
    real: str, angles: NDArray[Any], *flags: str, favour: str = "size"
) -> tuple[NDArray[Any], NDArray[Any]]:
    scene = _scene(real, **{"emit.favour": favour})
    files = {Path(path).name: text for path, text in emit_kernel(build_program(scene), scene).items()}
    source = files.pop("arm10.c")
    texts = {**files, "arm10.inc": source, "wrapper.c": WRAPPER.replace("arm10.c", "arm10.inc")}
    library = ctypes.CDLL(str(compile_library(texts, flags=(*flags, "-ffp-contract=off"))))
    results = [np.empty_like(angles) for _ in range(2)]
    library.turn(*(ctypes.c_void_p(a.ctypes.data) for a in (angles, *results)), ctypes.c_int(len(angles)))
    return results[0], results[1]


@pytest.mark.compiler
@pytest.mark.parametrize("real", ["float32", "float64"])
def test_compiled_sines_are_right_and_the_same_at_every_level(real: str) -> None:
    t = constants(REALS[real])
    draw = np.random.default_rng(11)
    angles = np.concatenate(
        [
            draw.uniform(-t.largest_angle, t.largest_angle, 5000),
            draw.uniform(-4.0, 4.0, 5000),
            [0.0, -0.0, t.largest_angle],
        ]
    ).astype(KINDS[real])
    sine, cosine = _turn(real, angles, "-O2")
    # NumPy's double sines are right to a unit in their own last place, which double errors are allowed on top
    allowed = (ERROR + 2.0) * 2.0**-t.digits
    assert np.max(np.abs(sine.astype(float) - np.sin(angles.astype(float)))) <= allowed
    assert np.max(np.abs(cosine.astype(float) - np.cos(angles.astype(float)))) <= allowed
    for flags, favour in ((("-O0",), "size"), (("-O3", "-march=native"), "size"), (("-O2",), "speed")):
        again = _turn(real, angles, *flags, favour=favour)
        assert again[0].tobytes() == sine.tobytes()
        assert again[1].tobytes() == cosine.tobytes()


@pytest.mark.compiler
@pytest.mark.parametrize("real", ["float32", "float64"])
def test_every_finite_angle_is_defined(real: str) -> None:
    """Outputs are read without a check of the range: nothing there may be undefined, however large the angle."""
    kind = KINDS[real]
    angles = np.array([np.finfo(kind).max, -np.finfo(kind).max, 1e30, np.finfo(kind).tiny], dtype=kind)
    plain = _turn(real, angles, "-O1")
    sane = _turn(real, angles, "-O1", "-fsanitize=undefined", "-fsanitize-undefined-trap-on-error")
    assert plain[0].tobytes() == sane[0].tobytes()


@pytest.mark.compiler
def test_a_step_beyond_the_range_is_refused_and_changes_nothing() -> None:
    scene = _scene("float32")
    kernel = compile_kernel(build_program(scene), scene)
    kernel.prepare()
    kernel.initialise()
    largest = constants(REALS["float32"]).largest_angle
    kernel.state = {"angle": [largest + 10.0] * 10}
    before = kernel.state
    with pytest.raises(OutOfRangeError, match="out of range"):
        kernel.step()
    after = kernel.state
    assert all(np.array_equal(before[name], after[name]) for name in before)
    kernel.state = {"angle": [largest - 10.0] * 10, "hub_angle": largest - 10.0}
    kernel.step()


@pytest.mark.compiler
def test_own_sines_change_a_run_by_rounding_only() -> None:
    runs = []
    for whose in ("own", "libm"):
        scene = _scene("float64", **{"emit.trigonometry": whose})
        runs.append(
            compile_kernel(build_program(scene), scene).simulate(0.2, {"hub_torque": 4.0})[1]["tip_y"]
        )
    assert 0.0 < np.max(np.abs(runs[0] - runs[1])) < 1e-11


def test_an_angle_is_turned_once_for_sine_and_cosine() -> None:
    scene = _scene("float64")
    source = emit_kernel(build_program(scene), scene)["c/arm10.c"]
    assert source.count("circle_of(") == 1 + 3  # defined, then in initialise, step and output
    assert "sin(" not in source
    assert "cos(" not in source


def test_a_chain_has_no_use_for_it() -> None:
    scene = load_scene(SCENES / "thesis10.toml").replace(**{"emit.trigonometry": "own"})
    files = emit_kernel(build_program(scene), scene)
    assert "circle" not in files["c/thesis10.c"]
    assert "OUT_OF_RANGE" not in files["c/thesis10.h"]


def test_an_angle_that_changes_is_turned_again() -> None:
    angle = Variable("angle", Role.WORK, 3)
    names = iter(["turn_1", "turn_2"])
    turns = Turns(names)
    value = sp.sin(angle.at()) * sp.cos(angle.at())
    assert turns.new_in(value) == [(angle.at(), "turn_1")]
    assert turns.new_in(value) == []
    turns.forget(angle.at(1))
    assert turns.new_in(value) == [(angle.at(), "turn_2")]
    assert angles_in(sp.Integer(1)) == []


def test_the_header_states_the_range(written: Callable[..., list[str]]) -> None:
    scene = _scene("float32")
    header = emit_kernel(build_program(scene), scene)["c/arm10.h"]
    assert "#define ARM10_LARGEST_ANGLE 6433.0f" in header
    assert "ARM10_OUT_OF_RANGE" in header
