"""What ``[control.trajectory]`` and ``[[control.keep]]`` ask for can be had of an arm."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from tmm_gen.scene.control import Control
from tmm_gen.scene.document import Document
from tmm_gen.scene.each import by_names
from tmm_gen.scene.problem import Finding, Path
from tmm_gen.scene.table import closest
from tmm_gen.scene.trajectory import Keep, PoseEntry

_TRAJECTORY: Path = ("control", "trajectory")
_SOLID = "beam, link or body"
_NUMBERS = {2: "two", 3: "three"}
_SOMEWHERE = ("0.5", "-0.2", "0.3")


def moves_by_parts(document: Document) -> Iterator[Finding]:
    """Find a trajectory, or half-planes, of an arm that is not by parts."""
    control = document.control
    if control is None:
        return
    if control.trajectory:
        yield Finding(
            _TRAJECTORY,
            "is for arms whose motors are parts by name",
            "Remove the table, or write such an arm.",
        )
    if control.keep:
        yield Finding(
            ("control", "keep"),
            "is for arms whose motors are parts by name",
            "Remove the table, or write such an arm.",
        )


def can_be_kept(control: Control, frames: tuple[str, ...], axes: str) -> Iterator[Finding]:
    """Find walls of parts there are not, and normals of another dimension.

    Parameters
    ----------
    frames : tuple of str
        Names of the parts that move.
    axes : {"xy", "xyz"}
        Along which the arm moves.
    """
    kind = _kind(axes)
    for index, keep in enumerate(control.keep):
        path: Path = ("control", "keep", index)
        yield from _known((*path, "frame"), keep.frame, frames, kind)
        if len(keep.normal) != len(axes):
            upward = ", ".join("0.0" for _ in axes[1:])
            yield Finding(
                (*path, "normal"),
                f"must be {_NUMBERS[len(axes)]} numbers: {', '.join(axes)}",
                f"Write for example `[{upward}, 1.0]`: upward.",
                list(keep.normal),
            )
        yield from _beyond_another(control.keep[:index], keep, (*path, "offset"))


def _beyond_another(walls: Sequence[Keep], keep: Keep, path: Path) -> Iterator[Finding]:
    """Find that nothing is left of where a part is to stay, between a wall and one across from it."""
    normal = _unit(keep.normal)
    for number, other in enumerate(walls, 1):
        across = sum(a * b for a, b in zip(normal, _unit(other.normal), strict=False))
        if other.frame == keep.frame and len(other.normal) == len(normal) and across < 1e-12 - 1.0:
            edge = 0.0 - other.offset
            if keep.offset > edge:
                yield Finding(
                    path,
                    f"leaves '{keep.frame}' no place: control.keep[{number}] is across from it, and keeps to "
                    f"at most {edge:.12g} m along this normal",
                    f"Write an offset below {edge:.12g}, or turn one of the normals round.",
                    keep.offset,
                )


def _unit(normal: tuple[float, ...]) -> list[float]:
    longest = max(map(abs, normal))
    length = math.hypot(*(each / longest for each in normal))
    return [each / longest / length for each in normal]


def can_be_followed(
    control: Control, motors: tuple[str, ...], frames: tuple[str, ...], axes: str
) -> Iterator[Finding]:
    """Find poses that are told twice or not at all, parts there are not, and angles beyond the bounds.

    Parameters
    ----------
    control : Control
        Which tells all that is told by name of all motors.
    motors : tuple of str
        Their names.
    frames : tuple of str
        Names of the parts that move.
    axes : {"xy", "xyz"}
        Along which the arm moves.
    """
    way = control.trajectory
    if way is None:
        return
    if bool(way.pose) == (way.file is not None):
        problem = "has both a file and poses" if way.pose else "has neither a file nor poses"
        yield Finding(
            _TRAJECTORY, problem, "Write `file`, or [[control.trajectory.pose]] with `angles` and `duration`."
        )
        return
    if way.frame is not None and way.file is None:
        yield Finding(
            (*_TRAJECTORY, "frame"), "is of a file, and there is none", "Write it in each pose.", way.frame
        )
    if way.orientation and way.file is None:
        yield Finding(
            (*_TRAJECTORY, "orientation"), "is of a file, and there is none", "Write it in each pose.", True
        )
    elif way.orientation and way.frame is None:
        yield Finding(
            (*_TRAJECTORY, "orientation"),
            "is of a frame, and there is none",
            "Remove it, or write `frame`: the part whose positions and orientations the file has.",
            True,
        )
    kind = _kind(axes)
    yield from _known((*_TRAJECTORY, "frame"), way.frame, frames, kind)
    for index, pose in enumerate(way.pose):
        path: Path = (*_TRAJECTORY, "pose", index)
        if (pose.frame is None) != (pose.position is None) or (pose.angles is None) == (pose.frame is None):
            yield Finding(
                path,
                "is told by `angles`, or by `frame` and `position`",
                "Write one of them, and that whole.",
            )
            continue
        yield from _known((*path, "frame"), pose.frame, frames, kind)
        if pose.position is not None and len(pose.position) != len(axes):
            yield Finding(
                (*path, "position"),
                f"must be {_NUMBERS[len(axes)]} numbers: {', '.join(axes)}",
                f"Write for example `[{', '.join(_SOMEWHERE[: len(axes)])}]`, in m.",
                list(pose.position),
            )
        yield from _facing(pose, path, axes)
        if pose.angles is None or control.bounds.hub is None:
            continue
        for angle, (low, high) in zip(
            by_names(pose.angles, motors), by_names(control.bounds.hub, motors), strict=True
        ):
            if not low <= angle <= high:
                yield Finding(
                    (*path, "angles"),
                    f"is beyond control.bounds.hub, [{low:g}, {high:g}] rad",
                    "Widen the bounds, or set other angles.",
                    angle,
                )


def _facing(pose: PoseEntry, path: Path, axes: str) -> Iterator[Finding]:
    """Find an orientation of nothing, and one of another dimension."""
    if pose.orientation is None:
        return
    if pose.frame is None:
        yield Finding(
            (*path, "orientation"),
            "is of a frame, and there is none",
            "Remove it, or write `frame` and `position`.",
        )
    elif len(pose.orientation) != (1 if axes == "xy" else 4):
        must, example = (
            ("an angle in rad", "0.5")
            if axes == "xy"
            else ("a quaternion: w, x, y, z", "[1.0, 0.0, 0.0, 0.0]")
        )
        yield Finding(
            (*path, "orientation"),
            f"must be {must}",
            f"Write for example `{example}`.",
            list(pose.orientation),
        )


def _kind(axes: str) -> str:
    return "part that moves" if len(axes) == 3 else _SOLID


def _known(path: Path, frame: str | None, frames: tuple[str, ...], kind: str) -> Iterator[Finding]:
    if frame is not None and frame not in frames:
        yield Finding(path, f"is not the name of a {kind}", closest(frame, frames), frame)
