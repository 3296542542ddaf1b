"""A series is the kernel's own simulation, bit for bit."""

from __future__ import annotations

import numpy as np
import pytest

from tmm_gen.native import NonFiniteStateError, compile_kernel
from tmm_gen.native.recording import record
from tmm_gen.native.series import Series
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene, parse_scene

SCENE = """
name = "series"
[model]
kind = "chain"
[integrator]
name = "{integrator}"
step = 0.05
[base]
kind = "clamp"
[[joint]]
stiffness = 20.0
damping = 0.4
repeat = 2
[[link]]
inertia = 1.0
repeat = 2
[[input]]
name = "inner"
at = 1
acts = "torque"
[[input]]
name = "outer"
at = "tip"
acts = "torque"
[[output]]
name = "tip"
at = "tip"
of = "angle"
[[output]]
name = "rate"
at = "tip"
of = "velocity"
[emit]
real = "{real}"
"""


def scene(integrator: str, real: str = "float64") -> Scene:
    return parse_scene(SCENE.format(integrator=integrator, real=real))


# stages (sdirk4), start-up steps (houbolt), neither (newmark)
@pytest.mark.parametrize("integrator", ["newmark", "houbolt", "sdirk4"])
@pytest.mark.parametrize("real", ["float64", "float32"])
def test_a_series_is_a_simulation(integrator: str, real: str) -> None:
    arm = scene(integrator, real)
    kernel = compile_kernel(build_program(arm), arm)
    step = 0.07  # not the scene's
    signals = {"outer": lambda t: np.sin(3.0 * np.asarray(t))}
    series = Series(kernel, signals, 40, step)
    found = series.run()
    again = series.run()
    _, expected = kernel.simulate(40 * step, {"outer": lambda t: float(np.sin(3.0 * t))}, step=step)
    assert set(found) == {"tip", "rate"}
    for name, values in expected.items():
        np.testing.assert_array_equal(found[name], values)
        np.testing.assert_array_equal(again[name], values)
    assert np.max(np.abs(found["tip"])) > 0.01


def test_series_share_a_kernel() -> None:
    arm = scene("newmark")
    kernel = compile_kernel(build_program(arm), arm)
    signals = {"inner": np.cos}
    long, short = Series(kernel, signals, 10, 0.1), Series(kernel, signals, 20, 0.05)
    first = long.run()["tip"]
    short.run()
    np.testing.assert_array_equal(long.run()["tip"], first)
    assert short.seconds() > 0.0


def test_what_goes_wrong_is_raised() -> None:
    arm = scene("zhai")
    kernel = compile_kernel(build_program(arm), arm)
    with pytest.raises(NonFiniteStateError):
        Series(kernel, {"outer": np.cos}, 5000, 2.0).run()
    with pytest.raises(FloatingPointError):
        Series(kernel, {"outer": lambda t: np.full(np.shape(t), np.nan)}, 3, 0.1).run()
    with pytest.raises(ValueError, match="time step"):
        Series(kernel, {}, 3, -0.1).run()


def test_names_that_are_macros_are_recorded() -> None:
    """Inputs and outputs have a prefix in C where a macro has their name, and none here."""
    text = SCENE.format(integrator="newmark", real="float64")
    text = text.replace('"inner"', '"NAN"').replace('"tip"\nat', '"step"\nat').replace('"rate"', '"I"')
    plain, renamed = scene("newmark"), parse_scene(text)
    runs = []
    for arm in (plain, renamed):
        kernel = compile_kernel(build_program(arm), arm)
        kernel.prepare()
        kernel.initialise()
        given = {item.name: np.linspace(0.1, 0.4, 4) for item in arm.inputs}
        runs.append(list(record(kernel, given, 4).outputs.values()))
    assert np.array_equal(*runs)
    assert np.all(runs[0][0] != 0.0)
