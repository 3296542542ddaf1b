"""Where a scene stands, as rows and sentences."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from tmm_gen.errors import UserError
from tmm_gen.scene.integrator import INTEGRATOR_NAMES, method_named
from tmm_gen.stability.limits import Standing
from tmm_gen.stability.map import GrowthMap
from tmm_gen.stability.motion import SmallMotion

__all__ = ["mapped_integrators", "notes_of", "standing_row"]


def mapped_integrators(names: Sequence[str]) -> list[str]:
    """Return the integrators whose growth is to be measured, each once.

    Raises
    ------
    UserError
        If there is none of a name.
    """
    for name in names:
        if method_named(name) is None:
            raise UserError(f"--map {name}: no such integrator; there are {', '.join(INTEGRATOR_NAMES)}.")
    return list(dict.fromkeys(name.replace("-", "_") for name in names))


def standing_row(standing: Standing, h: float) -> dict[str, Any]:
    """Return what a table shows of an integrator, at a step of h s."""
    grows = "grows at any step" if standing.largest_step == 0.0 else "grows"
    return {
        "integrator": standing.integrator.name,
        "own": standing.chosen,
        "parameters": {name: float(value) for name, value in standing.integrator.parameters.items()},
        "order": standing.order,
        "unconditionally_stable": math.isinf(standing.limit),
        "limit": standing.limit,
        "limit_damped": standing.limit_damped,
        "growth_per_step": standing.radius_excess,
        "worst_mode": standing.worst + 1,
        "largest_step": standing.largest_step,
        "margin": standing.largest_step / h,
        "stable": standing.stable,
        "exact": standing.exact,
        "verdict": "stable" if standing.stable else grows,
    }


def notes_of(motion: SmallMotion, found: Sequence[Standing], maps: Sequence[GrowthMap]) -> list[str]:
    """Return what is to be said below the table: of what growth it is, and whether kernels grow like that."""
    said = [
        f"* the scene's own; growth: of the worst of {len(motion.modes)} modes, each with its own damping"
    ]
    exact = all(each.exact for each in found)
    if motion.rounds is not None and exact:
        said.append(
            "weight is left to the sweeps' corrections: growth and largest step are those of the kernel's own sweeps"
        )
    if motion.mixed:
        said.append(
            "damping couples the modes: growth and largest step are those of the "
            + ("whole arm" if exact else "modes by themselves, the arm being too large")
        )
    if motion.falling:
        said.append("the arm itself falls over: it grows in truth, whatever the integrator")
    return [*said, *(_finding(each) for each in maps)]


def _finding(each: GrowthMap) -> str:
    name, count = each.scene.integrator.name, each.differs.size
    if not each.differs.any():
        return f"measured: the {name} kernel grows as derived at all {count} steps and stiffnesses of the map"
    step, factor, measured, derived = each.worst
    return (
        f"measured: the {name} kernel DIFFERS from the derived growth at {int(each.differs.sum())} of {count} steps "
        f"and stiffnesses; most at a step of {step:.3g} s and {factor:.3g} times the stiffness: "
        f"{measured:.6g} a step instead of {derived:.6g}"
    )
