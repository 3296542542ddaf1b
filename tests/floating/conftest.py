"""Arms that nothing holds, for the tests of this folder."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from tmm_gen.scene import Scene, load_scene, parse_scene

Array = NDArray[np.float64]

DRIFTER = """\
name = "drifter"
[model]
kind = "planar"
gravity = {gravity}
[integrator]
name = "{integrator}"
step = 1e-3
[base]
kind = "free"
[[body]]
name = "hub"
on = "base"
mass = 0.8
inertia = 0.02
[[joint]]
name = "left"
on = "hub"
stiffness = 20.0
damping = 0.01
rest = 3.0
[[link]]
name = "left_arm"
on = "left"
length = 0.6
mass = 0.3
inertia = 0.009
center = 0.4
[[joint]]
name = "right"
on = "base"
stiffness = 25.0
[[link]]
name = "right_arm"
on = "right"
length = 0.5
mass = 0.4
inertia = 0.01
[[joint]]
name = "knee"
on = "right_arm"
stiffness = 5.0
[[link]]
name = "shin"
on = "knee"
length = 0.4
mass = 0.2
inertia = 0.004
[initial]
angles = {{ left_arm = 2.5, right_arm = 0.1, shin = 0.6 }}
rates = {{ left_arm = 0.5, right_arm = -1.0, shin = 2.0 }}
[[input]]
name = "wheel"
at = "hub"
acts = "torque"
[[input]]
name = "thruster"
at = "base"
acts = "force_x"
[[input]]
name = "push"
at = "shin"
acts = "force_y"
[[output]]
name = "hub"
at = "hub"
of = "position"
[[output]]
name = "drift"
at = "base"
of = "velocity"
[[output]]
name = "jerk"
at = "base"
of = "acceleration"
[[output]]
name = "attitude"
at = "hub"
of = "angle"
[[output]]
name = "end"
at = "shin"
of = "position"
[[output]]
name = "end_velocity"
at = "shin"
of = "velocity"
[[output]]
name = "knee_force"
at = "knee"
of = "force"
[[output]]
name = "kinetic"
at = "arm"
of = "kinetic_energy"
[[output]]
name = "height"
at = "arm"
of = "gravitational_energy"
"""


@pytest.fixture(scope="session")
def drifter() -> Callable[..., Scene]:
    """A hub with two arms, one of them with a knee."""

    def made(integrator: str = "newmark", gravity: float = 0.0, **changes: object) -> Scene:
        scene = parse_scene(DRIFTER.format(integrator=integrator, gravity=gravity))
        return scene.replace(**changes) if changes else scene

    return made


@pytest.fixture(scope="session")
def drifter_text() -> str:
    """Return the same as a file."""
    return DRIFTER.format(integrator="newmark", gravity=0.0)


@pytest.fixture(scope="session")
def cube(repository: Path) -> Scene:
    """The satellite of the examples."""
    return load_scene(repository / "scenes" / "cube.toml")
