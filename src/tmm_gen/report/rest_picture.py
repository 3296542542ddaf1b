"""An arm in each of its static equilibria, as a picture."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from tmm_gen.modal.equilibria import Equilibria
from tmm_gen.scene import Scene
from tmm_gen.simulate.places import node_places, outline
from tmm_gen.style import FAINT, PALETTE, figure, picture, style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_COLUMNS = 4


def rest_picture(scene: Scene, held: Equilibria, form: str = "png") -> bytes:
    """Draw each equilibrium in a panel of its own, all to one scale.

    Parameters
    ----------
    scene : Scene
        Of kind "planar".
    held : Equilibria
        Of it.
    form : {"png", "svg", "pdf"}
        Format.
    """
    return picture(rest_figure(scene, held), form)


def rest_figure(scene: Scene, held: Equilibria) -> Figure:
    """Return the figure that :func:`rest_picture` writes."""
    columns = min(_COLUMNS, len(held.found))
    rows = -(-len(held.found) // columns)
    reach = 1.05 * sum(link.length for link in scene.links)
    with style():
        made, axes = figure(
            max(3.0 * columns, 5.0), 0.6 + 3.0 * rows, nrows=rows, ncols=columns, squeeze=False, sharey=True
        )
        for number, (panel, each) in enumerate(zip(axes.flat, held.found, strict=False), start=1):
            marker: Any = "o" if scene.stations <= 30 else None
            colour = PALETTE[0] if each.stable else PALETTE[1]
            places = node_places(scene, each.rest.angles[None])
            panel.plot(
                *(outline(scene, along[0]) for along in places),
                color=colour,
                marker=marker,
                markersize=3.5,
                zorder=3,
            )
            panel.plot(0.0, 0.0, marker="s", color=FAINT, markersize=9, zorder=2)
            panel.set(xlim=(-reach, reach), ylim=(-reach, reach), aspect="equal", xlabel="x (m)")
            panel.set_title(f"{number}:  {each.state}", fontsize=9.5, fontweight="normal")
        for panel in axes.flat[len(held.found) :]:
            panel.set_visible(False)
        for panel in axes[:, 0]:
            panel.set_ylabel("y (m)")
        made.suptitle(scene.title, x=0.01, ha="left", fontweight="bold", fontsize=11)
        return made
