"""Pictures of scenes whose titles would be formulas to Matplotlib, and labels of logarithmic axes without formulas."""

from __future__ import annotations

import warnings
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tmm_gen.cli import main
from tmm_gen.scene.identifier import title_fault
from tmm_gen.style import figure, picture, plain_power, style

DOLLARS = ("costs $5", "$x$", "$x_1^2$ and $", "$_^$", "${$", "$$")
"""Titles that a scene may have."""

PLANAR = """
name = "arm"
title = '''{title}'''
[model]
kind = "planar"
[integrator]
name = "newmark"
step = 1e-2
[base]
kind = "clamp"
[beam]
length = 1.0
bending_stiffness = 2.0
mass_per_length = 0.5
links = 2
[[input]]
name = "push"
at = "tip"
acts = "force_y"
[[output]]
name = "x_1__y2_"
at = "tip"
of = "position"
"""


def drawn(title: str) -> str:
    """Return a picture as SVG whose text stays text."""
    with mpl.rc_context({"svg.fonttype": "none"}), style():
        made, axes = figure(5.0, 3.0, ncols=2)
        axes[0].loglog([1e-3, 1e4], [1e-9, 2.0], label=title)
        axes[0].set_title(title)
        axes[0].legend()
        axes[1].plot([0, 1], [0, 1])
        axes[1].set_ylabel(title)
        axes[1].set_xticks([0, 1], [title, title])
        return picture(made, "svg").decode()


def test_labels_between_powers_do_not_touch() -> None:
    """One and a half decades, of which Matplotlib labels 3 and 4 beside each other."""
    with style():
        made, axes = figure(5.0, 4.0)
        axes.loglog([12.3, 490.0], [1e-9, 2.0])
        axes.set_xlim(10.3, 560.0)
        picture(made, "png")
        for axis in (axes.xaxis, axes.yaxis):
            boxes = [
                label.get_window_extent()
                for label in axis.get_ticklabels(which="both")
                if label.get_text() and label.get_visible()
            ]
            assert len(boxes) >= 3
            for k, box in enumerate(boxes):
                assert not any(box.overlaps(other) for other in boxes[:k])


@pytest.mark.parametrize("title", DOLLARS)
def test_titles_stand_as_they_are_written(title: str) -> None:
    assert title_fault(title) is None
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        text = drawn(title)
    assert text.count(f">{title}<") == 5
    assert "mathdefault" not in text
    assert ">10⁴<" in text


@given(st.text(st.characters(min_codepoint=32, max_codepoint=0x2FFF), min_size=1, max_size=20))
@settings(max_examples=8, deadline=None)
def test_any_title_that_a_scene_may_have_is_drawn_without_a_warning(title: str) -> None:
    if title_fault(title) is None:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            drawn(title)


def test_labels_of_powers() -> None:
    from matplotlib.ticker import LogFormatterSciNotation

    formatter = LogFormatterSciNotation(minor_thresholds=(np.inf, np.inf))
    formatter.create_dummy_axis()
    shown = [plain_power(formatter(value)) for value in (1e-12, 1e-3, 1.0, 20.0, 3e7)]
    assert shown == ["10⁻¹²", "10⁻³", "10⁰", "2×10¹", "3×10⁷"]
    assert plain_power("") == ""


@pytest.mark.parametrize(
    "words",
    [
        ("modes", "arm.toml", "--plot"),
        ("frequency", "arm.toml", "--plot"),
        ("run", "arm.toml", "--plot", "--input", "push=0.1", "--until", "0.2"),
        ("run", "arm.toml", "--animate", "arm.gif", "--input", "push=0.1", "--until", "0.2"),
        ("explain", "arm.toml"),
    ],
    ids=lambda words: "-".join(words[:1] + words[2:3]),
)
def test_commands_draw_any_title_without_a_warning(
    words: tuple[str, ...],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("arm.toml").write_text(PLANAR.format(title="$_^$ 漢字 🤖 أهلا 100 %"))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert main(list(words)) == 0
    assert capsys.readouterr().err == ""
