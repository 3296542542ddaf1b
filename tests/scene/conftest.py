"""Scenes the tests of this folder start from."""

from __future__ import annotations

import pytest

CHAIN = """\
name = "arm"
title = "An arm"

[model]
kind = "chain"
sweep = "riccati"

[integrator]
name = "newmark"
step = 0.01
beta = 0.25

[base]
kind = "clamp"

[[joint]]
stiffness = 20.0
damping = 0.5

[[link]]
inertia = 1.0

[[joint]]
stiffness = 10.0

[[link]]
inertia = 2.0

[[input]]
name = "tip_torque"
at = "tip"
acts = "torque"

[[output]]
name = "tip"
at = "tip"
of = "angle"
"""

PLANAR = """\
name = "arm"

[model]
kind = "planar"
gravity = 9.81

[integrator]
name = "sdirk4"
step = 1e-3

[base]
kind = "motor"
inertia = 0.05

[beam]
length = 1.0
bending_stiffness = 12.0
mass_per_length = 0.4
links = 5
damping_time = 0.002

[tip]
mass = 0.1

[[input]]
name = "hub_torque"
at = "base"
acts = "torque"

[[output]]
name = "tip"
at = "tip"
of = "position"
"""


@pytest.fixture(scope="session")
def chain() -> str:
    """Text of a chain of two links."""
    return CHAIN


@pytest.fixture(scope="session")
def planar() -> str:
    """Text of a planar arm made from a beam."""
    return PLANAR
