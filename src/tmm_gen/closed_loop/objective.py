"""What a tuning is judged by: closed loops under several conditions, one price for all controllers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from tmm_gen.closed_loop.figures import BAND, loop_figures, way_of
from tmm_gen.closed_loop.loop import Loop, run_loop
from tmm_gen.closed_loop.space_plant import plant_of
from tmm_gen.control.arm.arms import arm_of
from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Controller
from tmm_gen.control.condition import Condition
from tmm_gen.control.controllers import BY_NAME
from tmm_gen.control.goals.target import rest_with
from tmm_gen.control.laws.inverse_dynamics import quintic_way
from tmm_gen.control.task.extremes import UnsolvableError

NOISES = (101, 102, 103, 104)
"""Seeds of the sensors' noise while tuning: none of those by which a tuning is judged afterwards."""

_HOPELESS = 100.0
"""Price of numbers with which nothing can be solved."""
_ASTRAY = 20.0
"""Price of a motion that is not finite, or has no end."""
_ORDER = 8.0
"""Of the mean over all loops: nearly the worst of them, but without its ridges, on which a search gets stuck."""


@dataclass(frozen=True)
class Aim:
    """What is wanted under a condition.

    Parameters
    ----------
    condition : Condition
        Which nobody tells the controllers.
    settling : float
        From when on the tip is to stay within 0.5 % of its way, s.
    overshoot : float
        Relative to the way.
    residual : float
        Vibration from 1 s on, peak to peak, rad.
    required : bool
        Of all controllers, of the first two of those tuned together with several noises; else of these two, with one.
    after : float
        From when on vibration counts, s; a loop takes twice as long.
    """

    condition: Condition
    settling: float
    overshoot: float
    residual: float
    required: bool = False
    after: float = 1.0

    def of(self, settling: float, way: float) -> Aim:
        """Return the like for another arm: that may take so long where this one may take `SETTLING`, on another way."""
        times = settling / _SETTLING
        return replace(
            self,
            settling=times * self.settling,
            after=times * self.after,
            residual=_TREMBLING * way * self.residual,
        )


_SETTLING = 0.79
"""What the first two conditions below ask for, s."""
_TREMBLING = 3.0
"""How many times as much, per radian of the way, several motors may tremble: under weight, and with encoders alone."""

AIMS: tuple[Aim, ...] = (
    Aim(Condition("payload", "payload +50 %", payload=1.5), 0.79, 0.014, 3.6e-3, required=True),
    Aim(Condition("nominal", "as the scene says"), 0.79, 0.009, 0.8e-3, required=True),
    Aim(Condition("soft", "stiffness -23 %", stiffness=0.77), 0.95, 0.015, 6e-3),
    Aim(Condition("stiff", "stiffness +25 %", stiffness=1.25), 0.95, 0.015, 6e-3),
    Aim(Condition("late", "delay of 5 ms that nobody knows of", delay=5e-3), 0.95, 0.01, 6e-3),
)
"""Under which conditions tunings are tried. The first two are what is required of predictive control, with some room
for noises not tried: the worst of ten settles a few milliseconds later and vibrates a tenth more than the worst of two.
Of the others it is wanted that the arm comes to rest soon."""


def price(loop: Loop, aim: Aim) -> float:
    """Return what a closed loop costs: the worst of settling, overshoot and vibration, relative to what was aimed at.

    Of settling, it is what the tip is off from the time on at which it should have settled, relative to the band:
    unlike the time itself that has no jumps. Its root is taken, since it varies more than the others.
    """
    off = np.max(np.abs(loop.tip - loop.goal)[loop.time >= aim.settling - 1e-9])
    figures = loop_figures(loop, aim.after)
    assert figures.overshoot is not None, "an arm that has nowhere to go is not tuned"
    late = math.sqrt(off / (BAND * way_of(loop)))
    found = max(late, figures.overshoot / aim.overshoot, figures.residual / aim.residual)
    return min(found, _ASTRAY) if math.isfinite(found) else _ASTRAY


def objective(
    bench: Bench,
    controllers: Sequence[str],
    enough: float = math.inf,
    aims: Sequence[Aim] | None = None,
    order: float = _ORDER,
) -> float:
    """Return the price of a scene's tuning: the power mean of its closed loops' prices.

    If all aims are met it is one at most. Loops are run in turn until the mean is sure to be more than is enough.

    Parameters
    ----------
    bench : Bench
        Of the scene.
    controllers : sequence of str
        Names; all with the scene's numbers.
    enough : float
        Price from which on it does not matter how bad a tuning is.
    aims : sequence of Aim, optional
        Conditions, and what is wanted under each; by default those of :func:`aims_of`.
    order : float
        Of the mean; infinite for the price of the worst loop.
    """
    wanted, noises = aims_of(bench) if aims is None else aims, NOISES if rustles(bench) else NOISES[:1]
    loops = [
        (name, *each) for name in controllers for each in _trials(wanted, noises, name in controllers[:2])
    ]
    prices = np.zeros(len(loops))
    made: dict[str, Controller] = {}
    total = 0.0
    for index, (name, aim, seed) in enumerate(loops):
        try:
            controller = made[name] = made.get(name) or BY_NAME[name].make(bench)
        except (ArithmeticError, ValueError, UnsolvableError):  # numbers with which nothing can be solved
            return _HOPELESS
        plant = plant_of(bench.scene, bench.problem, aim.condition, seed)
        prices[index] = price(run_loop(controller, plant, 2.0 * aim.after, timed=False), aim)
        total = float(np.linalg.norm(prices, order)) / len(loops) ** (1.0 / order)
        if total > enough:
            break
    return total


def aims_of(bench: Bench) -> tuple[Aim, ...]:
    """Return what is aimed at: of several motors, that tips rest after a quintic of the rigid arm and one vibration.

    The quintic is the shortest within nine tenths of the torques, the vibration the slowest there is.
    """
    problem, scene = bench.problem, bench.scene
    if problem.motors.on_hub:
        return AIMS
    goal = rest_with(scene, problem.reference, "control.reference").goal
    quintic = len(quintic_way(scene, problem, problem.start, goal).torque) * problem.sample_time
    settling = quintic + 2.0 * math.pi / arm_of(scene).slowest()
    way = float(np.max(np.abs(problem.reference - problem.start)))
    return tuple(aim.of(settling, way) for aim in AIMS)


def rustles(bench: Bench) -> bool:
    """Return whether a sensor has noise: without, all loops of a condition are one."""
    problem = bench.problem
    return bool(np.any(np.nan_to_num(np.concatenate([problem.accelerometers, problem.gauges]))))


def _trials(aims: Sequence[Aim], noises: Sequence[int], thorough: bool) -> list[tuple[Aim, int]]:
    """Return under which conditions and with which noises a controller is tried."""
    if not thorough:
        return [(aim, noises[0]) for aim in aims if aim.required]
    return [(aim, seed) for aim in aims for seed in (noises if aim.required else noises[:1])]
