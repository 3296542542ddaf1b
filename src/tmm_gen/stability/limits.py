"""Where a scene stands against the derived limit of each integrator, and how large a step it allows."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.derive.integrators.declaration import Integrator
from tmm_gen.derive.integrators.order import order
from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.derive.integrators.stability import stability_limit
from tmm_gen.scene import Scene
from tmm_gen.stability.growth import Growth
from tmm_gen.stability.motion import SmallMotion
from tmm_gen.stability.whole_arm import WholeStep

Array = NDArray[np.float64]

WHOLE_TOLERANCE = 1e-7
"""Growth below this, of matrices in double precision with eigenvalues that meet, is none."""

_MOST_TOGETHER = 600
"""Rows of the largest matrix on the whole arm whose eigenvalues are worth waiting for."""

_DIGITS = 10
"""Of a damping ratio that goes into exact algebra."""

_CANDIDATES = 3
"""Modes whose exact limits are derived: those with the lowest limits in double precision; and the outermost."""

_STEPS_PER_DECADE = 24
_VISIBLE = 1e-9
_NO_DAMPING = 1e-12


@dataclass(frozen=True)
class Standing:
    """Where a scene stands with one integrator.

    Parameters
    ----------
    integrator : Integrator
        With its parameters bound.
    chosen : bool
        It is the scene's own.
    order : int
        Of displacement and velocity.
    limit, limit_damped : float
        Largest ``Omega = w h``, undamped and at the damping ratio of the highest frequency; infinite where there is
        none, zero where motion grows at any step.
    radius_excess : float
        Spectral radius of a step less 1, the worst of all modes; zero where a motion neither grows nor decays.
    worst : int
        Number of the mode that has it, from 0.
    largest_step : float
        s; below it nothing grows. Infinite where no step is too large, zero where every step is.
    stable : bool
        Nothing grows at the scene's step.
    exact : bool
        From the whole arm or from modes that damping does not couple; otherwise each mode has the damping ratio of
        its own poles.
    """

    integrator: Integrator
    chosen: bool
    order: int
    limit: float
    limit_damped: float
    radius_excess: float
    worst: int
    largest_step: float
    stable: bool
    exact: bool


def scene_integrators(scene: Scene, wanted: Iterable[str] | None = None) -> list[Integrator]:
    """Return integrators by name, all by default; the scene's own with the scene's parameters."""
    found = []
    for name in wanted or sorted(scene.integrators):
        own = name.replace("-", "_") == scene.integrator.name
        found.append(integrator(name, **(scene.integrator.parameters if own else {})))
    return found


def standings(
    motion: SmallMotion, methods: Iterable[Integrator], advance: Callable[[str], None] = lambda name: None
) -> list[Standing]:
    """Return where a scene stands with some integrators at its own step.

    Parameters
    ----------
    motion : SmallMotion
        Of the scene.
    methods : iterable of Integrator
        With parameters bound to numbers.
    advance : callable, optional
        Called with the name of each integrator that is done.
    """
    found = []
    for method in methods:
        found.append(standing(motion, Growth(method)))
        advance(method.name)
    return found


def standing(motion: SmallMotion, growth: Growth) -> Standing:
    """Return where a scene stands with one integrator."""
    scene, linear, highest = motion.scene, growth.linear, motion.highest
    h = scene.integrator.step
    stiffness, damping = motion.stiffness, motion.damping
    radii = growth.radius(stiffness * h * h, damping * h)
    worst = int(np.argmax(radii))
    excess = growth.excess(float(stiffness[worst]) * h * h, float(damping[worst]) * h)
    undamped, damped = float(stability_limit(linear)), limit_at(growth, highest.damping_ratio or 0.0)
    largest = _largest_step(motion, growth, undamped, damped)
    exact = not motion.together
    if motion.together:
        whole = WholeStep(growth.integrator, motion.linear, motion.rounds)
        if whole.size <= _MOST_TOGETHER:
            exact = True
            found = whole.radius(h) - 1.0
            found = max(found, 0.0) if motion.afloat else found
            excess = 0.0 if abs(found) <= WHOLE_TOLERANCE else found
            largest = _whole_arm_step(whole, largest, motion)
    return Standing(
        integrator=growth.integrator,
        chosen=growth.integrator.name == scene.integrator.name,
        order=order(growth.integrator, linear),
        limit=undamped,
        limit_damped=damped,
        radius_excess=excess,
        worst=worst,
        largest_step=largest,
        stable=excess <= 0.0,
        exact=exact,
    )


def limit_at(growth: Growth, zeta: float) -> float:
    """Return the largest ``Omega`` at a damping ratio, from exact algebra; a negative ratio counts as none."""
    used = float(f"{zeta:.{_DIGITS}g}") if zeta > _NO_DAMPING else 0.0
    return float(stability_limit(growth.linear, used))


def _largest_step(motion: SmallMotion, growth: Growth, undamped: float, damped: float) -> float:
    """Return the largest stable step of modes that are not coupled."""
    modes = motion.modes
    rough = np.array(
        [
            math.inf if mode.unstable else _scanned(growth, float(k), float(d))
            for mode, k, d in zip(modes, motion.stiffness, motion.damping, strict=True)
        ]
    )
    if math.isinf(undamped) and math.isinf(damped) and np.all(np.isinf(rough)):
        return math.inf
    swinging = {k for k, mode in enumerate(modes) if mode.frequency > 0.0 and mode.damping_ratio is not None}
    turning = [k for k in range(len(modes)) if k not in swinging]  # freely: without a frequency
    smallest = min((float(rough[k]) for k in turning), default=math.inf)
    lowest = {int(k) for k in np.argsort(rough, kind="stable")[:_CANDIDATES]}
    for k in sorted(swinging & (lowest | {min(swinging, default=0), max(swinging, default=0)})):
        smallest = min(smallest, limit_at(growth, modes[k].damping_ratio or 0.0) / modes[k].frequency)
    return smallest


def _scanned(growth: Growth, stiffness: float, damping: float) -> float:
    """Return the first step at which a mode visibly grows, on a scan in double precision; infinite if none."""
    fastest = max(math.sqrt(max(stiffness, 0.0)), damping)
    # no time of its own: all steps are alike, and double precision cannot part its two ones
    if fastest == 0.0:
        return math.inf if growth.excess(0.0, 0.0) <= 0.0 else 0.0
    steps = np.logspace(-3, 5, 8 * _STEPS_PER_DECADE + 1) / fastest
    grows = growth.radius(stiffness * steps**2, damping * steps) > 1.0 + _VISIBLE
    if not np.any(grows):
        return math.inf
    first = int(np.argmax(grows))
    if first == 0:
        return 0.0
    return _bisected(
        lambda h: bool(growth.radius(stiffness * h * h, damping * h) > 1.0 + _VISIBLE),
        float(steps[first - 1]),
        float(steps[first]),
    )


def _whole_arm_step(whole: WholeStep, modal: float, motion: SmallMotion) -> float:
    """Return the largest stable step of the whole arm, sought around that of its modes."""
    if modal == 0.0 and any(mode.damping_ratio == 0.0 for mode in motion.modes):
        return 0.0
    fastest = motion.highest.frequency
    around = modal if 0.0 < modal < math.inf else 1.0 / fastest
    factors = np.logspace(-1, 1, 41) if modal < math.inf else np.logspace(-2, 4, 41)
    if motion.rounds is not None and modal == math.inf:  # what weight makes is slow
        slowest = min((mode.frequency for mode in motion.modes if mode.frequency > 0.0), default=fastest)
        factors = np.logspace(-2, max(4.0, 2.0 + math.log10(fastest / slowest)), 41)

    def grows(step: float) -> bool:
        return whole.radius(step) > 1.0 + WHOLE_TOLERANCE

    before = 0.0
    for step in (around * factors).tolist():
        if grows(step):
            return _bisected(grows, before, step) if before else 0.0
        before = step
    return math.inf


def _bisected(grows: Callable[[float], bool], low: float, high: float) -> float:
    while high > low * (1.0 + 1e-9):
        middle = math.sqrt(low * high)
        low, high = (low, middle) if grows(middle) else (middle, high)
    return low
