"""Every controller tuned by the same optimiser, on the same objective, with the same number of closed loops.

Differential evolution (R. Storn, K. Price, J. Global Optim. 11, 1997) on the logarithms of the gains or weights:
settling time has steps, so that nothing smoother will do.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.bench import Bench
from tmm_gen.control.closed_loop import run_loop
from tmm_gen.control.condition import CONDITIONS, Condition
from tmm_gen.control.controllers import BY_NAME
from tmm_gen.control.figures import Figures, loop_figures
from tmm_gen.control.plant import Plant
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

BUDGET = 400
"""Evaluations of the objective."""
POPULATION = 20
DURATION = 2.0
"""Of each closed loop, s."""
TRIED: tuple[Condition, ...] = tuple(case for case in CONDITIONS if case.name in ("nominal", "payload"))
"""Conditions a tuning has to do well under, all at once."""

_NEAR = 0.06
"""Spread of the first tunings about the scene's own, relative to the ranges."""
_NEVER = 2.5
"""Settling time where the arm does not settle, s."""
_OVERSHOOT, _RESIDUAL = 0.005, 0.5e-3
"""Free of charge: overshoot relative to the way, residual vibration in rad."""


@dataclass(frozen=True)
class Knob:
    """A number to be tuned.

    Parameters
    ----------
    key : str
        In the scene, dotted; the same key twice makes a list.
    low, high : float
        Decimal logarithms of its range.
    """

    key: str
    low: float
    high: float


@dataclass(frozen=True)
class Tunable:
    """What is tuned together.

    Parameters
    ----------
    name : str
        As on the command line.
    controllers : tuple of str
        Whose objectives count, all with one tuning.
    knobs : tuple of Knob
        What may be turned.
    """

    name: str
    controllers: tuple[str, ...]
    knobs: tuple[Knob, ...]


def _pd(name: str, key: str) -> Tunable:
    gains = f"control.baselines.{key}"
    return Tunable(name, (name,), (Knob(gains, -1.0, 2.0), Knob(gains, -1.5, 1.5)))


_LQR = tuple(
    Knob(f"control.baselines.lqr.{key}", low, high)
    for key, low, high in (
        ("hub", -3.0, 1.0),
        ("tip_rate", -5.0, 0.0),
        ("hub_rate", -5.0, 0.0),
        ("torque", -4.0, 1.0),
    )
)
_MPC = tuple(
    Knob(f"control.{key}", low, high)
    for key, low, high in (
        ("weights.hub", -3.0, 1.0),
        ("weights.tip_rate", -5.0, 0.0),
        ("weights.hub_rate", -5.0, 0.0),
        ("weights.torque", -5.0, -1.0),
        ("weights.torque_step", -5.0, -1.0),
        ("weights.terminal", 0.0, 3.0),
        ("weights.overshoot", 0.0, 5.0),
        ("weights.hub_bound", 0.0, 5.0),
        ("estimator.encoder", -4.0, -1.5),
        ("estimator.accelerometer", -1.5, 1.0),
        ("estimator.torque", -4.0, 1.0),
        ("estimator.disturbance", -4.0, 1.0),
    )
)

TUNABLE: tuple[Tunable, ...] = (
    _pd("pd", "pd"),
    _pd("pd-zv", "pd_zv"),
    _pd("pd-zvd", "pd_zvd"),
    Tunable("lqr", ("lqr",), _LQR),
    Tunable("mpc", ("mpc-modes", "rti-zero"), _MPC),
)


def price(figures: Figures) -> float:
    """Return what a closed loop costs: its settling time, and overshoot and vibration beyond what is free."""
    settling = _NEVER if figures.settling is None else figures.settling
    overshoot = max(0.0, figures.overshoot - _OVERSHOOT)
    residual = max(0.0, figures.residual - _RESIDUAL)
    return settling + 30.0 * overshoot + 100.0 * residual


def turned(scene: Scene, tunable: Tunable, values: Array) -> Scene:
    """Return a scene with its knobs set to values, decimal logarithms, rounded to three digits."""
    changes: dict[str, object] = {}
    for knob, value in zip(tunable.knobs, values, strict=True):
        number = float(f"{10.0 ** float(value):.3g}")
        known = changes.get(knob.key)
        if sum(other.key == knob.key for other in tunable.knobs) > 1:
            changes[knob.key] = [*(known if isinstance(known, list) else []), number]
        else:
            changes[knob.key] = number
    return scene.replace(**changes)


def objective(bench: Bench, tunable: Tunable) -> float:
    """Return the mean price of a scene's tuning over controllers and conditions."""
    total = 0.0
    for name in tunable.controllers:
        try:
            controller = BY_NAME[name].make(bench)
        except (
            np.linalg.LinAlgError,
            ValueError,
        ):  # weights so far apart that nothing can be solved with them
            return 10.0 * _NEVER
        for condition in TRIED:
            loop = run_loop(controller, Plant(bench.scene, bench.problem, condition), DURATION)
            total += price(loop_figures(loop, bench.problem.reference))
    return total / (len(tunable.controllers) * len(TRIED))


def tune(
    bench: Bench,
    tunable: Tunable,
    budget: int = BUDGET,
    seed: int = 0,
    advance: Callable[[], object] | None = None,
) -> tuple[Scene, float]:
    """Return the scene with the best tuning found, its own one among those tried, and its price.

    Parameters
    ----------
    bench : Bench
        Of the scene.
    tunable : Tunable
        What is tuned.
    budget : int
        Evaluations, at least twice `POPULATION`.
    seed : int
        Of the optimiser.
    advance : callable, optional
        Called after each evaluation.
    """
    from scipy.optimize import differential_evolution  # slow to import

    best: list[tuple[float, Scene]] = [(objective(bench, tunable), bench.scene)]

    def cost(values: Array) -> float:
        scene = turned(bench.scene, tunable, values)
        found = objective(bench.retuned(scene), tunable)
        if found < best[0][0]:
            best[0] = (found, scene)
        if advance is not None:
            advance()
        return found

    random = np.random.default_rng(seed)
    low, high = (np.array([getattr(knob, end) for knob in tunable.knobs]) for end in ("low", "high"))
    first = low + (high - low) * random.random((POPULATION, len(low)))
    start = _present(bench.scene, tunable)
    if start is not None:  # most of the population starts near the scene's own tuning
        near = start + _NEAR * (high - low) * random.standard_normal(first.shape)
        near[0] = start
        first[: 3 * POPULATION // 4] = np.clip(near, low, high)[: 3 * POPULATION // 4]
    differential_evolution(
        cost,
        list(zip(low, high, strict=True)),
        init=first,
        maxiter=max(1, budget // POPULATION - 1),
        mutation=(0.4, 0.9),
        recombination=0.7,
        polish=False,
        tol=0.0,
        rng=random,
    )
    return best[0][1], best[0][0]


def _present(scene: Scene, tunable: Tunable) -> Array | None:
    """Return the scene's own tuning, decimal logarithms; None where it has none or one beyond all ranges."""
    found: list[float] = []
    for place, knob in enumerate(tunable.knobs):
        value: object = scene
        for part in knob.key.split("."):
            value = getattr(value, part)
        if isinstance(value, tuple):
            value = value[place]
        if not isinstance(value, float):
            return None
        found.append(float(np.log10(max(value, 1e-12))))
    return np.array(found)
