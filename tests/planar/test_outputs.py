"""Every output of a planar arm against Lagrange's equations, forces as balances of momentum."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from tmm_gen.reference.planar_reference import planar_response
from tmm_gen.scene import Scene

pytestmark = pytest.mark.compiler


@pytest.mark.parametrize("links", [1, 3])
@pytest.mark.parametrize("base", ["clamp", "motor", "prescribed"])
def test_outputs_follow_the_reference(
    base: str, links: int, unlike: Callable[..., Scene], compiled: Any, swinging: Any
) -> None:
    scene = unlike(base, links, step=1e-4)
    signals = swinging(scene)
    times, found = compiled(scene).simulate(0.2, {k: v.at for k, v in signals.items()})
    later = slice(100, None, 100)
    exact = planar_response(scene, signals, times[later])
    assert set(found) == set(exact)
    for name, values in exact.items():
        error = np.max(np.abs(found[name][later] - values))
        assert error < 5e-5 * np.max(np.abs(values)), name


def test_at_the_start_everything_is_consistent(
    unlike: Callable[..., Scene], compiled: Any, swinging: Any
) -> None:
    scene = unlike("motor")
    signals = swinging(scene)
    _, found = compiled(scene).simulate(0.0, {k: v.at for k, v in signals.items()})
    exact = planar_response(scene, signals, np.array([0.0]))
    for name, values in exact.items():
        assert found[name][0] == pytest.approx(values[0], rel=1e-9, abs=1e-9), name


def test_a_fallen_arm_hangs_by_its_weight(unlike: Callable[..., Scene], compiled: Any) -> None:
    """Straight down at rest: the base carries the whole weight and no torque, whatever the arm is made of."""
    scene = unlike("motor", loads=False).replace(initial={"angles": -np.pi / 2, "rates": 0.0})
    kernel = compiled(scene)
    kernel.prepare()
    kernel.initialise()
    kernel.state = {
        **kernel.state,
        "hub_angle": -np.pi / 2,
        "acceleration": np.zeros(3),
        "hub_acceleration": 0.0,
    }
    for _ in range(10):
        kernel.step()
    weight = 9.81 * (sum(link.mass for link in scene.links) + scene.tip.mass)
    found = kernel.output()
    assert found["force_of_base_y"] == pytest.approx(weight, rel=1e-12)
    assert found["force_of_base_x"] == pytest.approx(0.0, abs=1e-9)
    assert found["torque_of_base"] == pytest.approx(0.0, abs=1e-9)
