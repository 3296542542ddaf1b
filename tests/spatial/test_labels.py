"""Names and numbers along fields in space: none touches another or leaves its panel, however flat or high the field."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.transforms import Bbox
from support.spatial.random_arms import random_arm

from tmm_gen.report.space_motion import SpaceMotion
from tmm_gen.report.space_panels import space_panels


@pytest.mark.parametrize(
    "sides",
    [(1.0, 1.0, 1.0), (2.0, 0.0, 0.0), (0.0, 2.0, 0.0), (0.0, 0.0, 2.0), (2.0, 2.0, 0.0), (2.0, 0.0, 2.0)],
    ids=["cube", "along x", "along y", "high", "flat", "in a plane"],
)
def test_nothing_touches(sides: tuple[float, float, float]) -> None:
    arm = replace(random_arm(1, 3, loads=False), gravity=(0.0, 0.0, -9.81))
    motion = SpaceMotion(arm, np.zeros(1), np.zeros((1, 3)))
    points = motion.reach * np.array([[-0.5 * np.array(sides), 0.5 * np.array(sides)]])
    with space_panels(motion, 3, 3, "three") as panels:
        canvas = FigureCanvasAgg(panels.figure)
        for panel in panels.axes:
            panels.set_out(panel, "one", points)
        canvas.draw()
        found: list[tuple[str, Bbox]] = []
        for panel in panels.axes:
            found.append(("title", panel.title.get_window_extent()))
            for axis in (panel.xaxis, panel.yaxis, panel.zaxis):
                found.append((axis.label.get_text(), axis.label.get_window_extent()))
                low, high = axis.get_view_interval()
                found += [
                    (tick.label1.get_text(), tick.label1.get_window_extent())
                    for tick in axis.majorTicks
                    if low <= tick.get_loc() <= high
                ]
        paper = panels.figure.bbox
    assert len(found) >= 3 * 7  # a title, three names and a number for each of them
    for text, box in found:
        assert paper.x0 <= box.x0 <= box.x1 <= paper.x1, text
        assert paper.y0 <= box.y0 <= box.y1 <= paper.y1, text
    for (text, box), (other, beside) in combinations(found, 2):
        assert not box.overlaps(beside), (text, other)
