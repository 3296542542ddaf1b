"""A simulation as a picture: the arm if it has a shape, a panel for each unit of the outputs, the inputs below."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tmm_gen.report.animate import draw_shapes
from tmm_gen.report.space_motion import space_motion
from tmm_gen.report.space_picture import draw_arm
from tmm_gen.scene.columns import output_columns
from tmm_gen.scene.quantity import INPUT_UNITS
from tmm_gen.simulate.simulation import Simulation
from tmm_gen.style import LEGEND_COLUMNS, PALETTE, panelled, picture, style, subtitle

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Array = NDArray[np.float64]

_LINES = ("-", "--", ":", "-.")


def response_picture(simulation: Simulation, form: str = "png") -> bytes:
    """Draw a simulation.

    Parameters
    ----------
    simulation : Simulation
        What to draw.
    form : {"png", "svg", "pdf"}
        Format.
    """
    return picture(response_figure(simulation), form)


def response_figure(simulation: Simulation) -> Figure:
    """Return the figure that :func:`response_picture` writes."""
    with style():
        return _drawn(simulation)


def _drawn(simulation: Simulation) -> Figure:
    scene = simulation.scene
    columns = output_columns(scene)
    units = list(dict.fromkeys(column.unit for column in columns))
    acting = [item for item in scene.inputs if np.any(simulation.inputs[item.name])]
    ratios = [3.0] * len(units) + [1.2] * bool(acting)
    shaped, in_space = simulation.trace is not None and not scene.model.linear, scene.spatial is not None
    size = (12.0, max(5.0, 1.1 + 0.78 * sum(ratios))) if shaped else (8.0, 1.1 + 0.78 * sum(ratios))
    made, panels, arm = panelled(*size, ratios, beside=shaped, in_space=in_space)
    if shaped:
        if in_space:
            draw_arm(arm, space_motion(simulation))
        else:
            draw_shapes(arm, simulation)
        subtitle(arm, "the arm over time", "the later the darker")
    for panel, unit in zip(panels, units, strict=False):
        shown = [column for column in columns if column.unit == unit]
        _curves(panel, simulation.time, {column.name: simulation.outputs[column.name] for column in shown})
        panel.set_ylabel(f"{shown[0].quantity.axis} ({unit.replace('^2', '²')})")
    if acting:
        _curves(panels[-1], simulation.time, {item.name: simulation.inputs[item.name] for item in acting})
        acts = dict.fromkeys(INPUT_UNITS[item.acts] for item in acting)
        panels[-1].set_ylabel(f"input ({', '.join(acts)})")
        panels[-1].update_datalim([(0.0, 0.0)])
        panels[-1].margins(y=0.3)
        panels[-1].autoscale_view()
    step = f"{scene.integrator.name}, step {scene.integrator.step:g} s, {simulation.backend} kernel"
    subtitle(panels[0], scene.title, step)
    panels[-1].set_xlabel("time (s)")
    panels[-1].set_xlim(0.0, simulation.time[-1])
    made.align_ylabels(panels)
    return made


def _curves(panel: Axes, time: Array, values: Mapping[str, Array]) -> None:
    for k, (name, curve) in enumerate(values.items()):
        panel.plot(
            time, curve, color=PALETTE[k % len(PALETTE)], linestyle=_LINES[k // len(PALETTE) % 4], label=name
        )
    columns = min(len(values), LEGEND_COLUMNS)
    panel.legend(loc="lower right", ncols=columns, bbox_to_anchor=(1.0, 1.0), borderaxespad=0.2)
