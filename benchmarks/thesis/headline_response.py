"""The headline of Gholampour (2018): the proposed method settles in 3 s, the others in more than 10 s.

What the printed coefficients do to the two-station sample at any step, and what that is: one slip in eq. 3-80 makes the
arm as many times lighter as :func:`lightness` says.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from tmm_gen.derive.integrators.declaration import STEP, Scheme, stage
from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.derive.integrators.relations import DiscreteCoefficients, discrete_coefficients
from tmm_gen.inputs.signals import Constant
from tmm_gen.reference.reference import exact_response
from tmm_gen.resources import scenes_dir
from tmm_gen.scene import load_scene
from tmm_gen.thesis.errata import printed_table
from tmm_gen.thesis.response import DURATION, Response, exact_tip, settling_time, simulate

Array = NDArray[np.float64]

THESIS_STEP = 0.1
"""s; at which the thesis's curves are reproduced."""

STEPS = (0.01, 0.02, 0.04, 0.05, 0.08, 0.1, 0.125, 0.16, 0.2, 0.25, 0.4, 0.5)
"""Divisors of the 20 s that are looked at."""

OTHERS = ("fox_euler", "newmark", "wilson", "houbolt")
"""The thesis's other integrators."""

_FINE = 0.01
"""Instants at which exact responses are looked at to find when they settle, s."""


@dataclass(frozen=True, eq=False)
class HeadlineRow:
    """What one step does to the sample.

    Parameters
    ----------
    step : float
        s.
    printed, derived : Response
        The proposed method with table 3-8 as printed, and as derived.
    others : dict from str to Response
        The other integrators, as derived.
    lightness : float
        How many times lighter the printed coefficients make the arm.
    lighter_settling_time : float
        When the exact response of an arm that is lighter settles, s.
    """

    step: float
    printed: Response
    derived: Response
    others: dict[str, Response]
    lightness: float
    lighter_settling_time: float


def headline_rows(
    steps: tuple[float, ...] = STEPS, advance: Callable[[], None] = lambda: None
) -> list[HeadlineRow]:
    """Run the sample with every integrator of the thesis at some steps.

    Parameters
    ----------
    steps : tuple of float
        s, divisors of 20 s.
    advance : callable, optional
        Called after each.
    """
    found = []
    for h in steps:
        found.append(_row(h))
        advance()
    return found


def _row(step: float) -> HeadlineRow:
    light = lightness(step)
    return HeadlineRow(
        step=step,
        printed=as_printed(step),
        derived=simulate(integrator("zhou"), step),
        others={name: simulate(integrator(name), step) for name in OTHERS},
        lightness=light,
        lighter_settling_time=settling_time(lighter_tip(light, _FINE), _FINE),
    )


def as_printed(step: float, names: tuple[str, ...] = ("A", "B", "D", "E")) -> Response:
    """Run the proposed method with coefficients of table 3-8 as printed, the others as derived."""
    printed = printed_table("3-8").coefficients
    method = integrator("zhou")
    return simulate(method, step, {len(method.schemes) - 1: {name: printed[name] for name in names}})


@cache
def slipped() -> Scheme:
    """Return the proposed method's step with the step left out before the newest acceleration of eq. 3-80."""
    main = integrator("zhou").main
    (only,) = main.stages
    acceleration = stage("a", 1)
    relations = []
    for relation in only.relations:
        weight = sp.expand(relation).coeff(acceleration)
        slips = relation.has(stage("v", 1))
        relations.append(sp.expand(relation - weight * acceleration * (1 - 1 / STEP) * int(slips)))
    return Scheme((replace(only, relations=(relations[0], relations[1])),), main.update)


def slipped_coefficients() -> DiscreteCoefficients:
    """Return A, B, D, E that follow from the slip."""
    return discrete_coefficients(slipped())


def lightness(step: float) -> float:
    """Return how many times too much velocity a steady acceleration adds: so many times lighter the arm becomes.

    Velocity changes by the weights of the accelerations in eq. 3-80, whose sum is to be the step.
    """
    (only,) = slipped().stages
    (velocity,) = [relation for relation in only.relations if relation.has(stage("v", 1))]
    weights = [velocity.coeff(symbol) for symbol in velocity.free_symbols if symbol.name.startswith("a_")]
    scale = -velocity.coeff(stage("v", 1))
    return float((sum(weights) / scale / STEP).subs(STEP, sp.nsimplify(step)))


def lighter_tip(light: float, step: float) -> Array:
    """Return the exact tip angle of the sample with inertias divided by a number, at every step of 20 s."""
    scene = load_scene(scenes_dir() / "thesis2.toml")
    inertia = scene.links[0].inertia / light
    lighter = replace(
        scene, links=tuple(link.model_copy(update={"inertia": inertia}) for link in scene.links)
    )
    times: Array = np.linspace(0.0, DURATION, round(DURATION / step) + 1)
    tip: Array = exact_response(lighter, {"tip_torque": Constant(1.0)}, times)["tip"]
    return tip


def exact_settling_time() -> float:
    """Return when the exact response of the sample settles, s."""
    return settling_time(exact_tip(_FINE), _FINE)
