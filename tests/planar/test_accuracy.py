"""The falling arm against Lagrange's equations: errors of the tip, and the order of every integrator."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from tmm_gen.derive.integrators.order import order
from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.native import NativeKernel
from tmm_gen.reference.planar_reference import planar_response
from tmm_gen.scene import METHODS, Scene
from tmm_gen.simulate.metrics import convergence_slope

pytestmark = pytest.mark.compiler

CHECKPOINTS = np.linspace(0.0, 1.0, 101)
_known: dict[int, dict[str, np.ndarray]] = {}


def tip_errors(
    scene: Scene, compiled: Callable[[Scene], NativeKernel], step: float | None = None
) -> np.ndarray:
    """Return the distance of the tip from where it should be, at the checkpoints."""
    h = step or scene.integrator.step
    if scene.stations not in _known:
        _known[scene.stations] = planar_response(scene, {}, CHECKPOINTS)
    exact = _known[scene.stations]
    _, found = compiled(scene).simulate(1.0, step=h)
    stride = round(0.01 / h)
    if stride == 0:
        raise ValueError("checkpoints are closer than steps")
    return np.hypot(*(found[name][::stride] - exact[name] for name in ("tip_x", "tip_y")))


@pytest.mark.parametrize("links", [2, 5, 20])
def test_newmark_misses_the_tip_by_less_than_20_micrometres(
    links: int, falling: Callable[..., Scene], compiled: Any
) -> None:
    assert np.max(tip_errors(falling(links), compiled)) < 2e-5


@pytest.mark.parametrize("links", [5, 20])
def test_sdirk4_misses_the_tip_by_less_than_2_micrometres_in_ten_times_longer_steps(
    links: int, falling: Callable[..., Scene], compiled: Any
) -> None:
    scene = falling(links, **{"integrator.name": "sdirk4", "integrator.step": 0.01})
    errors = tip_errors(scene, compiled)
    assert errors[-1] < 2e-6
    assert np.max(errors) < 2e-6


STEPS = {"zhou": (1e-3, 5e-4, 2.5e-4, 1.25e-4), "sdirk4": (5e-3, 2.5e-3, 1.25e-3, 6.25e-4)}
OTHERS = (1e-3, 5e-4, 2.5e-4, 1.25e-4)


ONE_AFTER_ANOTHER = [m.name for m in METHODS if m.name not in ("fox_euler", "zhai") and not m.coupled]
"""Those whose stages are solved at once iterate: test_collocation.py."""


@pytest.fixture(scope="module")
def right(unlike: Callable[..., Scene], swinging: Any) -> dict[str, np.ndarray]:
    """Outputs of three unlike links at the hundredths of 0.3 s: whatever the integrator, they are the same."""
    scene = unlike("motor")
    return planar_response(scene, swinging(scene), np.linspace(0.01, 0.3, 30), 1e-13)


@pytest.mark.parametrize("name", ONE_AFTER_ANOTHER)
def test_errors_shrink_with_the_derived_order(
    name: str, right: dict[str, np.ndarray], unlike: Callable[..., Scene], compiled: Any, swinging: Any
) -> None:
    """Three unlike links under every kind of load, one sweep per stage; the largest error of any angle counts."""
    scene = unlike("motor", integrator=name)
    signals = swinging(scene)
    errors = []
    for h in STEPS.get(name, OTHERS):
        _, found = compiled(scene).simulate(0.3, {k: v.at for k, v in signals.items()}, step=h)
        stride = round(0.01 / h)
        measured = ("position_of_tip_x", "position_of_tip_y", "angle_of_1", "angle_of_base")
        errors.append(max(np.max(np.abs(found[k][stride::stride] - right[k])) for k in measured))
    fitted = convergence_slope(STEPS.get(name, OTHERS), errors).order
    assert fitted == pytest.approx(order(integrator(name)), abs=0.15)


@pytest.mark.parametrize(
    ("name", "least"), [("newmark", 1.9), ("bathe", 1.9), ("zhou", 2.9), ("sdirk4", 3.5)]
)
def test_one_sweep_per_step_keeps_the_order_where_joints_are_stiff_and_damped(
    name: str, least: float, falling: Callable[..., Scene], compiled: Any
) -> None:
    scene = falling(5, **{"integrator.name": name})
    steps = (1e-2, 5e-3, 2.5e-3, 1.25e-3) if name == "sdirk4" else (1e-3, 5e-4, 2.5e-4, 1.25e-4)
    fitted = convergence_slope(steps, [np.max(tip_errors(scene, compiled, h)) for h in steps])
    assert fitted.order > least
