"""What the three linearisations of a planar arm do: measured facts, not opinions.

A 1 m arm, first clamped frequency 1 Hz, is released horizontally in half gravity with damping time 0.002 s.
"""

from __future__ import annotations

import numpy as np
import pytest

from tmm_gen.errors import UserError
from tmm_gen.native import compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.program.evaluate import VanishingPivotError
from tmm_gen.scene import Scene, parse_scene

FIRST_ROOT = 1.875104068711961
BENDING_STIFFNESS = 0.5 * (2 * np.pi / FIRST_ROOT**2) ** 2


def falling_arm(links: int, linearisation: str, step: float) -> Scene:
    return parse_scene(f"""
        name = "falling"
        [model]
        kind = "planar"
        gravity = 4.903325
        linearisation = "{linearisation}"
        [integrator]
        name = "newmark"
        step = {step}
        [base]
        kind = "clamp"
        [beam]
        length = 1.0
        bending_stiffness = {BENDING_STIFFNESS}
        mass_per_length = 0.5
        links = {links}
        damping_time = 0.002
        [[output]]
        name = "tip"
        at = "tip"
        of = "position"
    """)


def tip_after_one_second(scene: Scene) -> np.ndarray:
    """Where the tip is, or not-a-number if the kernel gives up on the way."""
    kernel = compile_kernel(build_program(scene), scene)
    kernel.prepare()
    kernel.initialise()
    try:
        for _ in range(round(1 / scene.integrator.step)):
            kernel.step()
    except (VanishingPivotError, FloatingPointError, ArithmeticError):
        return np.full(2, np.nan)
    out = kernel.output()
    return np.array([out["tip_x"], out["tip_y"]])


@pytest.fixture(scope="module")
def fine() -> dict[int, np.ndarray]:
    """The same arms by Newton's linearisation at a fine step (itself held against Lagrange elsewhere)."""
    return {n: tip_after_one_second(falling_arm(n, "newton", 1e-4)) for n in (1, 2, 5)}


def strayed(tip: np.ndarray, fine: np.ndarray) -> bool:
    """Whether an arm gave up, or ended nowhere near where it should be."""
    return bool(np.isnan(tip).any() or np.linalg.norm(tip - fine) > 0.05)


@pytest.mark.parametrize("step", [0.02, 0.01, 0.005, 0.0025, 0.001])
@pytest.mark.parametrize("links", [2, 5])
def test_frozen_diverges_at_every_step(links: int, step: float, fine: dict[int, np.ndarray]) -> None:
    """Sines frozen at the prediction make the inertia of the links outboard explicit."""
    assert strayed(tip_after_one_second(falling_arm(links, "frozen", step)), fine[links])


def test_frozen_works_for_one_link(fine: dict[int, np.ndarray]) -> None:
    """With no link outboard there is nothing to be explicit about."""
    assert np.linalg.norm(tip_after_one_second(falling_arm(1, "frozen", 1e-3)) - fine[1]) < 1e-5


def test_taylor_works_at_large_steps_and_fails_at_small_ones(fine: dict[int, np.ndarray]) -> None:
    errors = {
        h: tip_after_one_second(falling_arm(5, "taylor", h)) - fine[5] for h in (0.02, 0.01, 0.005, 0.001)
    }
    assert np.linalg.norm(errors[0.02]) < 2e-3
    assert np.linalg.norm(errors[0.01]) < 5e-4
    assert np.linalg.norm(errors[0.005]) < 1.5e-4
    assert strayed(errors[0.001] + fine[5], fine[5])


def test_newton_works_at_all_of_them(fine: dict[int, np.ndarray]) -> None:
    for step, bound in ((0.02, 2e-3), (0.01, 5e-4), (0.005, 1.5e-4), (0.001, 5e-6)):
        assert np.linalg.norm(tip_after_one_second(falling_arm(5, "newton", step)) - fine[5]) < bound


@pytest.mark.parametrize("integrator", ["sdirk4", "zhai"])
def test_the_thesis_step_refuses_integrators_it_has_no_form_for(integrator: str) -> None:
    scene = falling_arm(2, "taylor", 0.01).replace(**{"integrator.name": integrator})
    with pytest.raises(UserError, match="use linearisation = 'newton'"):
        build_program(scene)
