"""A controller on an arm, sample by sample."""

from __future__ import annotations

import gc
import time
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.closed_loop.plant import Plant
from tmm_gen.control.command import Controller, Status
from tmm_gen.control.goals.course import Course

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Loop:
    """What happened.

    Parameters
    ----------
    time : array, (k + 1,)
        Instants of the arm's steps, s.
    tip, hub : array, (k + 1, m)
        Polar angles of the tips against what carries their motors, angles of the hubs, rad.
    sampled : array, (samples,)
        Instants at which torques were chosen, s.
    torque : array, (samples, m)
        N m.
    statuses : tuple of Status
        One for each torque.
    seconds, feedback : array, (samples,)
        Processor time the controller took for a sample, and of that from the measurement to the torques.
    iterations : array of int, (samples,)
        Of its solver.
    states : tuple of dict
        State of the arm's kernel at the start of each sample.
    goal : array, (m,)
        Polar angles of the tips to reach, rad.
    wanted : array, (samples, m), optional
        Joint angles along a trajectory, rad.
    """

    time: Array
    tip: Array
    hub: Array
    sampled: Array
    torque: Array
    statuses: tuple[Status, ...]
    seconds: Array
    feedback: Array
    iterations: NDArray[np.int64]
    states: tuple[dict[str, Any], ...]
    goal: Array
    wanted: Array | None = None

    @property
    def fallbacks(self) -> int:
        """How many samples had a status other than OK."""
        return sum(status is not Status.OK for status in self.statuses)


@contextmanager
def _collecting_nothing() -> Iterator[None]:
    """Keep Python's collector from looking through all of SymPy's expressions, for a sixth of a second, in a sample."""
    collects = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collects:
            gc.enable()


def run_loop(
    controller: Controller, plant: Plant, duration: float, timed: bool = True, course: Course | None = None
) -> Loop:
    """Control an arm for some time.

    Parameters
    ----------
    controller : Controller
        Is reset first.
    plant : Plant
        At its start.
    duration : float
        s; whole samples of it.
    timed : bool
        Whether to look at the clock, which takes some systems as long as a controller takes for a sample; without,
        processor times are zero.
    course : Course, optional
        What is to be followed; the controller is told of the samples that it looks ahead.
    """
    clock = time.thread_time if timed else float  # float() is zero
    controller.reset()
    # caches warm up, so that the first samples are timed like the others; from the second on there is one before
    measured = plant.measured()
    for _ in range(2):
        controller.prepare()
        controller.command(measured)
    controller.reset()
    samples = max(1, round(duration / plant.problem.sample_time))
    seen, count = [plant.angles()[None]], plant.problem.count
    commands, seconds, feedback = [], np.zeros(samples), np.zeros(samples)
    with _collecting_nothing() if timed else nullcontext():
        for sample in range(samples):
            measured = plant.measured()
            begin = clock()
            if course is not None:
                controller.follow(course.ahead(sample, plant.problem.horizon))
            controller.prepare()
            between = clock()
            command = controller.command(measured)
            end = clock()
            seconds[sample], feedback[sample] = end - begin, end - between
            commands.append(command)
            seen.append(plant.advance(command.torque))
    angles = np.vstack(seen)
    return Loop(
        time=plant.step * np.arange(len(angles), dtype=float),
        tip=np.unwrap(angles[:, :count], axis=0),
        hub=angles[:, count:],
        sampled=plant.problem.sample_time * np.arange(samples, dtype=float),
        torque=np.array([command.torque for command in commands]),
        statuses=tuple(command.status for command in commands),
        seconds=seconds,
        feedback=feedback,
        iterations=np.array([command.iterations for command in commands]),
        states=tuple(plant.states[-samples:]),
        goal=plant.goal,
        wanted=None if course is None else course.at(np.arange(samples)),
    )
