"""The picture of the arm's demonstration: the motion, accuracy against cost, and what an accuracy takes in C."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tmm_gen.report.animate import draw_shapes
from tmm_gen.report.arm_demo import DURATION, ArmDemo
from tmm_gen.style import INK, PALETTE, picture, style, subtitle

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def arm_demo_picture(demo: ArmDemo, error: float) -> bytes:
    """Draw a demonstration as a PNG.

    Parameters
    ----------
    demo : ArmDemo
        What was found.
    error : float
        mm; the accuracy whose cost is shown by bars.
    """
    with style():
        return picture(_drawn(demo, error), "png")


def _drawn(demo: ArmDemo, error: float) -> Figure:
    from matplotlib.figure import Figure

    made = Figure(figsize=(12.0, 6.4), layout="constrained")
    grid = made.add_gridspec(2, 2, height_ratios=[2.0, 1.0], width_ratios=[1.0, 1.25])
    arm, costs, bars = (made.add_subplot(grid[place]) for place in ((slice(None), 0), (0, 1), (1, 1)))
    draw_shapes(arm, demo.simulation)
    subtitle(arm, "Two motors lift a payload", f"{DURATION:g} s of motion, the later the darker")
    colours = dict(zip(dict.fromkeys(point.integrator for point in demo.points), PALETTE, strict=False))
    _accuracy_against_cost(costs, demo, error, colours)
    _what_c_takes(bars, demo.times_for(error), error, colours)
    return made


def _accuracy_against_cost(axes: Axes, demo: ArmDemo, error: float, colours: dict[str, str]) -> None:
    for name, colour in colours.items():
        own = [point for point in demo.points if point.integrator == name]
        axes.plot(
            [p.time for p in own], [p.error for p in own], "o-", color=colour, label=name, markersize=4.5
        )
    axes.axhline(error, color=INK, linewidth=0.9, linestyle=(0, (4, 3)))
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("time of a second of motion, compiled C (ms)")
    axes.set_ylabel("largest error of the payload (mm)")
    subtitle(axes, "Accuracy against cost", "a point for each step; against SciPy on equations of its own")
    axes.legend(loc="upper right")


def _what_c_takes(axes: Axes, times: dict[str, float], error: float, colours: dict[str, str]) -> None:
    names = list(times)[::-1]
    axes.barh(names, [times[name] for name in names], color=[colours[name] for name in names], height=0.6)
    for place, name in enumerate(names):
        told = f"{times[name]:.2f} ms: {float(f'{1e3 / times[name]:.2g}'):.0f} times faster than the arm"
        axes.annotate(told, (times[name], place), (5, 0), textcoords="offset points", va="center")
    axes.set_xlim(0.0, 2.0 * max(times.values(), default=1.0))
    axes.grid(visible=False)
    axes.set_xlabel("time of a second of motion, compiled C (ms)")
    subtitle(axes, f"What an error of {error:g} mm takes", "where the lines above cross the dashed one")
