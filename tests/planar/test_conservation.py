"""What an arm must keep: its energy, its momentum, the balance of work."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from tmm_gen.reference.energy import energy
from tmm_gen.reference.planar_arm import Arm
from tmm_gen.scene import Scene
from tmm_gen.simulate.metrics import convergence_slope
from tmm_gen.simulate.run import simulate

pytestmark = pytest.mark.compiler

ORDERS = [("newmark", 2), ("sdirk4", 4)]
STEPS = (4e-3, 2e-3, 1e-3, 5e-4)


def _angular_momentum(scene: Scene, angle: np.ndarray, rate: np.ndarray) -> np.ndarray:
    """Return the angular momentum of hub and arm about the base point, (k,), kg m^2/s."""
    arm = Arm(scene, {})
    s, c = np.sin(angle), np.cos(angle)
    x, y = arm.walked(c), arm.walked(s)
    speed_x, speed_y = -arm.walked(s * rate), arm.walked(c * rate)
    return (x * speed_y - y * speed_x) @ arm.masses + rate @ arm.inertias


@pytest.mark.parametrize(("name", "order"), ORDERS)
def test_momentum_about_a_free_hub_stays(
    name: str, order: int, unlike: Callable[..., Scene], compiled: Any, traced: Any
) -> None:
    scene = unlike("motor", gravity=None, loads=False, damped=False, integrator=name)
    errors = []
    for h in STEPS:
        _, motion = traced(compiled(scene), scene, {}, 0.4, h)
        momentum = _angular_momentum(scene, motion.angle, motion.rate)
        errors.append(np.max(np.abs(momentum / momentum[0] - 1.0)))
    assert convergence_slope(STEPS, errors).order > order - 0.2
    assert errors[-1] < 1e-3


@pytest.mark.parametrize(("name", "order"), ORDERS)
@pytest.mark.parametrize("base", ["clamp", "motor", "prescribed"])
def test_work_done_is_energy_gained_and_dissipated(
    base: str, name: str, order: int, unlike: Callable[..., Scene], compiled: Any, swinging: Any, traced: Any
) -> None:
    scene = unlike(base, integrator=name)
    signals = swinging(scene)
    errors = []
    for h in STEPS:
        time, motion = traced(compiled(scene), scene, signals, 0.4, h)
        found = energy(scene, signals, time, motion.angle, motion.rate)
        errors.append(np.max(np.abs(found.unbalanced)) / np.ptp(found.total))
    assert convergence_slope(STEPS, errors).order > order - 0.2
    assert errors[-1] < 1e-3


@pytest.mark.parametrize(("name", "order"), ORDERS)
def test_energy_without_damping_stays(
    name: str, order: int, unlike: Callable[..., Scene], compiled: Any, traced: Any
) -> None:
    scene = unlike("clamp", loads=False, damped=False, integrator=name)
    errors = []
    for h in STEPS:
        time, motion = traced(compiled(scene), scene, {}, 0.4, h)
        total = energy(scene, {}, time, motion.angle, motion.rate).total
        errors.append(np.max(np.abs(total - total[0])))
    assert convergence_slope(STEPS, errors).order > order - 0.3


def test_both_backends_trace_the_same_motion(unlike: Callable[..., Scene], swinging: Any) -> None:
    scene = unlike("motor")
    one, other = (simulate(scene, swinging(scene), 0.02, backend, trace=True) for backend in ("numpy", "c"))
    assert one.trace.angle.shape == (21, 4)
    assert other.trace.angle == pytest.approx(one.trace.angle, rel=1e-12)
    assert other.trace.rate == pytest.approx(one.trace.rate, rel=1e-12)
