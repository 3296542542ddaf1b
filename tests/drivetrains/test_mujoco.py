"""Drivetrains in MuJoCo: hinges side by side, and tendons over two of them where gears and springs lie between."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest

from tmm_gen.export.mjcf.model import mujoco_model
from tmm_gen.inputs.signals import Constant
from tmm_gen.reference.reference import exact_response
from tmm_gen.scene import Scene, load_scene, parse_scene

mujoco = pytest.importorskip("mujoco")

UNTIL = 0.05

HELD = """
name = "held"
[model]
kind = "chain"
[integrator]
name = "newmark"
step = 1e-4
[base]
kind = "clamp"
[[joint]]
name = "root"
stiffness = 300.0
damping = 0.05
[[link]]
name = "first"
on = "root"
inertia = 0.01
[[gear]]
name = "up"
on = "first"
ratio = 0.25
stiffness = 900.0
damping = 0.1
[[link]]
name = "fast"
on = "up"
inertia = 0.002
[[joint]]
name = "aside"
on = "first"
stiffness = 50.0
[[link]]
name = "other"
on = "aside"
inertia = 0.004
[initial]
angles = { first = 0.1, fast = 0.3, other = -0.2 }
rates = { first = 1.0, fast = 0.0, other = 2.0 }
[[input]]
name = "push"
at = "fast"
acts = "torque"
[[output]]
name = "first"
at = "first"
of = "angle"
[[output]]
name = "fast"
at = "fast"
of = "rate"
[[output]]
name = "other"
at = "other"
of = "acceleration"
[[output]]
name = "teeth"
at = "up"
of = "torque"
"""


def ended(scene: Scene, values: Mapping[str, float]) -> dict[str, float]:
    """Return the outputs of the exported model at the end."""
    exported = mujoco_model(scene)
    model = mujoco.MjModel.from_xml_string(exported.text)
    model.opt.timestep = 1e-5
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    for name, value in values.items():
        data.actuator(name).ctrl[:] = value
    for _ in range(round(UNTIL / 1e-5)):
        mujoco.mj_step(model, data)
    mujoco.mj_forward(model, data)
    return {
        reading.name: reading.constant
        + sum(factor * data.sensor(sensor).data[index] for sensor, index, factor in reading.terms)
        for reading in exported.readings
    }


def geartrain(repository: Path) -> tuple[Scene, dict[str, float]]:
    """Return the example with torques on its motor and its loads."""
    scene = load_scene(repository / "scenes" / "geartrain.toml")
    return scene, {item.name: value for item, value in zip(scene.inputs, (2.0, -3.0, 0.2), strict=True)}


@pytest.mark.parametrize("which", ["geartrain", "held"])
def test_a_drivetrain_moves_alike(which: str, repository: Path) -> None:
    scene, values = geartrain(repository) if which == "geartrain" else (parse_scene(HELD), {"push": 0.7})
    right = exact_response(scene, {k: Constant(v) for k, v in values.items()}, np.array([UNTIL]))
    found = ended(scene, values)
    assert set(found) == set(right)
    for name, exact in right.items():
        assert found[name] == pytest.approx(float(exact[0]), rel=1e-6, abs=1e-9), name
