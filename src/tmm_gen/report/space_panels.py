"""Fields of three axes beside and below each other, all to one scale."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from numpy.typing import NDArray

from tmm_gen.report.space_labels import PANEL
from tmm_gen.report.space_motion import SpaceMotion
from tmm_gen.report.space_picture import set_out
from tmm_gen.style import figure, style

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.figure import Figure

_LABEL = 0.15
"""Of an axis, beside a panel; inches."""
_SIDE = 3.0
"""Inches."""
_NARROWEST = 0.7


class SpacePanels:
    """Panels of one picture.

    Parameters
    ----------
    motion : SpaceMotion
        Of the arm that is drawn.
    count : int
        How many.
    columns : int
        How many at most stand beside each other.
    title : str
        Above them.
    """

    def __init__(self, motion: SpaceMotion, count: int, columns: int, title: str) -> None:
        self._motion = motion
        beside = min(columns, count)
        rows = -(-count // beside)
        made, axes = figure(
            max(_SIDE * beside, 5.0),
            0.6 + _SIDE * rows,
            nrows=rows,
            ncols=beside,
            squeeze=False,
            subplot_kw={"projection": "3d"},
        )
        self._made: Figure = made
        # room for the labels of the upward axis, of which the layout knows nothing
        made.set_layout_engine(
            "constrained", wspace=0.08, rect=(0.0, 0.0, 1.0 - _LABEL / made.get_figwidth(), 1.0)
        )
        self.axes = list(axes.flat)[:count]
        for panel in axes.flat[count:]:
            self._made.delaxes(panel)  # an unseen one has no place in the layout
        self._made.suptitle(title, x=0.01, ha="left", fontweight="bold", fontsize=11)

    def set_out(self, panel: Any, title: str, points: NDArray[np.float64]) -> float:
        """Set out a panel in which all points are seen; return where the ground is along the upward axis."""
        ground = set_out(panel, self._motion, points, _NARROWEST, PANEL)
        panel.set_title(title, fontsize=9.5, fontweight="normal")
        for name, axis in zip("xyz", (panel.xaxis, panel.yaxis, panel.zaxis), strict=True):
            axis.set_label_text(name)
        return ground

    @property
    def figure(self) -> Figure:
        """The whole picture."""
        return self._made


@contextmanager
def space_panels(motion: SpaceMotion, count: int, columns: int, title: str) -> Iterator[SpacePanels]:
    """Yield panels to draw in."""
    with style():
        yield SpacePanels(motion, count, columns, title)
