"""Energies as outputs of a scene: against Lagrange's equations, and the heat to the order of the integrator."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import sympy as sp

from tmm_gen.derive.integrators.declaration import STEP
from tmm_gen.derive.station import reading as energy
from tmm_gen.program.build import build_program
from tmm_gen.reference.planar_reference import planar_response
from tmm_gen.scene import Scene
from tmm_gen.simulate.metrics import convergence_slope


def test_heat_of_a_step_is_exact_for_cubics_and_not_beyond() -> None:
    t = sp.Symbol("t")
    rule = energy.energy_of_step()
    for degree in range(5):
        power = (t + 1) ** degree
        values = {
            energy.POWER_BEFORE: power.subs(t, 0),
            energy.POWER_AFTER: power.subs(t, STEP),
            energy.SLOPE_BEFORE: sp.diff(power, t).subs(t, 0),
            energy.SLOPE_AFTER: sp.diff(power, t).subs(t, STEP),
        }
        exact = sp.integrate(power, (t, 0, STEP))
        assert (sp.expand(rule.subs(values) - exact) == 0) == (degree < 4)


@pytest.fixture(scope="module")
def heat(unlike: Callable[..., Scene], swinging: Any) -> float:
    """What is dissipated until 0.4 s: whatever the integrator, it is the same."""
    scene = unlike("motor")
    return float(planar_response(scene, swinging(scene), np.array([0.4]))["dissipated"][0])


@pytest.mark.compiler
@pytest.mark.parametrize(("name", "order"), [("newmark", 2), ("zhou", 3), ("sdirk4", 4)])
def test_heat_converges_as_the_motion_does(
    name: str, order: int, heat: float, unlike: Callable[..., Scene], compiled: Any, swinging: Any
) -> None:
    scene = unlike("motor", integrator=name)
    signals = swinging(scene)
    # each in steps at which its order brings it to the same bound
    steps = (16e-4, 8e-4, 4e-4, 2e-4) if order == 2 else (8e-3, 4e-3, 2e-3, 1e-3)
    errors = []
    for h in steps:
        _, found = compiled(scene).simulate(0.4, {k: v.at for k, v in signals.items()}, step=h)
        errors.append(abs(found["dissipated"][-1] / heat - 1.0))
    assert convergence_slope(steps, errors).order > order - 0.3
    assert errors[-1] < 1e-4


def test_no_scene_pays_for_energies_it_does_not_ask_for(unlike: Callable[..., Scene]) -> None:
    scene = unlike("motor")
    asked = build_program(scene)
    plain = build_program(scene.replace(output=[{"name": "tip", "at": "tip", "of": "position"}]))
    undamped = build_program(unlike("clamp", damped=False))
    assert "dissipated" in {v.name for v in asked.state}
    assert "dissipated" not in {v.name for v in (*plain.state, *undamped.state)}
    assert len(list(plain.main.assignments())) < len(list(asked.main.assignments()))
