"""The course a scene's ``[control.trajectory]`` describes: joint angles, sample by sample."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.goals.file_way import file_way
from tmm_gen.control.goals.reach import Somewhere, rest_with_frame
from tmm_gen.control.goals.target import Target, require_within, rest_with
from tmm_gen.control.task.problem import ControlProblem
from tmm_gen.control.task.sample_count import require_countable
from tmm_gen.control.task.where import where
from tmm_gen.errors import UserError
from tmm_gen.scene import Scene
from tmm_gen.scene.each import by_names
from tmm_gen.scene.trajectory import Trajectory

Array = NDArray[np.float64]

_STOP = 5
"""Samples the reference stands still at least, to be a stop."""


@dataclass(frozen=True, eq=False)
class Course:
    """Where the joints are to be.

    Parameters
    ----------
    angles : array, (k, m)
        At each sample from time zero, rad; after the last it stays.
    """

    angles: Array

    def ahead(self, sample: int, count: int) -> Array:
        """Return the angles of so many samples after one, (count, m)."""
        return self.at(sample + 1 + np.arange(count))

    def at(self, samples: NDArray[np.int64]) -> Array:
        """Return the angles at samples, (len(samples), m)."""
        return self.angles[np.minimum(samples, len(self.angles) - 1)]

    def stops(self, samples: int) -> list[tuple[int, int]]:
        """Return from when until when the reference stands still, in samples, behind a motion and within a run."""
        moves = np.any(np.diff(self.at(np.arange(samples)), axis=0) != 0.0, axis=1)
        edges = np.flatnonzero(np.diff(np.concatenate([[True], moves, [True]]).astype(int)))
        spans = [(int(first), int(last)) for first, last in zip(edges[::2], edges[1::2], strict=True)]
        return [(first, last) for first, last in spans if first > 0 and last - first >= _STOP]


def course_of(scene: Scene, problem: ControlProblem) -> Course | None:
    """Return the course that a scene describes; None where it has a reference alone.

    Raises
    ------
    UserError
        If a position is out of reach, the motors cannot hold the arm somewhere, or a file cannot be read.
    """
    way = scene.control.trajectory if scene.control is not None else None
    if way is None:
        return None
    if way.file is not None:
        folder = Path(scene.source.origin.partition(" (with ")[0]).parent  # of a scene that was changed too
        return _from_file(scene, problem, way, folder / way.file)
    return Course(np.vstack(list(_quintics(scene, problem, way))))


def begins_elsewhere(scene: Scene, problem: ControlProblem, course: Course) -> str | None:
    """Return what is said of joints that start elsewhere than the file of a course says, if any: the reference jumps.

    They are those that are off by more than the course moves in any sample, and an encoder tells.
    """
    way = scene.control.trajectory if scene.control is not None else None
    if way is None or way.file is None:
        return None
    off = course.angles[0] - problem.start
    steps = np.max(np.abs(np.diff(course.angles, axis=0)), axis=0, initial=0.0)
    jumps = np.abs(off) > np.maximum(steps, 2.0 * np.pi / problem.encoders)
    if not np.any(jumps):
        return None
    said = [
        f"'{problem.motors.names[motor]}' at {course.angles[0, motor]:.4g} rad ({abs(off[motor]):.3g} rad away)"
        for motor in np.flatnonzero(jumps)
    ]
    # rounded to what no encoder tells, and no zero has a sign
    begin = ", ".join(
        f"{name} = {round(angle, 6) + 0.0:.7g}" for name, angle in _initial(scene, problem, course.angles[0])
    )
    return (
        f"{where(scene, 'control.trajectory.file')}: '{way.file}' begins elsewhere than the arm starts: "
        f"{', '.join(said)}. The reference jumps there at once. Set `angles = {{ {begin} }}` under [initial], or let "
        "the file begin where the arm starts."
    )


def _initial(scene: Scene, problem: ControlProblem, hub: Array) -> Iterator[tuple[str, float]]:
    """Yield what ``initial.angles`` says for hubs somewhere: in a plane of beams and links, in space of motors."""
    if scene.spatial is not None:
        yield from zip(problem.motors.names, hub.tolist(), strict=True)
        return
    angles = problem.motors.turned @ hub
    for part in scene.parts:
        if part.kind in ("beam", "link"):
            yield part.name, float(angles[part.last - 1])


def _quintics(scene: Scene, problem: ControlProblem, way: Trajectory) -> Iterator[Array]:
    """Yield the angles at all samples, stretch by stretch: from pose to pose, and the rests there."""
    require_countable(scene, sum(pose.duration + pose.dwell for pose in way.pose), problem.sample_time)
    begin, now, sample = problem.start, 0.0, 0
    for number, pose in enumerate(way.pose, 1):
        key = f"control.trajectory.pose[{number}]"
        if pose.angles is not None:
            target = rest_with(scene, np.array(by_names(pose.angles, problem.motors.names)), key)
            _require_room(scene, problem, target, key)
        else:
            assert pose.frame is not None
            assert pose.position is not None
            facing = None if pose.orientation is None else np.array(pose.orientation)
            there = Somewhere(pose.frame, np.array(pose.position), facing)
            target = _reached(scene, problem, there, begin, f"{key}.position")
        end = now + pose.duration + pose.dwell
        count = int(np.ceil(end / problem.sample_time - 1e-9)) - sample
        last = number == len(way.pose)
        instants = problem.sample_time * (sample + np.arange(count + last))
        # rounded, since it stands still exactly where it stands still
        t = np.clip(np.round((instants - now) / pose.duration, 12), 0.0, 1.0)[:, None]
        yield begin + (target.goal.hub - begin) * t**3 * (10.0 - 15.0 * t + 6.0 * t**2)
        begin, now, sample = target.goal.hub, end, sample + count


def _from_file(scene: Scene, problem: ControlProblem, way: Trajectory, path: Path) -> Course:
    """Return the course that a CSV file tells, by joint angles or by where a part is to be."""
    read = file_way(scene, problem, way, path)
    told = read.told
    if way.frame is None:
        for row in (told[0], told[-1]):
            _require_room(scene, problem, rest_with(scene, row, path.name), path.name)
        return Course(told)
    angles, before = np.zeros((len(told), problem.count)), problem.start
    for row, there, now in zip(angles, read.places(), read.instants, strict=True):
        key = f"{path.name}, t = {now:g} s"
        before = row[:] = _reached(scene, problem, there, before, key).goal.hub
    return Course(angles)


def _reached(scene: Scene, problem: ControlProblem, there: Somewhere, before: Array, key: str) -> Target:
    """Return the rest with a part somewhere, bent as before or else as at the scene's reference."""
    starts = [before, problem.reference]
    # a stretched arm could bend either way: as at the reference
    if np.max(np.abs(before - problem.start)) == 0.0:
        starts.reverse()
    target = rest_with_frame(scene, there, starts, key)
    _require_room(scene, problem, target, key)
    return target


def _require_room(scene: Scene, problem: ControlProblem, target: Target, key: str) -> None:
    """Refuse torques that the motors cannot give, and angles that joints have no room for."""
    require_within(scene, problem, target, key)
    for name, angle, bounds in zip(problem.motors.names, target.goal.hub, problem.hub, strict=True):
        if bounds is not None and not bounds[0] <= angle <= bounds[1]:
            whose = "control.bounds.hub" if scene.spatial is None else "its limits or control.bounds.hub"
            raise UserError(
                f"{where(scene, key)}: the joint of motor '{name}' would be at {angle:.4g} rad, beyond "
                f"{whose}, [{bounds[0]:g}, {bounds[1]:g}]. Widen the bounds, or take another position."
            )
