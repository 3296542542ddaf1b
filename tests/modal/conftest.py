"""Scenes and characteristic equations the tests of the frequency domain share."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from tmm_gen.scene import Scene, load_scene, parse_scene

SCENES = Path(__file__).resolve().parents[2] / "scenes"

_BEAM = """
name = "arm"
[model]
kind = "planar"
gravity = {gravity}
[integrator]
name = "newmark"
step = 1e-3
[base]
{base}
[beam]
length = 0.8
bending_stiffness = {bending}
mass_per_length = 0.5
links = {links}
springs = "{springs}"
damping_time = {damping}
{tip}
{inputs}
[[output]]
name = "tip"
at = "tip"
of = "position"
[[output]]
name = "base_torque"
at = "base"
of = "torque"
[[output]]
name = "base_force"
at = "base"
of = "force"
"""

FORCE = '[[input]]\nname = "push"\nat = "tip"\nacts = "force_y"'


@pytest.fixture
def scene_named() -> Callable[[str], Scene]:
    """Load one of the scenes of the repository."""
    return lambda name: load_scene(SCENES / f"{name}.toml")


@pytest.fixture
def beam_scene() -> Callable[..., Scene]:
    """Make a planar arm from a beam."""

    def make(
        links: int = 8,
        base: str = 'kind = "clamp"',
        tip: str = "",
        inputs: str = FORCE,
        gravity: float = 0.0,
        bending: float = 3.2,
        damping: float = 0.0,
        springs: str = "half-clamp",
    ) -> Scene:
        keys = locals()
        return parse_scene(_BEAM.format(**{key: value for key, value in keys.items() if key != "make"}))

    return make
