"""The report is one page that needs nothing else, and fits a phone."""

from __future__ import annotations

import base64
import csv
import io
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import matplotlib.colors
import matplotlib.image
import numpy as np
import pytest
from matplotlib.figure import Figure
from support.browser import PHONE, excess_on_a_phone

from tmm_gen.study.figures import (
    _operations_figure,
    _step_figure,
    _time_figure,
    step_picture,
    trade_picture,
)
from tmm_gen.study.report import report
from tmm_gen.study.study import Study
from tmm_gen.style import PALETTE

REPORTS = sorted((Path(__file__).resolve().parents[2] / "docs" / "reports").glob("*.html"))


@pytest.fixture(scope="module")
def chain_page(chain_study: Study) -> str:
    return report(chain_study)


@pytest.fixture(scope="module")
def arm_page(arm_study: Study) -> str:
    return report(arm_study)


def needs_nothing(page: str) -> None:
    """Assert that a page loads nothing from anywhere and runs nothing."""
    assert "<script" not in page
    assert "<link" not in page
    assert "@import" not in page
    loaded = re.findall(r"""(?:\b(?:src|href|xlink:href|action)\s*=\s*|url\()["']?([^"'\s)>]+)""", page)
    assert loaded
    assert {target.partition(",")[0][:5] for target in loaded if not target.startswith("#")} <= {"data:"}


@pytest.mark.parametrize(("which", "pictures"), [("chain_page", 3), ("arm_page", 4)])
def test_page_needs_nothing_else(which: str, pictures: int, request: pytest.FixtureRequest) -> None:
    page: str = request.getfixturevalue(which)
    needs_nothing(page)
    assert '<meta name="viewport" content="width=device-width, initial-scale=1">' in page
    assert len(page) < 1_000_000
    assert page.count("<svg") == pictures
    assert ("Few links" in page) == (pictures == 4)


def test_page_holds_all_figures(chain_study: Study, chain_page: str) -> None:
    found = re.search(r'href="data:text/csv;base64,([^"]+)"', chain_page)
    assert found
    rows = list(csv.DictReader(io.StringIO(base64.b64decode(found[1]).decode())))
    assert len(rows) == len(chain_study.points)
    for row, point in zip(rows, chain_study.points, strict=True):
        assert row["error"] == ("" if point.result.error is None else repr(point.result.error))
    assert "diverged" in chain_page
    assert "zhai: " in chain_page


def test_what_users_write_is_no_markup(chain_study: Study, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tmm_gen.study.report._figures", lambda study: [])
    scene = chain_study.scene.replace(title="a <b>bold</b> & daring arm")
    page = report(replace(chain_study, scene=scene))
    assert "a &lt;b&gt;bold&lt;/b&gt; &amp; daring arm" in page


def test_browser_shows_it_on_a_phone(arm_page: str, browse: Callable[..., str], tmp_path: Path) -> None:
    assert excess_on_a_phone(arm_page, tmp_path, browse) == 0
    shot = tmp_path / "shot.png"
    browse(tmp_path / "page.html", f"--screenshot={shot}", f"--window-size={PHONE},2000")
    seen = matplotlib.image.imread(shot)[..., :3]
    assert seen.shape[:2] == (2000, PHONE)
    # text below the heading, and curves in the colours of the first two integrators
    dark = np.all(seen < 0.4, axis=2)
    assert dark[:200].sum() > 500
    for colour in ((0x00, 0x72, 0xB2), (0xD5, 0x5E, 0x00)):
        near = np.all(np.abs(seen - np.array(colour) / 255.0) < 0.05, axis=2)
        assert np.ptp(np.nonzero(near[600:])[1]) > PHONE / 3  # farther apart than a legend draws them


@pytest.mark.parametrize("which", ["chain_study", "arm_study"])
@pytest.mark.parametrize("drawn", [_step_figure, _time_figure, _operations_figure])
def test_pictures_show_every_point(
    drawn: Callable[[Study, bool], Figure], which: str, request: pytest.FixtureRequest
) -> None:
    """Those of steps have time errors alone, which may be far below errors of modelling."""
    axes = drawn(request.getfixturevalue(which), True).axes[0]
    low, high = axes.get_ylim()
    curves = [line for line in axes.lines if line.get_marker() != "None"]
    found = np.concatenate([np.asarray(line.get_ydata(), float) for line in curves])
    assert len(found) > 3
    assert np.all((found >= low) & (found <= high))


@pytest.mark.parametrize("path", REPORTS, ids=lambda path: path.stem)
def test_committed_reports_are_whole(path: Path, browse: Callable[..., str], tmp_path: Path) -> None:
    page = path.read_text()
    needs_nothing(page)
    assert len(page.encode()) < 1_000_000
    assert excess_on_a_phone(page, tmp_path, browse) == 0


def test_there_are_reports() -> None:
    assert {path.stem for path in REPORTS} >= {"thesis10", "arm10", "arm50"}


def test_pictures_are_the_same_every_time(chain_study: Study) -> None:
    drawn = trade_picture(chain_study, "svg")
    assert drawn.startswith(b"<?xml")
    assert drawn == trade_picture(chain_study, "svg")


def test_no_two_figures_share_a_title(chain_study: Study, arm_study: Study) -> None:
    """And what is timed is in one unit, in pictures, tables and prose."""
    for study in (chain_study, arm_study):
        page = report(study)
        titles = [
            tuple(re.findall(r"<!-- (.*?) -->", svg)) for svg in re.findall(r"<svg.*?</svg>", page, re.DOTALL)
        ]
        titles = [tuple(text for text in texts if "accuracy" in text or "step" in text) for texts in titles]
        assert len(set(titles)) == len(titles)
        assert "ns of computing" not in page
        assert not re.search(r"[\d.] (ns|ms) for a simulated second", page)


def test_series_that_agree_do_not_hide_each_other(chain_study: Study) -> None:
    """Four methods with the same errors at the same steps: each has its colour in the picture."""
    first = next(p for p in chain_study.points if p.finished)
    names = ("newmark", "bathe", "park", "wilson")
    points = tuple(
        replace(
            first,
            configuration=replace(
                first.configuration, step=step, family=replace(first.configuration.family, integrator=name)
            ),
            result=replace(first.result, error=step**2),
        )
        for name in names
        for step in (0.1, 0.01, 0.001)
    )
    drawn = step_picture(replace(chain_study, points=points), "png")
    seen = matplotlib.image.imread(io.BytesIO(drawn), format="png")[..., :3]
    middle = seen[:, : int(0.75 * seen.shape[1])]  # the legend is beside it
    for colour in PALETTE[: len(names)]:
        wanted = np.array(matplotlib.colors.to_rgb(colour))
        assert np.all(np.abs(middle - wanted) < 0.04, axis=2).sum() > 100, colour
