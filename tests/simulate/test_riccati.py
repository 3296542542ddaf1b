"""The Riccati sweep is right to the integrator's own error in long chains, however soft or stiff they are.

Newmark's method run mode by mode, where nothing is swept, says what that error is; the modes' closed form
says what the exact response is.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from support.modal_part import modal_response, modes

from tmm_gen.native import compile_kernel
from tmm_gen.native.python_module import numpy_module
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene

STIFFNESS = (2e-4, 2e-2, 2e0, 2e2, 2e4, 2e6, 2e8)
DAMPING_TIME = 0.01


@pytest.fixture(scope="session")
def uniform(example: Callable[[str], Scene]) -> Callable[..., Scene]:
    """Make a chain of identical stations of unit inertia that reports its tip angle."""

    def make(stations: int, stiffness: float, damping_time: float, step: float, **changes: object) -> Scene:
        return example("thesis10").replace(
            **{
                "joint": [{"stiffness": stiffness, "damping": damping_time * stiffness, "repeat": stations}],
                "link.1.repeat": stations,
                "output": [{"name": "tip", "at": "tip", "of": "angle"}],
                "integrator.step": step,
                **changes,
            }
        )

    return make


def newmark_by_modes(scene: Scene, damping_time: float, steps: int) -> np.ndarray:
    """Return the tip angle under a unit torque by Newmark 1/4 on each mode."""
    squares, shapes = modes(scene)
    h, load = scene.integrator.step, shapes[-1]
    q, v, a = np.zeros_like(load), np.zeros_like(load), load
    tip = [0.0]
    for _ in range(steps):
        q, v = q + h * v + h**2 / 4 * a, v + h / 2 * a
        a = (load - damping_time * squares * v - squares * q) / (
            1 + damping_time * squares * h / 2 + squares * h**2 / 4
        )
        q, v = q + h**2 / 4 * a, v + h / 2 * a
        tip.append(shapes[-1] @ q)
    return np.array(tip)


@pytest.mark.compiler
@pytest.mark.parametrize(
    ("stations", "stiffness", "damping_time"),
    [(50, stiffness, damping) for stiffness in STIFFNESS for damping in (0.0, DAMPING_TIME)]
    + [(1000, stiffness, 0.0) for stiffness in STIFFNESS[::2]]
    + [(1000, stiffness, DAMPING_TIME) for stiffness in STIFFNESS[1::2]],
)
def test_right_to_the_integrators_own_error(
    stations: int, stiffness: float, damping_time: float, uniform: Callable[..., Scene]
) -> None:
    step, steps = {50: (1e-3, 2000), 1000: (1e-2, 500)}[stations]
    scene = uniform(stations, stiffness, damping_time, step)
    times, outputs = compile_kernel(build_program(scene), scene).simulate(step * steps, {"tip_torque": 1.0})
    exact = modal_response(scene, {"tip_torque": 1.0}, times)["tip"]
    own = newmark_by_modes(scene, damping_time, steps)
    scale = np.abs(exact).max()
    own_error = np.abs(own - exact).max() / scale
    of_the_sweep = np.abs(outputs["tip"] - own).max() / scale
    assert of_the_sweep <= 1e-3 * own_error
    assert of_the_sweep <= 1e-7
    assert np.abs(outputs["tip"] - exact).max() / scale == pytest.approx(own_error, rel=1e-3)


@pytest.mark.parametrize(
    ("name", "unknown"),
    [
        ("houbolt", "acceleration"),
        ("generalized_alpha", "acceleration"),
        ("sdirk4", "acceleration"),
        ("bathe", "increment"),
    ],
)
def test_rounding_stays_small_in_other_integrators(
    name: str, unknown: str, uniform: Callable[..., Scene]
) -> None:
    scene = uniform(50, 1.0, 1.0, 1e-3, **{"integrator.name": name, "model.unknown": unknown})
    module = numpy_module(scene)
    # All stiffnesses side by side, in double and in extended precision.
    tips = []
    for kind in (np.float64, np.longdouble):
        stiffness = np.array(STIFFNESS, dtype=kind)
        params = module.Params(stiffness=stiffness, damping=kind(DAMPING_TIME) * stiffness)
        found = module.simulate(0.2, {"tip_torque": kind(1.0)}, params)
        tips.append(found.outputs["tip"])
    double, extended = tips
    assert extended.shape == (201, len(STIFFNESS))
    assert np.finfo(np.longdouble).eps < 1e-18
    assert extended.dtype == np.longdouble
    error = np.abs(double - extended).max(axis=0) / np.abs(extended).max(axis=0)
    assert np.all(error < 1e-9)
