"""Why a motion that is checked does not last, or errs too much, and a step with which it does: found by trying."""

from __future__ import annotations

from collections.abc import Callable

from tmm_gen.scene import Scene
from tmm_gen.scene.signal import PRESCRIBED
from tmm_gen.simulate.divergence import BrokenOffError, integrator_cause
from tmm_gen.simulate.planar_divergence import PlanarWatch
from tmm_gen.simulate.tolerance import UnsolvedError

_SHARES = (2, 5, 10, 20, 50, 100, 200, 500, 1000)
"""What a step is divided by, one after the other."""
_MOST = 2e5
"""Steps, times stations, that are tried."""
_FACTORS = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
"""By which forces and torques of 1 are multiplied, one after the other, by turns with steps."""
_FEW = 20
"""From where on, as what a step is divided by, smaller loads are tried too."""
_CONFIRMED = 2
"""How many steps that look good are checked in full."""


def broken_off(scene: Scene, error: Exception) -> str:
    """Return, on one line, why a motion broke off.

    Parameters
    ----------
    scene : Scene
        What moved, by its own step.
    error : Exception
        That ended it: with its cause where it is one of a run, a refusal of the kernel otherwise.
    """
    if isinstance(error, ArithmeticError):
        return f"{error}. {_cause(scene)}"
    if isinstance(error, BrokenOffError):
        return error.cause
    lines = str(error).splitlines()
    return " ".join(lines[:1] if isinstance(error, UnsolvedError) else lines)


def too_coarse(scene: Scene) -> str:
    """Return why a motion errs more than it may though it lasts."""
    return integrator_cause(scene, scene.integrator.step) or (
        f"Cause: a step of {scene.integrator.step:g} s is too coarse for this motion."
    )


def _cause(scene: Scene) -> str:
    if not scene.model.linear:
        return PlanarWatch(scene, scene.integrator.step).cause()
    return too_coarse(scene)


def remedy(
    scene: Scene,
    duration: float,
    holds: Callable[[Scene, float], bool],
    passes: Callable[[Scene, float], bool],
) -> str:
    """Return a step or inputs with which all of a check holds, in a sentence; or that there is none.

    Parameters
    ----------
    scene : Scene
        That does not hold.
    duration : float
        Of its run, s.
    holds : callable
        Whether the run of a scene with another step is good, forces and torques being scaled by a factor: quick.
    passes : callable
        Whether all of its check is: slow.
    """
    loads = [item.name for item in scene.inputs if item.acts not in PRESCRIBED]
    # in space inputs are sines of their own sizes already, which no option scales
    fixed = scene.model.linear or scene.spatial is not None
    factors = iter(_FACTORS if loads and not fixed else ())
    unconfirmed, shortest = 0, scene.integrator.step
    for share in _SHARES:
        step = float(f"{scene.integrator.step / share:.2g}")
        if unconfirmed < _CONFIRMED and duration / step * scene.stations <= _MOST:
            shortest, other = step, scene.replace(**{"integrator.step": step})
            if holds(other, 1.0):
                if passes(other, 1.0):
                    return f"With --step {step:g} everything holds."
                unconfirmed += 1
        if share < _FEW:
            continue
        factor = next(factors, None)
        if factor is not None and holds(scene, factor) and passes(scene, factor):
            given = " ".join(f"--input {name}={factor:g}" for name in loads)
            return f"The check lets every input be 1, too much for this arm: with {given} everything holds."
    held = ", or springs too soft for the weight" if scene.model.gravity else ""
    tried = f"Steps down to {shortest:g} s" if shortest < scene.integrator.step else "No other steps"
    return f"{tried} were tried, in vain: look for a number of the wrong size{held}."
