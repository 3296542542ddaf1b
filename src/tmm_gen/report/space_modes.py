"""Mode shapes of an arm in space, as a picture."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.modes import Mode
from tmm_gen.modal.space.situation import RestingArm
from tmm_gen.reference.spatial_afloat import AfloatArm
from tmm_gen.reference.spatial_places import Tree, applied
from tmm_gen.report.space_motion import SpaceMotion
from tmm_gen.report.space_panels import space_panels
from tmm_gen.report.space_picture import on_ground
from tmm_gen.scene.spatial.arm import ZERO, SpatialArm, Vector
from tmm_gen.style import FAINT, PALETTE, picture

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = NDArray[np.float64]

_COLUMNS = 3
_SWING = 0.16
"""Largest way of a point in a drawn mode, relative to the arm's reach."""
_TURN = 0.8
"""Largest turn of a body in it, rad."""
_RUNG = 0.05
"""Half the length of a rung across a beam, relative to the reach."""


def space_mode_picture(resting: RestingArm, modes: Sequence[Mode], form: str = "png") -> bytes:
    """Draw mode shapes, one panel each: the arm at rest, and to both sides of it.

    Beams and tips carry rungs across, along their own y axes, so that twisting shows, and the arm casts a shadow.

    Parameters
    ----------
    resting : RestingArm
        What swings.
    modes : sequence of Mode
        Its modes.
    form : {"png", "svg", "pdf"}
        Format.
    """
    return picture(space_mode_figure(resting, modes), form)


def space_mode_figure(resting: RestingArm, modes: Sequence[Mode]) -> Figure:
    """Return the figure that :func:`space_mode_picture` writes."""
    arm, still = resting.arm, resting.still
    motion = SpaceMotion(arm, np.zeros(1), still.posed())
    rungs_of = _rungs_of(motion)
    with space_panels(motion, len(modes), _COLUMNS, resting.scene.title) as panels:
        for number, (panel, mode) in enumerate(zip(panels.axes, modes, strict=True), start=1):
            poses = still.posed(np.outer([0.0, 1.0, -1.0], _swing(resting, motion, mode) * mode.shape))
            points, rungs = (
                motion.skeleton.points(poses),
                _rungs(arm, poses, rungs_of, _RUNG * motion.reach),
            )
            ground = panels.set_out(
                panel, _title(number, mode), np.concatenate([points, rungs.reshape(3, -1, 3)], axis=1)
            )
            looks: list[dict[str, Any]] = [
                {"color": FAINT, "linewidth": 1.2, "alpha": 1.0},
                {"color": PALETTE[0], "linewidth": 2.0, "alpha": 1.0},
                {"color": PALETTE[0], "linewidth": 1.2, "alpha": 0.4},
            ]
            for place, across, look in zip(points, rungs, looks, strict=True):
                for line in motion.skeleton.lines:
                    if look["alpha"] == 1.0:
                        on_ground(panel, motion, place[list(line)], ground, linewidth=look["linewidth"])
                    panel.plot(*place[list(line)].T, **look)
                for rung in across:
                    panel.plot(*rung.T, **{**look, "linewidth": 0.8})
        return panels.figure


def _title(number: int, mode: Mode) -> str:
    text = f"{mode.hertz:.4g} Hz" if mode.frequency else mode.motion
    return f"{number}:  {text}" + (f", ζ = {mode.damping_ratio:.2g}" if mode.damping_ratio else "")


def _swing(resting: RestingArm, motion: SpaceMotion, mode: Mode) -> float:
    """Return by how much of its shape a mode is drawn: far enough to be seen, not so far that small motion is none."""
    small, still = 1e-4, resting.still
    before, after = motion.skeleton.points(still.posed(np.outer([0.0, small], mode.shape)))
    moved = float(np.max(np.linalg.norm(after - before, axis=1))) / small
    turns = still.turns @ mode.shape[6:] + still.carried[:, 3:] @ mode.shape[:6]
    turned = float(np.max(np.linalg.norm(turns, axis=1)))
    bounds = [limit / size for limit, size in ((_SWING * motion.reach, moved), (_TURN, turned)) if size > 0.0]
    return min(bounds, default=1.0)


@dataclass(frozen=True)
class _Rung:
    """A line across, through a point of a body and along an axis fixed in it."""

    body: int
    at: Vector
    along: Vector


def _rungs_of(motion: SpaceMotion) -> list[_Rung]:
    """Return rungs across each cell of a beam, whose last frame lies along it, and across each tip."""
    arm = motion.arm
    parts = {frame.name for frame in arm.frames}
    found = []
    for number, joint in enumerate(arm.joints, start=1):
        behind = [other for other in arm.joints if other.host == number]
        same = any(other.at == ZERO and other.name not in parts for other in behind)
        if joint.name not in parts and not same:
            found.append(_Rung(number - 1, ZERO, (0.0, 1.0, 0.0)))
    tips = {tip.name for tip in motion.skeleton.tips}
    for frame in (each for each in arm.frames if each.name in tips and each.joint):
        x, y, z = (row[1] for row in frame.turn)
        found.append(_Rung(frame.joint - 1, frame.at, (x, y, z)))
    return found


def _rungs(arm: SpatialArm, poses: Array, rungs: list[_Rung], half: float) -> Array:
    """Return both ends of each rung, (k, rungs, 2, 3), m."""
    places = (AfloatArm(arm) if arm.base else Tree(arm)).places(poses)
    bodies = [rung.body for rung in rungs]
    turn = places.turn[:, bodies]
    at, along = (np.array([getattr(rung, name) for rung in rungs]).reshape(-1, 3) for name in ("at", "along"))
    point = places.point[:, bodies] + applied(turn, at)
    across = half * applied(turn, along)
    found: Array = np.stack([point - across, point + across], axis=2)
    return found
