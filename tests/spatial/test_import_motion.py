"""Robots drawn at random, imported, built and run: they fall as the reference says, with errors of the step's order."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from support.random_urdf import random_urdf

from tmm_gen.emit.numpy import emit_numpy
from tmm_gen.native.python_module import import_package
from tmm_gen.program.build import build_program
from tmm_gen.reference.spatial_motion import motion
from tmm_gen.scene import load_scene
from tmm_gen.urdf.scene_text import imported_scene

UNTIL = 0.1


def fallen(module: ModuleType, step: float) -> np.ndarray:
    """Return the angles after a fall from rest."""
    model, given = module.prepare(step=step), module.Input()
    state = module.initialise(module.Params(), given)
    for _ in range(round(UNTIL / step)):
        state = module.step(model, state, given)
    return np.asarray(state.angle)


@pytest.mark.parametrize(("seed", "joints"), [(3, 3), (4, 4), (12, 5), (15, 5)])
def test_a_robot_falls_as_the_reference_says(seed: int, joints: int, tmp_path: Path) -> None:
    (tmp_path / "robot.urdf").write_text(random_urdf(seed, joints), encoding="utf-8")
    (tmp_path / "robot.toml").write_text(imported_scene(tmp_path / "robot.urdf").text)
    scene = load_scene(tmp_path / "robot.toml")
    assert scene.spatial is not None
    module = import_package(emit_numpy(build_program(scene), scene), scene.name)
    exact = motion(scene.spatial, {}, np.array([UNTIL]))[0][0]
    way = np.max(np.abs(exact))
    assert way > 0.05
    coarse, fine = (np.max(np.abs(fallen(module, step) - exact)) for step in (2e-3, 1e-3))
    assert coarse < 1e-2 * way
    assert np.log2(coarse / fine) == pytest.approx(2.0, abs=0.1)
