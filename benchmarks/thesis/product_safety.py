"""What the plain product of transfer matrices loses, predicted and measured."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import islice
from typing import Any

import numpy as np

from tmm_gen.native.python_module import numpy_module
from tmm_gen.scene import Scene

EPSILON = float(np.finfo(float).eps)


@dataclass(frozen=True)
class ProductLoss:
    """The plain product beside the Riccati sweep, in double precision.

    Parameters
    ----------
    stations : int
        Of the scene.
    safe_stations : int
        Up to which the product keeps its digits at the scene's step.
    growth : float
        What a torque of 1 at the held base grows to at the tip.
    predicted : float
        Relative loss expected: rounding times growth.
    measured : float
        Largest difference between both sweeps in any output, relative to its largest value; infinite where
        the product leaves the range of numbers.
    """

    stations: int
    safe_stations: int
    growth: float
    predicted: float
    measured: float


def safe_stations(scene: Scene) -> int:
    """Return the number of stations up to which the plain product keeps six digits at the scene's step.

    In single precision (``emit.real = "float32"``) three digits are asked for.
    """
    from tmm_gen.digits.product import safe_stations as derived

    return derived(scene, _integrator(scene))


def product_loss(scene: Scene, inputs: dict[str, float], steps: int) -> ProductLoss:
    """Run both sweeps side by side under constant inputs, refused by no one.

    Parameters
    ----------
    scene : Scene
        Of kind "chain"; its sweep does not matter.
    inputs : dict from str to float
        Constant inputs by name.
    steps : int
        How many steps to compare.
    """
    from tmm_gen.digits.product import torque_growth

    growth = next(islice(torque_growth(scene, _integrator(scene)), scene.stations - 1, None))
    exact, lossy = (_outputs(scene, sweep, inputs, steps) for sweep in ("riccati", "product"))
    with np.errstate(all="ignore"):
        difference = np.max(np.abs(lossy - exact) / np.max(np.abs(exact), axis=0))
    return ProductLoss(
        stations=scene.stations,
        safe_stations=safe_stations(scene),
        growth=growth,
        predicted=EPSILON * growth,
        measured=float(difference) if np.isfinite(difference) else float("inf"),
    )


def _integrator(scene: Scene) -> Any:
    from tmm_gen.derive.integrators.registry import integrator

    return integrator(scene.integrator.name, **scene.integrator.parameters)


def _outputs(scene: Scene, sweep: str, inputs: dict[str, float], steps: int) -> np.ndarray[Any, Any]:
    """Return the outputs at every step, (steps, outputs)."""
    from tmm_gen.program.build import build_unchecked

    chosen = scene.replace(**{"model.sweep": sweep})
    module = numpy_module(chosen, build_unchecked(chosen, _integrator(chosen)))
    given = module.Input(**inputs)
    model, state = module.prepare(), module.initialise(module.Params(), given)
    rows = []
    with np.errstate(all="ignore"):
        for _ in range(steps):
            state = module.step(model, state, given)
            found = module.output(model, state)
            rows.append([float(getattr(found, item.name)) for item in scene.outputs])
    return np.array(rows)
