"""Emitted controllers of the swing, each made once, with what their sensors showed in a closed loop."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest

from tmm_gen.closed_loop.plant import Plant
from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Controller
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.estimators.extended_kalman import NonlinearFilter
from tmm_gen.control.laws.linear_mpc import LinearMpc
from tmm_gen.control.laws.rti import RealTimeIteration
from tmm_gen.onboard.emit import emit_controller
from tmm_gen.onboard.native import EmittedController

SENSORS = [0, 1]
"""The swing's: encoder and accelerometer."""
FLAGS = ("-O1", "-ffp-contract=off")


@dataclass(frozen=True, eq=False)
class Loop:
    """What sensors showed, (samples, 3), and what the controller in Python answered, (samples,)."""

    measured: np.ndarray
    torques: np.ndarray


def python_controller(bench: Bench, kind: str) -> Controller:
    """Return the controller that the emitted one must equal: of constant gain, the filters of the nonlinear ones."""
    if kind.startswith("mpc"):
        return LinearMpc(bench.links if kind == "mpc-links" else bench.modes, bench.problem, bench.inertia)
    made = RealTimeIteration(bench.step, bench.links, bench.inertia, kind == "rti-zero")
    made.estimator = NonlinearFilter(bench.step, bench.links)
    return made


@pytest.fixture(scope="session")
def in_python() -> Callable[[Bench, str], Controller]:
    """Return what makes the controller that an emitted one must equal."""
    return python_controller


@pytest.fixture(scope="session")
def emitted(bench: Bench) -> Callable[..., EmittedController]:
    """Compile a controller of the swing."""

    @cache
    def make(kind: str, real: str = "float64") -> EmittedController:
        name, files = emit_controller(bench, kind, real)
        return EmittedController(name, files, SENSORS, real, flags=FLAGS)

    return make


@pytest.fixture(scope="session")
def recorded(bench: Bench) -> Callable[[str, int], Loop]:
    """Run a controller's closed loop with half as much payload again, in Python."""

    @cache
    def run(kind: str, samples: int) -> Loop:
        controller, plant = python_controller(bench, kind), Plant(bench.scene, bench.problem, CONDITIONS[1])
        measured, torques = [], []
        for _ in range(samples):
            measured.append(plant.measured())
            torques.append(controller.command(measured[-1]).torque)
            plant.advance(torques[-1])
        return Loop(np.array(measured), np.array(torques))

    return run
