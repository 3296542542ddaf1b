"""The C of an arm with elastic gears, some of whose stations have what others have not."""

from __future__ import annotations

import ctypes

import numpy as np
import pytest

from tmm_gen.emit.c.box import box_of
from tmm_gen.emit.c.fence import fence_of
from tmm_gen.emit.c.lower import lower
from tmm_gen.native import compile_kernel
from tmm_gen.native.python_module import numpy_module
from tmm_gen.program.build import build_program
from tmm_gen.scene import parse_scene
from tmm_gen.stability.growth import Growth
from tmm_gen.stability.limits import scene_integrators, standing
from tmm_gen.stability.motion import small_motion
from tmm_gen.verify.planar_order import planar_slope

ARM = """\
name = "lever"
model = { kind = "planar" }
integrator = { name = "newmark", step = 1e-3 }
base = { kind = "free" }
body = [{ name = "hub", on = "base", mass = 1.0, inertia = 0.02 }]
motor = [{ name = "m", on = "hub", rotor_inertia = 1e-5, gear = 20, stiffness = 30.0 }]
link = [{ name = "l", on = "m", length = 0.4, mass = 0.3, inertia = 4e-3 }]
input = [{ name = "u", at = "m", acts = "torque" }]
output = [{ name = "tip", at = "l", of = "position" }]
[emit]
trigonometry = "own"
[emit.box]
angles = [-4.0, 4.0]
rates = [-20.0, 20.0]
accelerations = [-1000.0, 1000.0]
base_places = [-100.0, 100.0]
base_velocities = [-10.0, 10.0]
base_accelerations = [-100.0, 100.0]
u = [-1.0, 1.0]
"""


@pytest.mark.compiler
@pytest.mark.parametrize("real", ["float64", "float32"])
def test_prepare_reads_nothing_that_it_has_not_written(real: str) -> None:
    """A model is the caller's memory, and whatever was there may be no number."""
    scene = parse_scene(ARM).replace(**{"emit.real": real})
    kernel = compile_kernel(build_program(scene), scene)
    memory = kernel._model
    ctypes.memset(ctypes.byref(memory), 0xFF, ctypes.sizeof(memory))
    kernel.prepare()
    kernel.initialise({"u": 0.1})
    kernel.step({"u": 0.1})
    assert np.isfinite(kernel.output()["tip_x"])


def test_pivots_of_some_stations_alone_have_bounds() -> None:
    scene = parse_scene(ARM)
    program, box = lower(build_program(scene)), box_of(scene)
    assert box is not None
    fence = fence_of(program, box, program.main)
    assert fence.least
    assert all(least > 0.0 for least in fence.least.values())


def test_a_link_that_turns_at_a_constant_rate_shows_no_order() -> None:
    """Its angle is exact with every step: nothing to fit, and nothing wrong."""
    scene = parse_scene(ARM)
    row = planar_slope(scene, numpy_module(scene, build_program(scene)), {})
    assert row.passed, row.meaning


def test_what_turns_freely_has_any_step() -> None:
    """Without spring and damper all steps are alike; what limits them is what swings."""
    motion = small_motion(parse_scene(ARM))
    newmark, zhai = (
        standing(motion, Growth(m)) for m in scene_integrators(motion.scene, ["newmark", "zhai"])
    )
    assert newmark.largest_step == float("inf")
    assert zhai.largest_step == pytest.approx(2.0 / motion.highest.frequency, rel=1e-9)
