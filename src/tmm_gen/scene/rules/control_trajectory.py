"""What ``[control.trajectory]`` and ``[[control.keep]]`` ask for can be had of an arm."""

from __future__ import annotations

from collections.abc import Iterator

from tmm_gen.scene.control import Control
from tmm_gen.scene.document import Document
from tmm_gen.scene.each import by_names
from tmm_gen.scene.parts.document import PartsDocument
from tmm_gen.scene.problem import Finding, Path
from tmm_gen.scene.table import closest

_TRAJECTORY: Path = ("control", "trajectory")


def moves_by_parts(document: Document) -> Iterator[Finding]:
    """Find a trajectory, or half-planes, of an arm that is not by parts."""
    if document.control is not None:
        yield from in_a_plane_by_parts(document.control)


def in_a_plane_by_parts(control: Control) -> Iterator[Finding]:
    """Find a trajectory, or half-planes, of another arm than a planar one by parts."""
    for path, there in ((_TRAJECTORY, control.trajectory), (("control", "keep"), control.keep)):
        if there:
            yield Finding(
                path,
                "is for planar arms whose motors are parts by name",
                "Remove the table, or write such an arm.",
            )


def can_be_followed(document: PartsDocument, control: Control, motors: tuple[str, ...]) -> Iterator[Finding]:
    """Find poses that are told twice or not at all, parts there are not, and angles beyond the bounds.

    Parameters
    ----------
    document : PartsDocument
        Of the arm.
    control : Control
        Which tells all that is told by name of all motors.
    motors : tuple of str
        Their names.
    """
    frames = tuple(part.name for part in document.expansion.parts if part.last)
    for index, keep in enumerate(control.keep):
        yield from _known(("control", "keep", index, "frame"), keep.frame, frames)
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
    yield from _known((*_TRAJECTORY, "frame"), way.frame, frames)
    for index, pose in enumerate(way.pose):
        path: Path = (*_TRAJECTORY, "pose", index)
        if (pose.frame is None) != (pose.position is None) or (pose.angles is None) == (pose.frame is None):
            yield Finding(
                path,
                "is told by `angles`, or by `frame` and `position`",
                "Write one of them, and that whole.",
            )
            continue
        yield from _known((*path, "frame"), pose.frame, frames)
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


def _known(path: Path, frame: str | None, frames: tuple[str, ...]) -> Iterator[Finding]:
    if frame is not None and frame not in frames:
        yield Finding(path, "is not the name of a beam, link or body", closest(frame, frames), frame)
