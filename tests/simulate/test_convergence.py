"""Generated kernels converge to the exact response with the order derived for their integrator.

Every integrator of the registry is met, also one added after this test was written.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest

from tmm_gen.derive.integrators.order import order
from tmm_gen.derive.integrators.registry import integrator, names
from tmm_gen.inputs.signals import Constant, Signal, Sine
from tmm_gen.native.python_module import numpy_module
from tmm_gen.reference.reference import exact_response
from tmm_gen.scene import Scene
from tmm_gen.simulate.metrics import convergence_slope, largest_error, rms_error
from tmm_gen.simulate.run import simulate

DURATION = 2.0
STEPS = {
    1: (100, 200, 400, 800, 1600),
    2: (50, 100, 200, 400, 800),
    3: (50, 100, 200, 400),
    4: (20, 40, 80, 160),
    5: (10, 20, 40, 80),
    6: (20, 40, 80, 160),
}
LOADS: dict[str, Signal] = {"constant": Constant(1.5), "smooth": Sine(1.5, 5.0, 0.4)}

BOUNDS = [
    ("fox_euler", {}, 4e-3),
    ("newmark", {"beta": 0.25}, 1.6e-5),
    ("newmark", {"beta": 1 / 6}, 7.5e-6),
    ("wilson", {"theta": 1.4}, 3.5e-5),
    ("houbolt", {}, 8e-5),
    ("zhou", {}, 5e-8),
]


@pytest.mark.parametrize(("name", "parameters", "bound"), BOUNDS)
def test_thesis_sample_within_its_bound(
    name: str, parameters: dict[str, float], bound: float, example: Callable[[str], Scene]
) -> None:
    changes = {f"integrator.{key}": value for key, value in parameters.items()}
    scene = example("thesis2").replace(**{"integrator.name": name, "integrator.step": 0.01, **changes})
    load = {"tip_torque": Constant(1.0)}
    found = simulate(scene, load, 20.0)
    assert found.steps == 2000
    exact = exact_response(scene, load, found.time)["tip"]
    assert rms_error(found.outputs["tip"], exact, 0.1) <= bound


@cache
def exact_tip(chain: Callable[[str], Scene], load: str, steps: int) -> tuple[float, np.ndarray]:
    times = DURATION / steps * np.arange(steps + 1)
    tip = exact_response(chain("clamp"), {"outer": LOADS[load], "inner": LOADS[load]}, times)["tip"]
    return float(np.abs(tip).max()), tip


@pytest.mark.parametrize("load", LOADS)
@pytest.mark.parametrize("name", names())
def test_slope_is_the_derived_order(name: str, load: str, chain: Callable[[str], Scene]) -> None:
    derived = order(integrator(name))
    module = numpy_module(chain("clamp").replace(**{"integrator.name": name}))
    signal = LOADS[load]
    errors = []
    for steps in STEPS[derived]:
        found = module.simulate(DURATION, {"outer": signal.at, "inner": signal.at}, step=DURATION / steps)
        scale, tip = exact_tip(chain, load, steps)
        assert len(tip) == len(found.times)
        errors.append(largest_error(found.outputs["tip"], tip, scale))
    slope = convergence_slope([1.0 / steps for steps in STEPS[derived]], errors)
    assert slope.order == pytest.approx(derived, abs=0.1), f"errors {errors}"
