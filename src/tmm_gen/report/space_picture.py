"""An arm in space on paper: at some instants in one field, or as a GIF."""

from __future__ import annotations

from textwrap import fill
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.report.animate import SHAPES, frame_instants
from tmm_gen.report.film import film
from tmm_gen.report.space_labels import AZIMUTH, ELEVATION, STILL, Lettering, letter
from tmm_gen.report.space_motion import SpaceMotion, space_motion
from tmm_gen.simulate.simulation import Simulation
from tmm_gen.style import FAINT, INK, PALETTE, figure, style

Array = NDArray[np.float64]

_TRACED = 2000
"""Instants along the way of a tip."""

_LINE = 56
"""Letters that fit above a GIF."""

_SHADOW = "#d6d9df"


def draw_arm(axes: Any, motion: SpaceMotion) -> None:
    """Draw the arm at instants spread over the motion, the later the darker, its shadow, and the way of its tips.

    Parameters
    ----------
    axes : Axes3D
        Made with ``projection="3d"``, in a block of :func:`tmm_gen.style.style`.
    motion : SpaceMotion
        Where its joints are over time.
    """
    import matplotlib as mpl
    from matplotlib.patheffects import withStroke

    skeleton, shown, along = motion.skeleton, motion.thinned(SHAPES), motion.thinned(_TRACED)
    points, way = shown.points, along.points
    ground = set_out(axes, motion, way)
    colours = mpl.colormaps["Blues"](np.linspace(0.25, 1.0, len(points)))
    tips = [tip.spot for tip in skeleton.tips]
    for spot in tips:
        axes.plot(*way[:, spot].T, color=PALETTE[4], linewidth=1.0)
    for place, colour in zip(points, colours, strict=True):
        for line in skeleton.lines:
            on_ground(axes, motion, place[list(line)], ground, linewidth=1.0)
            axes.plot(*place[list(line)].T, color=colour, linewidth=2.0)
        axes.plot(*place[tips].T, "o", color=colour, markersize=4.0)
    if not tips:
        return
    widest = max(tips, key=lambda spot: float(np.max(np.ptp(way[:, spot], axis=0))))
    dark = mpl.colormaps["Blues"]([0.6, 1.0])
    for k in (0, -1):
        told = axes.text(
            *points[k, widest], f"  {shown.time[k]:.3g} s", color=dark[k], fontsize=9, zorder=100
        )
        told.set_path_effects([withStroke(linewidth=2.0, foreground="white")])


def space_gif(simulation: Simulation) -> bytes:
    """Return an endless GIF of a simulation.

    Parameters
    ----------
    simulation : Simulation
        Of an arm in space, traced.

    Raises
    ------
    ValueError
        If the motion was not traced.
    """
    motion = space_motion(simulation)
    skeleton = motion.skeleton
    shown, speed = frame_instants(simulation)
    along = motion.thinned(_TRACED)
    points, way = motion.points[shown], along.points
    passed = np.searchsorted(along.time, motion.time[shown], side="right")
    faster = "" if abs(speed - 1.0) < 0.05 else f", shown {speed:.2g} times as fast"
    with style():
        made, axes = figure(5.6, 5.2, subplot_kw={"projection": "3d"})
        ground = set_out(axes, motion, way)
        axes.set_title(fill(simulation.scene.title, _LINE), loc="left")
        below = [on_ground(axes, motion, points[0, list(line)], ground) for line in skeleton.lines]
        ways = [axes.plot([], [], [], color=PALETTE[5], linewidth=1.2)[0] for _ in skeleton.tips]
        limbs = [
            axes.plot([], [], [], color=PALETTE[0], linewidth=3.0, solid_capstyle="round")[0]
            for _ in skeleton.lines
        ]
        ends = [axes.plot([], [], [], "o", color=PALETTE[1], markersize=6.0)[0] for _ in skeleton.tips]
        clock = axes.text2D(0.02, 0.98, "", transform=axes.transAxes, va="top", color=INK)

        def draw(index: int) -> None:
            place = points[index]
            for limb, shadow, line in zip(limbs, below, skeleton.lines, strict=True):
                limb.set_data_3d(*place[list(line)].T)
                shadow.set_data_3d(*_lowered(motion, place[list(line)], ground).T)
            for path, end, tip in zip(ways, ends, skeleton.tips, strict=True):
                path.set_data_3d(*way[: passed[index], tip.spot].T)
                end.set_data_3d(*place[[tip.spot]].T)
            clock.set_text(f"{motion.time[shown[index]]:.2f} s{faster}")

        moving = (*below, *ways, *limbs, *ends, clock)
        return film(made, moving, draw, len(shown), "gif", simulation.scene.title)


def set_out(
    axes: Any, motion: SpaceMotion, points: Array, narrowest: float = 0.3, lettering: Lettering = STILL
) -> float:
    """Set out a field in true proportion with the base in it; return where the ground is along the upward axis.

    Parameters
    ----------
    axes : Axes3D
        Made with ``projection="3d"``.
    motion : SpaceMotion
        Of the arm that is drawn.
    points : array, (k, m, 3)
        All that is to be seen, m.
    narrowest : float
        Least side of the field, as a share of the arm's reach.
    lettering : Lettering
        Of names and numbers along its sides.
    """
    margin, least = 0.05 * motion.reach, narrowest * motion.reach
    low, high = points.min(axis=(0, 1)) - margin, points.max(axis=(0, 1)) + margin
    wider = np.maximum(least - (high - low), 0.0) / 2.0  # of what moves in a plane
    low, high = low - wider, high + wider
    upward, sign = motion.upward
    lowest = min(0.0, sign * float((low if sign > 0 else high)[upward]) + margin)
    ground = sign * (lowest - margin if lowest < 0.0 else 0.0)
    (low if sign > 0 else high)[upward] = ground
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    axes.view_init(sign * ELEVATION, AZIMUTH, 0.0 if sign > 0 else 180.0, "xyz"[upward])
    axes.set_box_aspect(high - low, zoom=lettering.field)  # in the order that the view has made known
    longest = float(np.max(high - low))
    for name, axis, span in zip("xyz", (axes.xaxis, axes.yaxis, axes.zaxis), high - low, strict=True):
        axis.set_label_text(f"{name} (m)")
        axis.set_pane_color((1.0, 1.0, 1.0, 0.0))
        few = max(1, round(lettering.count * float(span) / longest))  # labels of a narrow field would overlap
        axis.get_major_locator().set_params(nbins=few, min_n_ticks=1)
    letter(axes, upward, high - low, lettering)
    foot = 0.05 * motion.reach * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [-1, -1]])
    plate = np.zeros((5, 3))
    plate[:, [axis for axis in range(3) if axis != upward]] = foot
    axes.plot(*plate.T, color=FAINT, linewidth=1.5)
    return ground


def _lowered(motion: SpaceMotion, points: Array, ground: float) -> Array:
    """Return where the shadows of points are."""
    lowered = points.copy()
    lowered[..., motion.upward[0]] = ground
    return lowered


def on_ground(axes: Any, motion: SpaceMotion, points: Array, ground: float, linewidth: float = 2.0) -> Any:
    """Draw the shadow of a line."""
    return axes.plot(*_lowered(motion, points, ground).T, color=_SHADOW, linewidth=linewidth)[0]
