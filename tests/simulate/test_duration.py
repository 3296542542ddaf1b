"""The slowest swing is told from turning as a whole by the base, not by the size of a number."""

from __future__ import annotations

from dataclasses import replace

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tmm_gen.reference.duration import slowest_swing
from tmm_gen.reference.planar_linear import vibration
from tmm_gen.scene import Initial, Scene, parse_scene

SCENE = """
name = "a"
[model]
kind = "{kind}"
[integrator]
name = "newmark"
step = 1e-3
[base]
{base}
[[joint]]
stiffness = 1.0
[[link]]
inertia = 0.02
{link}
[[output]]
name = "o"
at = "tip"
of = "angle"
"""


def arm(kind: str, hub: bool, springs: list[float]) -> Scene:
    base = 'kind = "motor"\ninertia = 0.05' if hub else 'kind = "clamp"'
    link = "length = 0.4\nmass = 0.3" if kind == "planar" else ""
    scene = parse_scene(SCENE.format(kind=kind, base=base, link=link))
    joints = tuple(scene.joints[0].model_copy(update={"stiffness": k}) for k in springs)
    still = (0.0,) * len(springs)
    return replace(scene, joints=joints, links=scene.links * len(springs), initial=Initial(still, still))


decades = st.floats(-7, 7).map(lambda power: 10.0**power)


@given(st.booleans(), st.lists(decades, min_size=1, max_size=6))
@settings(max_examples=15, deadline=None)
def test_of_a_chain(hub: bool, springs: list[float]) -> None:
    inertia = [0.05] * hub + [0.02] * len(springs)
    with mpmath.workdps(60):
        matrix = mpmath.zeros(len(inertia))
        for k, spring in enumerate(springs):
            bend = mpmath.zeros(1, len(inertia))
            bend[k + hub] = 1 / mpmath.sqrt(mpmath.mpf(inertia[k + hub]))
            if k + hub:
                bend[k + hub - 1] = -1 / mpmath.sqrt(mpmath.mpf(inertia[k + hub - 1]))
            matrix += bend.T * bend * mpmath.mpf(spring)
        squares = sorted(mpmath.eigsy(matrix, eigvals_only=True))
        exact = float(mpmath.sqrt(squares[int(hub)]))
    assert slowest_swing(arm("chain", hub, springs)) == pytest.approx(exact, rel=1e-12)


@pytest.mark.parametrize("hub", [False, True])
@pytest.mark.parametrize("ratio", [1.0, 1e-7, 1e-14])
def test_of_a_planar_arm_with_a_soft_joint(hub: bool, ratio: float) -> None:
    """The first swing of a planar arm scales with its springs, and a soft joint's is a rod about a hinge."""
    frequencies = vibration(arm("planar", hub, [1e3 * ratio, 1e3, 1e3])).frequencies
    assert np.sum(frequencies == 0.0) == hub
    if ratio < 1.0:
        # parallel axes: each link about its middle, at 0.2, 0.6 and 1.0 m
        rod = 3 * 0.02 + 0.3 * (0.2**2 + 0.6**2 + 1.0**2)
        against = rod if not hub else 1.0 / (1.0 / rod + 1.0 / 0.05)
        assert frequencies[int(hub)] == pytest.approx(np.sqrt(1e3 * ratio / against), rel=10 * ratio + 1e-9)


@pytest.mark.parametrize("links", [1, 30, 1000])
def test_of_a_long_uniform_chain(links: int) -> None:
    exact = 2 * np.sqrt(7.0 / 0.02) * np.sin(np.pi / (4 * links + 2))
    assert slowest_swing(arm("chain", False, [7.0] * links)) == pytest.approx(exact, rel=1e-12)
