"""By what closed loops along a trajectory are judged: how far the arm's end is off, how it trembles at the stops."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.closed_loop.loop import Loop
from tmm_gen.closed_loop.plant import Plant
from tmm_gen.control.arm.part_frame import end_of, part_frame
from tmm_gen.control.bench import Bench
from tmm_gen.control.goals.target import rest_with
from tmm_gen.control.plant.plant_scene import PLANT_LINKS
from tmm_gen.control.prediction.prediction import fine_scene
from tmm_gen.control.quadratic.walls import Wall
from tmm_gen.scene.trajectory import Keep

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Tracking:
    """Of one closed loop, at its samples; of the outer end of the arm.

    Parameters
    ----------
    rms, largest : float
        Distance from where it would rest with its joints as they are to be, m.
    vibration : float or None
        Over the second half of each stop, and of what is left at the end: the diagonal of the smallest box it stays
        in, the largest of them, m; None where the reference never stops.
    """

    rms: float
    largest: float
    vibration: float | None


def tracking_figures(loop: Loop, plant: Plant, bench: Bench) -> Tracking:
    """Return how well an arm followed the course of a bench.

    Parameters
    ----------
    loop : Loop
        What happened.
    plant : Plant
        The arm.
    bench : Bench
        With a course.
    """
    course = bench.course
    assert course is not None
    places = end_places(plant, loop)
    off = np.linalg.norm(places - wanted_places(bench, len(places)), axis=1)
    shaken = [
        float(np.linalg.norm(np.ptp(places[(first + last) // 2 : last + 1], axis=0)))
        for first, last in course.stops(len(places))
    ]
    return Tracking(float(np.sqrt(np.mean(off**2))), float(np.max(off)), max(shaken, default=None))


def end_places(plant: Plant, loop: Loop, name: str | None = None) -> Array:
    """Return where a part's outer end was at each sample, (samples, 2 or 3), m; by default the arm's."""
    frame = part_frame(plant.scene, name or end_of(plant.scene))
    return frame.place(np.array([state["angle"] for state in loop.states]))


def nearest_to_walls(loop: Loop, plant: Plant, keeps: Sequence[Keep]) -> float | None:
    """Return how near a part came to the wall it is to keep away from, m, negative beyond; None where there is none."""
    angles = np.array([state["angle"] for state in loop.states])
    walls = [Wall.of(plant.scene, keep) for keep in keeps]
    return min((float(np.min(wall.along(angles))) - wall.offset for wall in walls), default=None)


def wanted_places(bench: Bench, samples: int) -> Array:
    """Return where the end of the arm would rest with its joints as they are to be, (samples, 2 or 3), m."""
    assert bench.course is not None
    fine = fine_scene(bench.scene, PLANT_LINKS)
    angles = bench.course.at(np.arange(samples))
    rows, back = np.unique(angles, axis=0, return_inverse=True)
    rests = np.array([rest_with(fine, row, "control.trajectory").angles for row in rows])
    return part_frame(fine, end_of(fine)).place(rests)[back.ravel()]
