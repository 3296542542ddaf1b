"""The closed loop whose samples all solvers are given, and how long they take for them.

Times are the processor's for the one thread that computes, so that other work on the machine counts little.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Command
from tmm_gen.control.estimators.extended_kalman import NonlinearFilter
from tmm_gen.control.laws.rti import RealTimeIteration
from tmm_gen.onboard.emit import emit_controller
from tmm_gen.onboard.native import EmittedController

FLAGS = ("-O3", "-march=native", "-ffp-contract=off")

Solver = Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]
"""From a state of the kernel, last torques and disturbances to the torques, (m,)."""


@dataclass(frozen=True, eq=False)
class Record:
    """A closed loop: what was measured and answered, and estimates with last torques for those without estimator.

    Parameters
    ----------
    measured : array, (samples, 3 m)
    torques, last, disturbances : array, (samples, m)
        N m.
    states : array, (samples, s)
        Of the kernel.
    """

    measured: np.ndarray
    torques: np.ndarray
    states: np.ndarray
    last: np.ndarray
    disturbances: np.ndarray


def emitted(bench: Bench, controller: str) -> EmittedController:
    """Return a controller as C for this machine."""
    name, files = emit_controller(bench, controller)
    count, seen = bench.problem.count, bench.problem.sensors.accelerometer is not None
    sensors = [*range(count), *([count] if seen else [])]
    return EmittedController(name, files, sensors, flags=FLAGS, motors=count)


def record(bench: Bench, controller: EmittedController, duration: float) -> Record:
    """Run the closed loop on the model itself, without noise; estimates are those of the same filter in Python."""
    step, motors = bench.step, bench.problem.count
    controller.reset()
    observer = NonlinearFilter(step, bench.links)
    past = np.tile(observer.start, (step.delay.memory + 1, 1))
    state, rows = step.initial(), []
    for _ in range(round(duration / bench.problem.sample_time)):
        seen = np.array(step.sensors(state)).ravel()
        observer.correct(observer.surprise(seen), tuple(observer.sensors), np.full(motors, np.inf))
        torque = controller.command(seen).torque
        estimate = observer.estimate.copy()
        rows.append((seen, torque, estimate[:-motors], past[-1], estimate[-motors:]))
        past = np.vstack([past[1:], torque])
        observer.advance(step.delay.pair(past), step.delay.end(past))
        state = np.array(step.sample(state, np.hstack(step.delay.pair(past)))).ravel()
    return Record(*(np.array(column) for column in zip(*rows, strict=True)))


def time_emitted(controller: EmittedController, seen: Record, repeats: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the time of each sample in each repetition of the whole loop, s, and the torques."""
    runs = []
    for _ in range(repeats):
        controller.reset()
        runs.append(controller.run(seen.measured))
    return np.array([run.seconds for run in runs]), runs[0].torques


def time_other(solver: Solver, seen: Record, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the time of each of the first samples, s, and the torques."""
    seconds, torques = [], []
    for k in range(min(count, len(seen.last))):
        begin = time.thread_time()
        torque = solver(seen.states[k], seen.last[k], seen.disturbances[k])
        seconds.append(time.thread_time() - begin)
        torques.append(torque)
    return np.array(seconds), np.array(torques)


class Converged(RealTimeIteration):
    """Sequential quadratic programming to convergence at every sample: the same iteration, repeated."""

    MOST_ITERATIONS = 8

    def _solved(self, last: np.ndarray) -> Command:
        return self.converged(*self.estimator.ahead(self.delay.known(self._past)), last)

    def converged(self, state: np.ndarray, disturbance: np.ndarray, last: np.ndarray) -> Command:
        """Return the torques from a state of the kernel, disturbances and last torques, and keep the plan."""
        for _ in range(self.MOST_ITERATIONS + 1):
            before = self._plan.copy()
            # what is shifted again becomes the plan as it is
            self._plan = np.hstack([before[:, :1], before[:, :-1]])
            command = self.decide(state, disturbance, last)
            if np.abs(self._plan - before).max() < 1e-7:
                break
        return command

    def shift(self) -> None:
        """Go on by a sample."""
        self._shift()
