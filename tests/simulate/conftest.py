"""Scenes the tests of this folder measure."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from tmm_gen.scene import Scene, load_scene, parse_scene

ROOT = Path(__file__).resolve().parents[2]

CHAIN = """\
name = "measured"

[model]
kind = "chain"

[integrator]
name = "newmark"
step = 0.01

[base]
{base}

[[joint]]
stiffness = 20.0
damping = 0.5

[[link]]
inertia = 1.0

[[joint]]
stiffness = 35.0

[[link]]
inertia = 2.0

[[joint]]
stiffness = 10.0
damping = 1.5

[[link]]
inertia = 0.3

{inputs}
[[input]]
name = "inner"
at = 2
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
name = "speed"
at = 1
of = "velocity"

[[output]]
name = "jolt"
at = 2
of = "acceleration"

[[output]]
name = "joint3"
at = 3
of = "torque"

[[output]]
name = "base_torque"
at = "base"
of = "torque"

[initial]
angles = [0.1, -0.2, 0.05]
rates = [0.0, 0.4, -0.3]
"""

BASES = {
    "clamp": ('kind = "clamp"', ""),
    "motor": (
        'kind = "motor"\ninertia = 0.7\ndamping = 0.2',
        '[[input]]\nname = "hub"\nat = "base"\nacts = "torque"\n',
    ),
    "prescribed": ('kind = "prescribed"', '[[input]]\nname = "hub"\nat = "base"\nacts = "angle"\n'),
}


@pytest.fixture(scope="session")
def chain() -> Callable[[str], Scene]:
    """Make a chain of three unlike stations on a base of some kind, moving at the start."""

    def make(base: str) -> Scene:
        kind, inputs = BASES[base]
        return parse_scene(CHAIN.format(base=kind, inputs=inputs))

    return make


@pytest.fixture(scope="session")
def example() -> Callable[[str], Scene]:
    """Load a scene of the folder of examples."""
    return lambda name: load_scene(ROOT / "scenes" / f"{name}.toml")
