"""What stands above axes keeps out of each other's way."""

from __future__ import annotations

import pytest

from tmm_gen.style import LEGEND_COLUMNS, figure, panelled, picture, style, subtitle


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


LONG = "A title that says of an arm what it is, what it carries, where it stands and what it is for"


@pytest.mark.parametrize("beside", [False, True])
def test_a_long_title_is_broken_into_lines(beside: bool) -> None:
    with style():
        made, (panel,), _ = panelled(9.0, 4.0, [1.0], beside=beside)
        subtitle(panel, f"{LONG}, {LONG}", "a line below")
        above, _ = figure(6.0, 3.0)
        above.suptitle(f"{LONG}, {LONG}", x=0.01, ha="left")
    for drawn in (made, above):
        picture(drawn, "png")
        drawn.draw_without_rendering()
    for text, drawn in ((panel._left_title, made), (above.texts[-1], above)):
        assert " ".join(text.get_text().split()) == f"{LONG}, {LONG}"
        extent = text.get_window_extent()
        assert extent.x1 <= drawn.bbox.x1
        assert extent.y1 <= drawn.bbox.y1 + 1.0


def test_a_short_title_stays_one_line() -> None:
    with style():
        made, (panel,), _ = panelled(9.0, 4.0, [1.0], beside=True)
        subtitle(panel, "An arm of two links that lifts its payload", "a line below")
    picture(made, "png")
    assert "\n" not in panel._left_title.get_text()
