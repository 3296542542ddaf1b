"""The order of convergence that the kernel of a chain shows."""

from __future__ import annotations

import inspect
from types import ModuleType

import numpy as np
from numpy.typing import NDArray

from tmm_gen.inputs.signals import Constant
from tmm_gen.reference.frequency import fastest_mode
from tmm_gen.reference.reference import exact_response
from tmm_gen.scene import Scene
from tmm_gen.simulate.metrics import largest_error
from tmm_gen.verify.asymptotic import asymptotic_order
from tmm_gen.verify.check_row import SLOPE, CheckRow

Array = NDArray[np.float64]

_STEPS = (64, 128, 256, 512)
_ROUNDED = 1e-12
"""Errors below this share of the peak are of rounding: coarser steps are fitted."""
_TURN = 0.2
"""Highest natural frequency, or decay rate, times the coarsest step of the slope."""


def chain_slope(scene: Scene, module: ModuleType, facts: dict[str, object]) -> CheckRow:
    """Fit the order of convergence of the tip angle under unit inputs, the links moving from the start.

    Parameters
    ----------
    scene : Scene
        Of kind "chain".
    module : module
        Its generated NumPy package.
    facts : dict
        Receives ``fitted_order`` and ``derived_order``.
    """
    from tmm_gen.derive.integrators.order import order
    from tmm_gen.derive.integrators.registry import integrator

    derived = order(integrator(scene.integrator.name, **scene.integrator.parameters))
    mode = fastest_mode(scene)
    coarsest = _TURN / (mode.frequency * max(1.0, 2.0 * mode.damping_ratio))
    tip = [{"name": "tip_angle", "at": "tip", "of": "angle"}]
    moving = scene.replace(**{"output": tip, "initial": {"angles": 0.0, "rates": 1.0}})
    times: Array = coarsest * np.arange(1, _STEPS[0] + 1, dtype=float)
    held = {item.name: Constant(1.0) for item in scene.inputs}
    exact = exact_response(moving, held, times)["tip_angle"]

    def error(steps: int) -> float:
        found = _moving_tip(module, scene, coarsest * _STEPS[0] / steps, steps)
        stride, skip = max(steps // _STEPS[0], 1), max(_STEPS[0] // steps, 1)
        return largest_error(
            found[stride - 1 :: stride], exact[skip - 1 :: skip], float(np.max(np.abs(exact)))
        )

    found = asymptotic_order(error, _STEPS, lambda slope: abs(slope - derived) <= SLOPE, _ROUNDED)
    facts |= {"fitted_order": found.order, "derived_order": derived}
    return CheckRow(
        "order_against_derived",
        abs(found.order - derived),
        SLOPE,
        f"error goes with step^{found.order:.3f}, fitted on {len(found.counts)} steps from "
        f"{coarsest * _STEPS[0] / found.counts[0]:.2g} s down; "
        f"derived: step^{derived}",
    )


def _moving_tip(module: ModuleType, scene: Scene, step: float, steps: int) -> Array:
    """Return the tip angle after each step under unit inputs, all links turning at 1 rad/s at first."""
    given = module.Input(**{item.name: 1.0 for item in scene.inputs})
    start = {"initial_angle": 0.0, "initial_rate": 1.0}
    if "step" in inspect.signature(module.initialise).parameters:
        start["step"] = step
    model, state = module.prepare(step=step), module.initialise(module.Params(), given, **start)
    tip = np.empty(steps)
    for index in range(steps):
        state = module.step(model, state, given)
        tip[index] = state.angle[-1] + getattr(state, "turned", 0.0)
    return tip
