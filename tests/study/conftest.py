"""Small scenes for studies, and a study of each that several tests look at."""

from __future__ import annotations

import pytest

from tmm_gen.scene import Scene, parse_scene
from tmm_gen.study.excitation import Excitation, excitation
from tmm_gen.study.grid import Axes, configurations
from tmm_gen.study.study import Study, run_study

CHAIN = """
name = "pair"
title = "Two stations"
[model]
kind = "chain"
[integrator]
name = "newmark"
step = 0.02  # a step
beta = 0.25  # average acceleration
[base]
kind = "clamp"
[[joint]]
stiffness = 20.0
damping = 0.4
repeat = 2
[[link]]
inertia = 1.0
repeat = 2
[[input]]
name = "torque"
at = "tip"
acts = "torque"
[[output]]
name = "tip"
at = "tip"
of = "angle"
"""

ARM = """
name = "ruler"
[model]
kind = "planar"
gravity = 9.81
[integrator]
name = "newmark"
step = 5e-3
[base]
kind = "clamp"
[beam]
length = 1.0
bending_stiffness = 2.0
mass_per_length = 0.3
links = 3
damping_time = 0.002
[[output]]
name = "tip"
at = "tip"
of = "position"
"""


@pytest.fixture(scope="session")
def chain() -> Scene:
    return parse_scene(CHAIN, "pair.toml")


@pytest.fixture(scope="session")
def arm() -> Scene:
    return parse_scene(ARM, "ruler.toml")


@pytest.fixture(scope="session")
def chain_excitation(chain: Scene) -> Excitation:
    return excitation(chain, until=5.0)


@pytest.fixture(scope="session")
def chain_study(chain: Scene, chain_excitation: Excitation) -> Study:
    axes = Axes(
        integrators=("newmark", "sdirk4", "zhai"),
        steps=(10.0, 0.8, 0.1, 0.05, 0.025, 0.0125),
        reals=("float64", "float32"),
    )
    return run_study(chain, chain_excitation, configurations(chain, axes, 5.0), rounds=3)


@pytest.fixture(scope="session")
def arm_study(arm: Scene) -> Study:
    went = excitation(arm, until=0.5)
    axes = Axes(
        integrators=("newmark", "sdirk4"),
        steps=(0.02, 0.01, 0.005),
        links=(3, 6),
        backends=("c", "numpy"),
    )
    return run_study(arm, went, configurations(arm, axes, went.until), rounds=2)
