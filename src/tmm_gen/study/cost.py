"""What a step costs in time: compiled C on this machine, the study's own run, medians over rounds.

A single short run on a busy machine says nothing. So every family is timed on a run of the same loads with some
thousand steps, all families in turn, round after round: what slows the machine for a while slows all of them. Counted
is the time that the processor works on it. A step costs the same whatever its length, so that its time over its
length is the cost of a simulated second.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from tmm_gen.native.series import Series
from tmm_gen.native.timing import ROUNDS, Cost, by_turns, cost_of
from tmm_gen.scene import Scene
from tmm_gen.simulate.prescribed import kernel_signals
from tmm_gen.study.configuration import Configuration, Family
from tmm_gen.study.evaluate import family_scene, whole_steps
from tmm_gen.study.excitation import Excitation
from tmm_gen.study.kernels import Built, build

_STEPS = 4000
"""Steps of a timed run, about."""

_NUMPY_STEPS = 60

_REPEATS = 5
"""Runs of a family in a round, of which the fastest counts: nothing makes a run faster than it is."""


def measure_costs(
    scene: Scene,
    excitation: Excitation,
    finished: Mapping[Family, Sequence[float]],
    rounds: int = ROUNDS,
    advance: Callable[[float], None] | None = None,
) -> dict[Family, Cost]:
    """Measure what a step costs.

    Parameters
    ----------
    scene : Scene
        As the user wrote it.
    excitation : Excitation
        What it goes through.
    finished : mapping from Family to steps
        Families, and for each the steps (s) at which its run finished; at one of these it is timed.
    rounds : int
        Measurements of each.
    advance : callable, optional
        Called with 1 after each round.
    """
    timed = {
        family: timer(scene, excitation, Configuration(family, _nearest(steps, excitation.until, family)))
        for family, steps in finished.items()
        if steps
    }
    return by_turns(timed, rounds, advance)


def timer(scene: Scene, excitation: Excitation, configuration: Configuration) -> Callable[[], float]:
    """Return a function that runs a configuration once and returns nanoseconds per step."""
    built = build(family_scene(scene, configuration))
    steps = max(1, whole_steps(excitation.until, configuration.step))
    if configuration.family.backend != "c":
        return _numpy_timer(built, excitation, configuration.step, min(steps, _NUMPY_STEPS))
    signals = {name: signal.at for name, signal in kernel_signals(built.scene, excitation.signals).items()}
    series = Series(built.native, signals, steps, configuration.step)

    return lambda: _once(series)


def measured(series: Series, rounds: int) -> Cost:
    """Return what a step of one run costs."""
    return cost_of([_once(series) for _ in range(max(1, rounds))])


def _once(series: Series) -> float:
    return 1e9 * min(series.seconds() for _ in range(_REPEATS)) / series.steps


def _numpy_timer(built: Built, excitation: Excitation, step: float, steps: int) -> Callable[[], float]:
    module: Any = built.module
    acting = kernel_signals(built.scene, excitation.signals)
    signals = {name: float(signal.at(0.0)) for name, signal in acting.items()}

    def measure() -> float:
        with np.errstate(all="ignore"):
            begun = time.thread_time()
            module.simulate(step * steps, signals, step=step)
        return 1e9 * (time.thread_time() - begun) / steps

    return measure


def timed_step(step: float, until: float) -> float:
    """Return a step not longer than one that works, at which a run is long enough to be timed."""
    return min(step, until / _STEPS)


def _nearest(steps: Sequence[float], until: float, family: Family) -> float:
    """Return the step whose run is nearest to the wanted length, in the sense of ratios."""
    wanted = _STEPS if family.backend == "c" else _NUMPY_STEPS
    return min(steps, key=lambda step: abs(np.log(until / step / wanted)))
