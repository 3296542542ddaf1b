"""A small arm in space that is controlled: two motors about other axes, a beam of one cell, a payload under weight."""

from __future__ import annotations

import pytest

from tmm_gen.control.bench import Bench
from tmm_gen.scene import Scene, parse_scene

REACH = """
name = "reach"
[model]
kind = "spatial"
gravity = [0, 0, -9.81]
[integrator]
name = "newmark"
step = 2e-3
[base]
kind = "clamp"
[[motor]]
name = "yaw"
axis = "z"
rotor_inertia = 0.1
damping = 0.2
[[motor]]
name = "lift"
on = "yaw"
axis = "y"
rotor_inertia = 4e-5
gear = 50
damping = 0.2
[[beam]]
name = "upper"
on = "lift"
length = 0.6
bending_stiffness = [40.0, 30.0]
mass_per_length = 0.5
links = 1
damping_time = 3e-3
[[body]]
name = "payload"
on = "upper"
mass = 0.4
inertia = [2e-4, 2e-4, 2e-4]
[[input]]
name = "yaw_torque"
at = "yaw"
acts = "torque"
[[input]]
name = "lift_torque"
at = "lift"
acts = "torque"
[[output]]
name = "payload"
at = "payload"
of = "position"
[initial]
angles = { lift = -0.5 }
[control]
reference = { yaw = 0.8, lift = 0.2 }
horizon = 12
sample_time = 0.02
substeps = 1
modes = 4
[control.weights]
tip = 1.0
hub = 4.0
tip_rate = 0.02
torque = { yaw = 1e-4, lift = 0.25 }
torque_step = { yaw = 2e-4, lift = 0.5 }
[control.bounds]
torque = { yaw = 8.0, lift = 0.16 }
[control.sensors]
encoder = 65536
[control.estimator]
torque = { yaw = 0.5, lift = 0.01 }
disturbance = { yaw = 0.1, lift = 0.002 }
rate = 0.02
[control.baselines]
pd_id = { yaw = [15, 2], lift = [0.4, 0.05] }
[control.baselines.lqr]
hub = 4.0
tip_rate = 0.02
torque = { yaw = 1e-3, lift = 2.5 }
"""


@pytest.fixture(scope="session")
def words() -> str:
    """The file of the scene."""
    return REACH


@pytest.fixture(scope="session")
def reach() -> Scene:
    """The scene."""
    return parse_scene(REACH, "reach.toml")


@pytest.fixture(scope="session")
def bench(reach: Scene) -> Bench:
    """Its models, made once."""
    return Bench.of(reach)


@pytest.fixture(scope="session")
def walled(reach: Scene) -> Bench:
    """The same arm between walls, which it would pass where it rests with its joints at the reference."""
    floor = {"frame": "payload", "normal": [0.4, 0.2, 2.0], "offset": 0.1, "margin": 0.01}
    beside = {"frame": "upper", "normal": [0.0, -1.0, 0.0], "offset": -0.41, "margin": 0.02, "weight": 3e4}
    return Bench.of(
        reach.replace(
            **{
                "control.keep": [floor, beside],
                "control.weights.hub_rate": 0.1,
                "control.bounds.hub_rate": 2.0,
            }
        )
    )
