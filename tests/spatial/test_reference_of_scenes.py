"""What the reference says of scenes in space: outputs by column, how long to look, the fastest mode."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tmm_gen.inputs.signals import Constant
from tmm_gen.reference.duration import default_duration, slowest_vibration
from tmm_gen.reference.frequency import fastest_mode
from tmm_gen.reference.reference import exact_response
from tmm_gen.scene import Scene, parse_scene

MASS, LENGTH, STIFFNESS, DAMPING, PUSH = 2.0, 0.5, 3.0, 0.4, 0.2
POINT = f"""
name = "point"
[model]
kind = "spatial"
gravity = [0, 0, {{gravity}}]
[integrator]
name = "newmark"
step = 1e-3
[base]
kind = "clamp"
[[joint]]
name = "hinge"
axis = "z"
{{spring}}
[[body]]
name = "weight"
on = "hinge"
at = [{LENGTH}, 0, 0]
mass = {MASS}
[[input]]
name = "push"
at = "weight"
acts = "force"
in = "body"
[[output]]
name = "tip"
at = "weight"
of = "position"
[[output]]
name = "angle"
at = "hinge"
of = "angle"
[[output]]
name = "passed"
at = "hinge"
of = "torque"
"""


def point(*, sprung: bool, gravity: float = 0.0) -> Scene:
    """Return a point mass on a hinge."""
    spring = f"stiffness = {STIFFNESS}\ndamping = {DAMPING}" if sprung else ""
    return parse_scene(POINT.format(gravity=gravity, spring=spring))


def test_follower_force_on_a_spring() -> None:
    """It turns with the arm, so that the equation is linear and its solution known."""
    times = np.linspace(0.0, 2.0, 9)
    inertia = MASS * LENGTH**2
    decay = DAMPING / (2.0 * inertia)
    turned = math.sqrt(STIFFNESS / inertia - decay**2)
    rest = PUSH * LENGTH / STIFFNESS
    wave = np.cos(turned * times) + decay / turned * np.sin(turned * times)
    angle = rest * (1.0 - np.exp(-decay * times) * wave)
    rate = rest * np.exp(-decay * times) * (turned + decay**2 / turned) * np.sin(turned * times)
    found = exact_response(point(sprung=True), {"push_y": Constant(PUSH)}, times)
    assert found["angle"] == pytest.approx(angle, abs=1e-11)
    assert found["tip_x"] == pytest.approx(LENGTH * np.cos(angle), abs=1e-11)
    assert found["tip_y"] == pytest.approx(LENGTH * np.sin(angle), abs=1e-11)
    assert found["passed"] == pytest.approx(-STIFFNESS * angle - DAMPING * rate, abs=1e-10)
    assert not np.any(found["tip_z"])


def test_fastest_mode_and_duration() -> None:
    scene = point(sprung=True)
    frequency = math.sqrt(STIFFNESS / MASS) / LENGTH
    mode = fastest_mode(scene)
    assert mode.frequency == pytest.approx(frequency)
    assert mode.damping_ratio == pytest.approx(DAMPING / (2.0 * math.sqrt(STIFFNESS * MASS) * LENGTH))
    assert slowest_vibration(scene) == pytest.approx(frequency)
    assert 1.0 <= default_duration(scene) * frequency / (10.0 * math.pi) < 2.0


def test_duration_of_a_free_joint() -> None:
    """Gravity sets the time where there is some, and as if there were some where there is none."""
    assert slowest_vibration(point(sprung=False)) is None
    assert default_duration(point(sprung=False)) == default_duration(point(sprung=False, gravity=-9.81))
    slower = default_duration(point(sprung=False, gravity=-1.6))
    assert slower > default_duration(point(sprung=False))
