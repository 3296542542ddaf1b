"""Controllers side by side, under several conditions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from tmm_gen.closed_loop.figures import Figures, loop_figures
from tmm_gen.closed_loop.loop import Loop, run_loop
from tmm_gen.closed_loop.space_plant import plant_of
from tmm_gen.closed_loop.tracking import Tracking, nearest_to_walls, tracking_figures
from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Controller
from tmm_gen.control.condition import Condition
from tmm_gen.control.controllers import ControllerKind
from tmm_gen.control.estimators.kalman import present_sensors
from tmm_gen.control.plant.differing import require_difference
from tmm_gen.control.task.sample_count import require_countable
from tmm_gen.onboard.emit import EMITTED, emit_controller
from tmm_gen.onboard.native import EmittedController

DURATION = 2.5
"""Of a closed loop, s."""


@dataclass(frozen=True, eq=False)
class Trial:
    """A controller under a condition.

    Parameters
    ----------
    kind : ControllerKind
        What controlled.
    condition : Condition
        In what the arm differed from the scene.
    loop : Loop
        What happened.
    figures : Figures
        How good it was.
    compiled : bool
        Whether the controller was compiled C.
    tracking : Tracking, optional
        How well it followed, where there was something to follow.
    nearest : float, optional
        How near a part came to its wall, m, negative beyond it; where there are walls.
    """

    kind: ControllerKind
    condition: Condition
    loop: Loop
    figures: Figures
    compiled: bool = False
    tracking: Tracking | None = None
    nearest: float | None = None

    def row(self) -> dict[str, object]:
        """Return what a table shows: times in s, angles in mrad, microseconds; None where it never settles.

        Overshoot is None where no tip has anywhere to go. Along a trajectory, mm that the arm's end is off instead.
        """
        loop, figures, tracking = self.loop, self.figures, self.tracking
        reached: dict[str, object] = {
            "settling_s": figures.settling,
            "overshoot_percent": None if figures.overshoot is None else 100.0 * figures.overshoot,
            "residual_mrad": 1e3 * figures.residual,
            "offset_mrad": 1e3 * figures.offset,
        }
        if tracking is not None:
            reached = {
                "off_rms_mm": 1e3 * tracking.rms,
                "off_most_mm": 1e3 * tracking.largest,
                "at_stops_mm": None if tracking.vibration is None else 1e3 * tracking.vibration,
            }
        return {
            "controller": self.kind.name,
            "condition": self.condition.name,
            **reached,
            **({} if self.nearest is None else {"to_wall_mm": 1e3 * self.nearest}),
            "solve_us_median": 1e6 * float(np.median(loop.seconds)),
            "solve_us_max": 1e6 * float(np.max(loop.seconds)),
            "iterations_max": int(np.max(loop.iterations)),
            "fallbacks": figures.fallbacks,
            "compiled": self.compiled,
        }


def compare(
    bench: Bench,
    kinds: Sequence[ControllerKind],
    conditions: Sequence[Condition],
    duration: float = DURATION,
    seed: int = 0,
    compiled: bool = False,
) -> Iterator[Trial]:
    """Yield the trials, condition by condition.

    Parameters
    ----------
    bench : Bench
        Of the scene.
    kinds : sequence of ControllerKind
        What is compared; all of them see the same noise.
    conditions : sequence of Condition
        Under what.
    duration : float
        Of each, s.
    seed : int
        Of the noise.
    compiled : bool
        Whether to run what can be emitted as compiled C.

    Raises
    ------
    UserError
        If the motor cannot hold the target, a condition would change nothing of the arm, or samples are too many.
    """
    require_countable(bench.scene, duration, bench.problem.sample_time)
    for condition in conditions:
        require_difference(bench.scene, condition)
    told = {(0.0, 0.0): bench}
    for condition in conditions:
        known = (condition.gravity, condition.delay)
        if known not in told:
            told[known] = bench.told(condition)
        for kind in kinds:
            controller = made(kind, told[known], compiled)
            plant = plant_of(bench.scene, bench.problem, condition, seed)
            loop = run_loop(controller, plant, duration, course=bench.course)
            figures = loop_figures(loop)
            tracking = None if bench.course is None else tracking_figures(loop, plant, bench)
            nearest = nearest_to_walls(loop, plant, bench.problem.keeps)
            in_c = compiled and kind.name in EMITTED
            yield Trial(kind, condition, loop, figures, in_c, tracking, nearest)


def worst(
    bench: Bench,
    kind: ControllerKind,
    condition: Condition,
    seeds: Sequence[int],
    duration: float = DURATION,
    compiled: bool = False,
) -> Figures:
    """Return the worst of each figure over several noises; it settles only if it does with all of them.

    Parameters
    ----------
    bench : Bench
        Of the scene.
    kind : ControllerKind
        What controls.
    condition : Condition
        Of the arm; gravity and delay are told.
    seeds : sequence of int
        Of the noise.
    duration : float
        Of each loop, s.
    compiled : bool
        Whether to run compiled C where there is such.
    """
    controller = made(kind, bench.told(condition), compiled)
    every = []
    for seed in seeds:
        loop = run_loop(controller, plant_of(bench.scene, bench.problem, condition, seed), duration)
        every.append(loop_figures(loop))
    settling = [figures.settling for figures in every if figures.settling is not None]
    overshoot = [figures.overshoot for figures in every if figures.overshoot is not None]
    return Figures(
        settling=max(settling) if len(settling) == len(every) else None,
        overshoot=max(overshoot, default=None),
        residual=max(figures.residual for figures in every),
        offset=max((figures.offset for figures in every), key=abs),
        fallbacks=max(figures.fallbacks for figures in every),
    )


def made(kind: ControllerKind, bench: Bench, compiled: bool) -> Controller:
    """Return a controller, as compiled C where that is asked for and exists.

    Raises
    ------
    UserError
        If the scene has a trajectory and it follows none, or walls and it keeps none.
    """
    kind.require_able(bench)
    if not compiled or kind.name not in EMITTED:
        return kind.make(bench)
    name, files = emit_controller(bench, kind.name)
    return EmittedController(name, files, sensors=present_sensors(bench.problem), motors=bench.problem.count)
