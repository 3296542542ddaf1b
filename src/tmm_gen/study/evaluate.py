"""Running one configuration and holding it against the reference."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import UserError
from tmm_gen.scene import Scene
from tmm_gen.simulate.prescribed import kernel_signals
from tmm_gen.study.configuration import Configuration
from tmm_gen.study.excitation import Excitation, columns
from tmm_gen.study.kernels import Built, build
from tmm_gen.study.outcome import Outcome, Result
from tmm_gen.study.truth import Truth

Array = NDArray[np.float64]

_FAR = 10.0
"""A motion that is off by more than this many times the whole travel has diverged."""

_COMPARED = 400
"""Instants at least at which a run of as many steps is compared; all of them would only take time."""


def evaluate(scene: Scene, excitation: Excitation, configuration: Configuration, truth: Truth) -> Result:
    """Compute the motion in one configuration, and its error.

    Parameters
    ----------
    scene : Scene
        As the user wrote it.
    excitation : Excitation
        What it goes through.
    configuration : Configuration
        How it is computed.
    truth : Truth
        The reference of the scene with this configuration's links.

    Returns
    -------
    Result
        Always: what is refused or diverges is a result too.
    """
    steps = whole_steps(excitation.until, configuration.step)
    if steps < 1:
        told = f"a step of {configuration.step:g} s is longer than the whole time of {excitation.until:g} s"
        return Result(Outcome.REFUSED, told)
    try:
        built = build(family_scene(scene, configuration))
        _allowed(built, configuration)
        counts = _counts(built, configuration)
    except UserError as error:
        return Result(Outcome.REFUSED, " ".join(str(error).split()))
    try:
        motion = start(built, configuration, excitation, steps)
    except ArithmeticError as error:  # a pivot is not positive at this step
        return Result(Outcome.REFUSED, str(error), **counts)
    try:
        found = motion()
    except ArithmeticError as error:
        return Result(Outcome.DIVERGED, str(error), **counts)
    return _compared(found, configuration.step, truth, counts)


def family_scene(scene: Scene, configuration: Configuration) -> Scene:
    """Return the scene that a configuration's kernel is generated for: the same at all steps where that is possible.

    Raises
    ------
    SceneError
        If that is no valid scene.
    """
    if scene.model.sweep == "product":  # safe or not, depending on the step
        return configuration.apply(scene)
    changes = configuration.family.changes(scene)
    return scene.replace(**changes) if changes else scene


def whole_steps(until: float, step: float) -> int:
    """Return how many whole steps there are in a time."""
    return math.floor(until / step * (1.0 + 1e-9))


def start(
    built: Built, configuration: Configuration, excitation: Excitation, steps: int
) -> Callable[[], Array]:
    """Return a function that takes all steps and returns the output that is looked at, (columns, steps + 1).

    Raises
    ------
    ArithmeticError
        If a pivot is not positive to begin with. The function returned raises it if the motion leaves all bounds.
    """
    names = columns(built.scene, excitation.output)
    acting = kernel_signals(built.scene, excitation.signals)
    step = configuration.step
    if configuration.family.backend == "c":
        from tmm_gen.native.series import Series

        sampled = {name: signal.at for name, signal in acting.items()}
        series = Series(built.native, sampled, steps, step)
        series.start()
        return lambda: _picked(series.run(), names)
    module = built.module
    signals = {name: _number(signal) for name, signal in acting.items()}
    module.prepare(module.Params(), step)

    def simulate() -> Array:
        with np.errstate(all="ignore"):
            return _picked(module.simulate(step * steps, signals, step=step).outputs, names)

    return simulate


def _picked(outputs: Any, names: tuple[str, ...]) -> Array:
    return np.array([np.asarray(outputs[name], float) for name in names])


def _number(signal: Any) -> Any:
    return lambda time: float(signal.at(time))


def _allowed(built: Built, configuration: Configuration) -> None:
    """Refuse what the planar kernels refuse to start with."""
    from tmm_gen.simulate.planar_divergence import planar_watch

    if not built.scene.model.linear and built.scene.spatial is None:
        planar_watch(built.scene, configuration.step)


def _counts(built: Built, configuration: Configuration) -> dict[str, Any]:
    """Return what a step costs in numbers that no clock tells."""
    operations = built.operations
    counts: dict[str, Any] = {
        "operations": operations.total,
        "divisions": operations.divisions,
        "functions": operations.functions,
    }
    if configuration.family.backend == "c":
        counts |= built.sizes
    return counts


def _compared(found: Array, step: float, truth: Truth, counts: dict[str, Any]) -> Result:
    if not np.all(np.isfinite(found)):
        return Result(Outcome.DIVERGED, "the output is no longer a finite number", **counts)
    steps = found.shape[1] - 1
    picked = np.arange(0, steps + 1, max(1, steps // _COMPARED))
    travel = truth.travel
    with np.errstate(over="ignore"):  # what overflows is far off
        distance = np.linalg.norm(found[:, picked] - truth.at(picked * step), axis=0) / travel
    error = float(np.max(distance))
    if error > _FAR:
        far = int(picked[int(np.argmax(distance > _FAR))])
        told = f"at t = {far * step:.4g} s the output is off by more than {_FAR:g} times its travel"
        return Result(Outcome.DIVERGED, told, **counts)
    return Result(Outcome.FINISHED, error=error, rms_error=float(np.sqrt(np.mean(distance**2))), **counts)
