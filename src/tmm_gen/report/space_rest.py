"""An arm in space in each of its static equilibria, as a picture."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from tmm_gen.modal.space.equilibria import SpaceEquilibria
from tmm_gen.report.space_motion import SpaceMotion
from tmm_gen.report.space_panels import space_panels
from tmm_gen.report.space_picture import on_ground
from tmm_gen.scene.spatial.arm import SpatialArm
from tmm_gen.style import PALETTE, picture

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_COLUMNS = 4


def space_rest_picture(arm: SpatialArm, title: str, held: SpaceEquilibria, form: str = "png") -> bytes:
    """Draw each equilibrium in a panel of its own, all to one scale, with its shadow.

    Parameters
    ----------
    arm : SpatialArm
        Whose base does not move.
    title : str
        Of its scene.
    held : SpaceEquilibria
        Of it.
    form : {"png", "svg", "pdf"}
        Format.
    """
    return picture(space_rest_figure(arm, title, held), form)


def space_rest_figure(arm: SpatialArm, title: str, held: SpaceEquilibria) -> Figure:
    """Return the figure that :func:`space_rest_picture` writes."""
    count = len(held.found)
    poses = np.concatenate([each.rest.posed() for each in held.found])
    motion = SpaceMotion(arm, np.arange(count, dtype=float), poses)
    points = motion.skeleton.points(motion.angles)
    tips = [tip.spot for tip in motion.skeleton.tips]
    with space_panels(motion, count, _COLUMNS, title) as panels:
        for number, (panel, each, place) in enumerate(zip(panels.axes, held.found, points, strict=True)):
            ground = panels.set_out(panel, f"{number + 1}:  {each.state}", points)
            colour = PALETTE[0 if each.stable else 1]
            for line in motion.skeleton.lines:
                on_ground(panel, motion, place[list(line)], ground)
                panel.plot(*place[list(line)].T, color=colour, linewidth=2.2)
            panel.plot(*place[tips].T, "o", color=colour, markersize=4.0)
        return panels.figure
