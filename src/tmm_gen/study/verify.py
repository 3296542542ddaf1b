"""A configuration run afresh, by the way a user would run it, and held against the reference at every step."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tmm_gen.native import compile_kernel
from tmm_gen.native.series import Series
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene
from tmm_gen.simulate.prescribed import kernel_signals
from tmm_gen.simulate.run import simulate
from tmm_gen.simulate.tolerance import to_accept
from tmm_gen.study.configuration import Configuration
from tmm_gen.study.cost import measured, timed_step
from tmm_gen.study.evaluate import whole_steps
from tmm_gen.study.excitation import Excitation, columns
from tmm_gen.study.references import References


@dataclass(frozen=True)
class Verified:
    """What a fresh run has shown.

    Parameters
    ----------
    error : float
        Largest time error at any step, relative to the travel.
    ns_per_step : float
        Median.
    spread : float
        Half the distance between the quartiles, over the median.
    ns_per_second : float
        Nanoseconds of computing for a simulated second.
    accepted : float, optional
        What ``model.unsolved`` must accept of a planar arm's run (:func:`tmm_gen.simulate.tolerance.to_accept`): the
        error counts it in.
    """

    error: float
    ns_per_step: float
    spread: float
    ns_per_second: float
    accepted: float | None = None


def verify(
    scene: Scene, excitation: Excitation, configuration: Configuration, references: References, rounds: int
) -> Verified:
    """Build, compile and run a configuration from scratch; nothing of a former run is used but the reference.

    Raises
    ------
    UserError
        If it diverges or cannot be built: it did not before.
    """
    chosen = configuration.apply(scene)
    kernel = compile_kernel(build_program(chosen), chosen)
    simulation = simulate(
        chosen,
        excitation.signals,
        excitation.until,
        "c",
        kernel=kernel,
        refuse=False,
        judge=False,
        fixed=True,
    )
    names = columns(chosen, excitation.output)
    found = np.array([simulation.outputs[name] for name in names])
    truth = references.of(configuration.family.links)
    inside = simulation.time <= excitation.until * (1.0 + 1e-9)
    exact = truth.at(simulation.time[inside])
    error = float(np.max(np.linalg.norm(found[:, inside] - exact, axis=0)) / truth.travel)
    signals = {name: signal.at for name, signal in kernel_signals(chosen, excitation.signals).items()}
    step = timed_step(configuration.step, excitation.until)
    series = Series(kernel, signals, whole_steps(excitation.until, step), step)
    cost = measured(series, rounds)
    accepted = to_accept(chosen, simulation.unsolved, simulation.step_error)
    per_second = cost.ns_per_step / configuration.step
    return Verified(error, cost.ns_per_step, cost.spread, per_second, accepted)
