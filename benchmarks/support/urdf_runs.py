"""Robots drawn at random, imported, built and run: their motions at a step and at half of it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from support.random_urdf import random_urdf

from tmm_gen.emit.numpy import emit_numpy
from tmm_gen.native.python_module import import_package
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene, load_scene
from tmm_gen.urdf.scene_text import imported_scene

Array = NDArray[np.float64]

UNTIL = 0.05
"""s."""
PULL = 3.0
"""N m; spread of the torques."""
STEP = 1e-3
"""s; the other run takes half of it."""


@dataclass(frozen=True, eq=False)
class UrdfRun:
    """A robot that was run.

    Parameters
    ----------
    text : str
        Its URDF.
    scene : Scene
        As imported.
    names : tuple of str
        The URDF's joints that turn, in the order of the scene's.
    torques : array, (n,)
        In its joints, constant from the start, N m.
    coarse, fine : array, (n,)
        Angles at `UNTIL`, after steps of `STEP` and of half of it, rad.
    """

    text: str
    scene: Scene
    names: tuple[str, ...]
    torques: Array
    coarse: Array
    fine: Array

    def judged(self, exact: Array) -> tuple[float, float, float]:
        """Return how far the farthest joint went, rad; and the errors of both runs as shares of that."""
        way = float(np.max(np.abs(exact)))
        coarse, fine = (float(np.max(np.abs(found - exact))) / way for found in (self.coarse, self.fine))
        return way, coarse, fine


def urdf_run(seed: int, folder: Path, count: int | None = None, massless: bool = True) -> UrdfRun:
    """Import a robot and run it from rest under its weight and a torque in each joint.

    Parameters
    ----------
    seed, count, massless
        As of :func:`support.random_urdf.random_urdf`.
    folder : Path
        Where its files are written.
    """
    text = random_urdf(seed, count, massless)
    (folder / "robot.urdf").write_text(text, encoding="utf-8")
    made = imported_scene(folder / "robot.urdf")
    (folder / "robot.toml").write_text(made.text, encoding="utf-8")
    scene = load_scene(folder / "robot.toml")
    assert scene.spatial is not None
    module = import_package(emit_numpy(build_program(scene), scene), scene.name)
    torques = PULL * np.random.default_rng(seed).normal(size=scene.stations)
    joints = [joint.name for joint in scene.spatial.joints]
    given = module.Input(
        **{item.name: torques[item.joint - 1] for item in scene.spatial.inputs if item.acts == "torque"}
    )

    def angles(step: float) -> Array:
        model, state = module.prepare(step=step), module.initialise(module.Params(), given)
        for _ in range(round(UNTIL / step)):
            state = module.step(model, state, given)
        return np.asarray(state.angle)

    of = {motor: name for name, motor in made.motors.items()}
    names = tuple(of[joint] for joint in joints)
    return UrdfRun(text, scene, names, torques, angles(STEP), angles(STEP / 2))
