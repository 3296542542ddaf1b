"""An arm in motion: GIF or self-contained HTML, and its shapes over time for still pictures."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tmm_gen.inputs.signals import Table
from tmm_gen.reference.floating import base_place
from tmm_gen.reference.planar_arm import Arm
from tmm_gen.report.film import FRAMES_PER_SECOND, film
from tmm_gen.report.spread import spread
from tmm_gen.scene import Scene
from tmm_gen.simulate.places import ends, node_places, outline
from tmm_gen.simulate.simulation import Simulation
from tmm_gen.style import FAINT, INK, PALETTE, figure, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = NDArray[np.float64]

MOST_FRAMES = 250
"""Longer motions are shown faster than they are."""

SHAPES = 12
"""Positions of the arm in a still picture."""


def link_angles(simulation: Simulation) -> Array:
    """Return the traced angles of the links, (k + 1, n).

    Raises
    ------
    ValueError
        If the motion was not traced.
    """
    if simulation.trace is None:
        raise ValueError("the motion was not traced")
    return simulation.trace.angle[:, -simulation.scene.stations :]


def _places(simulation: Simulation) -> tuple[Array, Array]:
    """Return where base and outer ends are, (k + 1, n + 1) along x and y."""
    scene, trace = simulation.scene, simulation.trace
    x, y = node_places(scene, link_angles(simulation))
    if scene.floats and trace is not None:
        signals = {name: Table(simulation.time, values) for name, values in simulation.inputs.items()}
        still = np.zeros_like(trace.angle)
        base = base_place(Arm(scene, signals), 0, simulation.time, trace.angle, still, still)
        x, y = (places + along[:, None] for places, along in zip((x, y), base, strict=True))
    return x, y


def frame_instants(simulation: Simulation) -> tuple[NDArray[np.int64], float]:
    """Return which instants are shown, (frames,), and how many times faster than they pass."""
    duration = float(simulation.time[-1])
    frames = int(min(MOST_FRAMES, max(2, round(duration * FRAMES_PER_SECOND)), len(simulation.time)))
    shown = spread(simulation.time, frames)
    return shown, duration / ((len(shown) - 1) / FRAMES_PER_SECOND)


def animation(simulation: Simulation, form: str) -> bytes:
    """Draw the motion of an arm.

    Parameters
    ----------
    simulation : Simulation
        Of a planar scene, traced.
    form : {"gif", "html"}
        An endless GIF, or a page with buttons that needs nothing else.
    """
    scene = simulation.scene
    shown, speed = frame_instants(simulation)
    x, y = _places(simulation)
    lines, tips = [outline(scene, places) for places in (x, y)], list(ends(scene))
    with style():
        made, axes = figure(5.6, 5.2)
        _ground(axes, scene, x[shown], y[shown])
        base = [*axes.lines]  # it may hide the arm
        axes.set_title(scene.title)
        paths = [axes.plot([], [], color=PALETTE[5], linewidth=1.2, zorder=1)[0] for _ in tips]
        (arm,) = axes.plot(
            [],
            [],
            color=PALETTE[0],
            linewidth=3.0,
            solid_capstyle="round",
            marker="o",
            markersize=_dots(scene),
        )
        (hub,) = axes.plot([], [], "s", color=INK, markersize=9.0)
        (tip,) = axes.plot([], [], "o", color=PALETTE[1], markersize=9.0 if scene.tip else 5.0, zorder=4)
        faster = "" if abs(speed - 1.0) < 0.05 else f", shown {speed:.2g} times as fast"
        clock = axes.text(0.02, 0.98, "", transform=axes.transAxes, va="top", color=INK)

        def draw(index: int) -> None:
            k = shown[index]
            arm.set_data(lines[0][k], lines[1][k])
            tip.set_data(x[k, tips], y[k, tips])
            if scene.floats:
                hub.set_data(x[k, :1], y[k, :1])
            for path, number in zip(paths, tips, strict=True):
                path.set_data(x[: k + 1, number], y[: k + 1, number])
            clock.set_text(f"{simulation.time[k]:.2f} s{faster}")

        moving = sorted((*base, *paths, arm, hub, tip, clock), key=lambda artist: artist.get_zorder())
        return film(made, moving, draw, len(shown), form, scene.title)


def draw_shapes(axes: Axes, simulation: Simulation) -> None:
    """Draw the arm at instants spread over the motion, the later the darker, and the way of its tips."""
    import matplotlib as mpl
    from matplotlib.patheffects import withStroke

    scene = simulation.scene
    x, y = _places(simulation)
    shown = spread(simulation.time, SHAPES)
    _ground(axes, scene, x, y)
    colours = mpl.colormaps["Blues"](np.linspace(0.25, 1.0, len(shown)))
    tips, line = list(ends(scene)), [outline(scene, places) for places in (x, y)]
    axes.plot(x[:, tips], y[:, tips], color=PALETTE[4], linewidth=1.0, zorder=1)
    for k, colour in zip(shown, colours, strict=True):
        axes.plot(line[0][k], line[1][k], color=colour, linewidth=2.0)
        axes.plot(x[k, tips], y[k, tips], "o", color=colour, markersize=6.0 if scene.tip else 3.5)
        if scene.floats:
            axes.plot(x[k, 0], y[k, 0], "s", color=colour, markersize=7.0)
    dark = mpl.colormaps["Blues"]([0.6, 1.0])
    for k, colour in ((shown[0], dark[0]), (shown[-1], dark[1])):
        out = np.array([x[k, -1] - x[k, 0], y[k, -1] - y[k, 0]])
        # away from the base, where no way of a tip is
        aside = 9.0 * out / max(float(np.linalg.norm(out)), 1e-12)
        told = axes.annotate(
            f"{simulation.time[k]:.3g} s",
            (x[k, -1], y[k, -1]),
            tuple(aside),
            textcoords="offset points",
            color=colour,
            ha="left" if aside[0] > 2.0 else "right" if aside[0] < -2.0 else "center",
            va="bottom" if aside[1] > 2.0 else "top" if aside[1] < -2.0 else "center",
        )
        told.set_path_effects([withStroke(linewidth=2.0, foreground="white")])


def _ground(axes: Axes, scene: Scene, x: Array, y: Array) -> None:
    """Set out a field in true proportion, with the base in it."""
    reach = scene.reach
    left, right = float(min(x.min(), -0.1 * reach)), float(max(x.max(), 0.1 * reach))
    low, high = float(min(y.min(), -0.1 * reach)), float(max(y.max(), 0.1 * reach))
    margin = 0.12 * reach
    axes.set_xlim(left - margin, right + margin)
    axes.set_ylim(low - margin, high + margin)
    axes.set_aspect("equal", adjustable="box")
    axes.set_xlabel("x (m)")
    axes.set_ylabel("y (m)")
    if not scene.base.moves:
        # a wall across the first link, so that an arm which stands upright can be seen before it
        across = 0.07 * reach * np.array([-np.sin(scene.initial.angles[0]), np.cos(scene.initial.angles[0])])
        axes.plot([-across[0], across[0]], [-across[1], across[1]], color=INK, linewidth=5.0, zorder=3)
    elif not scene.floats:
        axes.plot(
            0.0, 0.0, "o", color="white", markeredgecolor=INK, markeredgewidth=2.0, markersize=13, zorder=3
        )
    if scene.model.gravity:
        axes.annotate(
            "", (0.96, 0.86), (0.96, 0.97), "axes fraction", arrowprops={"arrowstyle": "->", "color": FAINT}
        )
        axes.text(0.945, 0.915, "g", transform=axes.transAxes, ha="right", va="center", color=FAINT)


def _dots(scene: Scene) -> float:
    return 4.0 if scene.stations <= 20 else 0.0
