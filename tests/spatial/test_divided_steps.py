"""A run in space takes shorter steps where those of its scene are too long, and corrects as often as it takes."""

from __future__ import annotations

import numpy as np

from tmm_gen.reference.spatial_reference import spatial_response
from tmm_gen.scene import parse_scene
from tmm_gen.simulate.run import simulate

ROD = """
name = "rod"
[model]
kind = "spatial"
gravity = [0.0, -1.0, -1.0]
[integrator]
name = "newmark"
step = 0.15
[base]
kind = "clamp"
[[beam]]
name = "rod"
length = 1.0
bending_stiffness = [1.0, 2.0]
mass_per_length = 0.5
links = 1
damping_time = 0.003
[[body]]
name = "payload"
on = "rod"
mass = 0.05
[[output]]
name = "tip"
at = "payload"
of = "position"
"""


def test_a_step_that_is_too_long_is_divided() -> None:
    scene = parse_scene(ROD)
    assert scene.spatial is not None
    run = simulate(scene, {}, 3.0, substeps=True)
    assert run.substeps.count > 1
    assert run.sweeps_per_step is not None
    exact = spatial_response(scene.spatial, {}, run.time)
    off = np.linalg.norm([run.outputs[name] - exact[name] for name in exact], axis=0)
    way = np.linalg.norm([values - values[0] for values in exact.values()], axis=0)
    assert run.accuracy is not None
    assert np.max(off) < 2.0 * run.accuracy.error * np.max(way)
    assert np.max(off) < 0.05 * np.max(way)


def test_steps_by_a_tolerance_keep_it() -> None:
    scene = parse_scene(ROD).replace(**{"integrator.tolerance": 1e-3, "integrator.step": 0.05})
    assert scene.spatial is not None
    run = simulate(scene, {}, 1.0)
    exact = spatial_response(scene.spatial, {}, run.time)
    off = np.linalg.norm([run.outputs[name] - exact[name] for name in exact], axis=0)
    way = np.linalg.norm([values - values[0] for values in exact.values()], axis=0)
    assert run.chosen is not None
    assert run.chosen.largest > run.chosen.smallest
    assert 2e-5 * np.max(way) < np.max(off) < 1.2e-3 * np.max(way)
