"""What stands above axes keeps out of each other's way."""

from __future__ import annotations

import pytest

from tmm_gen.style import LEGEND_COLUMNS, panelled, style, subtitle


@pytest.mark.parametrize("names", [1, 2, 3, 4, 5, 8, 9])
def test_a_legend_of_several_rows_stays_below_the_title(names: int) -> None:
    with style():
        made, (panel,), _ = panelled(8.0, 4.0, [1.0], beside=False, in_space=False)
        for number in range(names):
            panel.plot([0.0, 1.0], [0.0, number], label=f"output_{number}_x")
        columns = min(names, LEGEND_COLUMNS)
        panel.legend(loc="lower right", ncols=columns, bbox_to_anchor=(1.0, 1.0), borderaxespad=0.2)
        subtitle(
            panel, "A title", "a line below it that is as long as those of runs are, newmark, step 0.001 s"
        )
        made.canvas.draw()
        (below,) = panel.texts
        legend = panel.get_legend()
        assert legend is not None
        if names > 2:
            assert legend.get_window_extent().y1 <= below.get_window_extent().y0
        assert below.get_window_extent().y1 <= panel._left_title.get_window_extent().y1
