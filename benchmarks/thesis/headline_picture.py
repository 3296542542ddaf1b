"""The thesis's headline as a picture: the response at its step, and when it settles at others."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from thesis.headline_response import OTHERS, THESIS_STEP, HeadlineRow, exact_settling_time, lighter_tip

from tmm_gen.style import FAINT, INK, PALETTE, figure, picture, style, subtitle
from tmm_gen.thesis.response import DURATION, exact_tip

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Array = NDArray[np.float64]

_NAMES = {"fox_euler": "Fox-Euler", "newmark": "Newmark 1/4", "wilson": "Wilson 1.4", "houbolt": "Houbolt"}
_PRINTED, _DERIVED = "#d55e00", "#0072b2"
_BAND = 0.05
_STATIC = 0.1
"""Of the sample under 1 N m, rad."""

_FINE = 0.01


def headline_picture(rows: list[HeadlineRow]) -> bytes:
    """Draw the rows, that of the thesis's step among them, as a PNG."""
    with style():
        return picture(_drawn(rows), "png")


def _drawn(rows: list[HeadlineRow]) -> Figure:
    made, (left, right) = figure(11.0, 4.6, ncols=2)
    _responses(left, next(row for row in rows if row.step == THESIS_STEP))
    _settling(right, rows)
    return made


def _responses(panel: Axes, row: HeadlineRow) -> None:
    time = _FINE * np.arange(round(DURATION / _FINE) + 1)
    coarse = row.step * np.arange(round(DURATION / row.step) + 1)
    panel.axhspan(_STATIC * (1 - _BAND), _STATIC * (1 + _BAND), color="#eef0f3", zorder=0)
    panel.plot(time, exact_tip(_FINE), color="#b3b7bf", linewidth=5.0, label="exact")
    panel.plot(coarse, row.derived.tip, color=_DERIVED, linewidth=1.3, label="proposed method, derived")
    panel.plot(coarse, row.printed.tip, color=_PRINTED, linewidth=2.2, label="proposed method, as printed")
    panel.plot(
        time,
        lighter_tip(row.lightness, _FINE),
        color=INK,
        linewidth=1.0,
        linestyle=(0, (3, 2)),
        label=f"exact, of an arm {row.lightness:.3g} times lighter",
    )
    for settled, text, colour in (
        (row.printed.settling_time, "as printed: {:.1f} s", _PRINTED),
        (exact_settling_time(), "in truth: {:.1f} s", INK),
    ):
        foot = 0.3 * _STATIC
        panel.plot([settled, settled], [foot, (1 - _BAND) * _STATIC], color=colour, linewidth=1.0)
        panel.annotate(
            text.format(settled),
            (settled, foot),
            (3.0, -2.0),
            textcoords="offset points",
            color=colour,
            fontsize=9,
            va="top",
        )
    panel.set_xlabel("time (s)")
    panel.set_ylabel("tip angle (rad)")
    panel.set_xlim(0.0, DURATION)
    panel.set_ylim(0.0, 2.25 * _STATIC)
    panel.legend(loc="upper right")
    subtitle(
        panel, f"At a step of {row.step:g} s", "two-station sample, 1 N m on the tip; grey: ±5 % of rest"
    )


def _settling(panel: Axes, rows: list[HeadlineRow]) -> None:
    steps = [row.step for row in rows]
    panel.axhline(exact_settling_time(), color="#b3b7bf", linewidth=5.0, zorder=0)
    for name, colour in zip(OTHERS, PALETTE[2:], strict=False):
        times = [row.others[name].settling_time for row in rows]
        panel.plot(steps, times, color=colour, linewidth=1.1, marker=".", markersize=5, label=_NAMES[name])
    panel.plot(
        steps,
        [row.derived.settling_time for row in rows],
        color=_DERIVED,
        linewidth=1.3,
        marker=".",
        markersize=5,
    )
    panel.plot(steps, [row.printed.settling_time for row in rows], color=_PRINTED, linewidth=2.2, marker="o")
    lighter = [row.lighter_settling_time for row in rows]
    panel.plot(steps, lighter, color=INK, linewidth=1.0, linestyle=(0, (3, 2)))
    panel.axvline(THESIS_STEP, color=FAINT, linewidth=0.8)
    panel.annotate(
        "the thesis's step",
        (THESIS_STEP, 17.6),
        (4.0, 0.0),
        textcoords="offset points",
        color=FAINT,
        fontsize=9,
    )
    panel.set_xscale("log")
    panel.set_xlabel("step (s)")
    panel.set_ylabel("settles within 5 % after (s)")
    panel.set_ylim(0.0, 18.5)
    panel.legend(loc="lower right", fontsize=8.5)
    subtitle(
        panel,
        "At other steps",
        "as printed: the smaller the step, the lighter the arm, the sooner it settles",
    )
