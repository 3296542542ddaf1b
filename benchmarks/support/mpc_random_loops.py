"""Closed loops drawn at random: whatever happens, torques are to be finite and within their bounds."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from tmm_gen.closed_loop.figures import Figures, loop_figures
from tmm_gen.closed_loop.loop import Loop, run_loop
from tmm_gen.closed_loop.plant import Plant
from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Command, Controller, Flags, Status
from tmm_gen.control.condition import Condition
from tmm_gen.control.controllers import BY_NAME

Array = NDArray[np.float64]

ROBUST = ("mpc-links", "mpc-modes", "rti-zero", "lqr", "pd-zvd")
"""Controllers that are tried, in turn."""
DURATION = 2.5
"""Of a loop, s."""
_FAULTY = 0.25
"""Share of the loops whose sensors fail now and then."""
_TIGHT = 0.25
"""Share of the loops whose bounds cannot all be kept."""
_TOLERANCE = 1e-9
"""By how much a torque may pass its bounds, for rounding, N m."""


@dataclass(frozen=True)
class RandomCase:
    """What was drawn.

    Parameters
    ----------
    number : int
        Seed.
    controller : str
        Name.
    condition : Condition
        Payload, stiffness, friction, delay that nobody knows of, noise.
    bend, rate : float
        Of the arm at time zero: angle of the tip against the root (rad) and rate of all links (rad/s).
    torque : float
        Bound, N m.
    torque_rate : float or None
        Bound, N m/s.
    tight : bool
        Whether the soft bounds are such that the arm starts outside them or must pass them.
    dropouts : float
        Probability that a sample's measurement is NaN, infinite or absurd.
    """

    number: int
    controller: str
    condition: Condition
    bend: float
    rate: float
    torque: float
    torque_rate: float | None
    tight: bool
    dropouts: float


@dataclass(frozen=True, eq=False)
class RandomOutcome:
    """What became of it.

    Parameters
    ----------
    case : RandomCase
        What was drawn.
    loop : Loop
        What happened.
    figures : Figures
        How good it was.
    within : bool
        Whether every torque was finite and within bounds of size and rate.
    """

    case: RandomCase
    loop: Loop
    figures: Figures
    within: bool


def draw(number: int) -> RandomCase:
    """Return the case of a seed."""
    random = np.random.default_rng(number)
    condition = Condition(
        "random",
        "drawn at random",
        payload=float(random.uniform(0.5, 2.0)),
        stiffness=float(random.uniform(0.7, 1.4)),
        friction=float(random.choice([0.0, random.uniform(0.0, 0.2)])),
        delay=float(random.choice([0.0, random.uniform(0.0, 0.02)])),
        noise=float(10.0 ** random.uniform(-1.0, 1.0)),
    )
    return RandomCase(
        number=number,
        controller=ROBUST[number % len(ROBUST)],
        condition=condition,
        bend=float(random.uniform(-0.1, 0.1)),
        rate=float(random.uniform(-1.0, 1.0)),
        torque=float(random.choice([3.0, random.uniform(0.5, 6.0)])),
        torque_rate=[None, float(random.uniform(10.0, 300.0))][int(random.integers(2))],
        tight=bool(random.random() < _TIGHT),
        dropouts=float(random.uniform(0.01, 0.3)) if random.random() < _FAULTY else 0.0,
    )


def run_case(bench: Bench, case: RandomCase, duration: float = DURATION) -> RandomOutcome:
    """Run a case on a scene's arm.

    Parameters
    ----------
    bench : Bench
        Of the scene; its models stay as they are.
    case : RandomCase
        From :func:`draw`.
    duration : float
        s.
    """
    largest, rate = np.array([case.torque]), case.torque_rate
    change = np.array([np.inf if rate is None else rate])
    problem = replace(bench.problem, torque=(-largest, largest), torque_rate=change)
    if case.tight:
        # a hub that may hardly move although it has to, and a tip that is beyond its bound at the start
        beyond = -0.5 - float(problem.reference[0])
        problem = replace(problem, hub=((0.4, 0.6),), tip=((-np.inf, beyond),))
    told = bench.with_problem(problem)
    controller: Controller = BY_NAME[case.controller].make(told)
    if case.dropouts:
        controller = _Faulty(controller, case)
    plant = Plant(bench.scene, problem, case.condition, case.number)
    stations = bench.scene.stations
    plant.restart(case.bend * np.linspace(0.0, 1.0, max(stations, 2)), case.rate)
    loop = run_loop(controller, plant, duration)
    return RandomOutcome(case, loop, loop_figures(loop), _within(loop, case, bench))


def _within(loop: Loop, case: RandomCase, bench: Bench) -> bool:
    """Return whether every torque is finite and within its bounds."""
    torque = loop.torque
    good = bool(np.all(np.isfinite(torque)) and np.all(np.abs(torque) <= case.torque + _TOLERANCE))
    if case.torque_rate is not None:
        largest = case.torque_rate * bench.problem.sample_time + _TOLERANCE
        good = good and bool(np.all(np.abs(np.diff(torque, axis=0, prepend=0.0)) <= largest))
    return good


class _Faulty:
    """Passes measurements on to a controller, some of them spoilt."""

    def __init__(self, controller: Controller, case: RandomCase) -> None:
        self._controller, self._share, self._seed = controller, case.dropouts, case.number
        self.reset()

    def reset(self) -> None:
        self._random = np.random.default_rng(self._seed)
        self._controller.reset()

    def follow(self, angles: Array) -> Status:
        return self._controller.follow(angles)

    def prepare(self) -> None:
        self._controller.prepare()

    def command(self, measured: Array, valid: Flags | None = None) -> Command:
        if self._random.random() < self._share:
            spoilt = [np.nan, np.inf, -np.inf, 1e300, 1e6][int(self._random.integers(5))]
            measured = measured.copy()
            measured[int(self._random.integers(2))] = spoilt
        return self._controller.command(measured, valid)
