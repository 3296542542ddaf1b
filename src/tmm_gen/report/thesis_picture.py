"""The picture of the demonstration: responses above, errors below, one column for each scene."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.report.thesis_samples import THESIS_STEP, Curve, Sample
from tmm_gen.style import INK, figure, picture, style, subtitle

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.ticker import Locator

Array = NDArray[np.float64]

_COLOURS = {
    "fox_euler": "#e69f00",
    "houbolt": "#cc79a7",
    "wilson": "#009e73",
    "newmark": "#56b4e9",
    "zhou": "#0072b2",
    "printed": "#d55e00",
}
_NAMES = {
    "fox_euler": "Fox-Euler",
    "houbolt": "Houbolt",
    "wilson": "Wilson 1.4",
    "newmark": "Newmark 1/4",
    "zhou": "proposed method, derived",
    "printed": "proposed method, as printed",
}
_BAND = 0.05
_WITHIN = f"within {100 * _BAND:g} % after"
_FLOOR = 1e-6
_WINDOW = 1 / 16
"""Reach of the window of an envelope to each side, as a share of the whole run: a quarter period at least."""


def thesis_picture(samples: list[Sample]) -> bytes:
    """Draw responses and errors at the thesis's step, as a PNG."""
    with style():
        return picture(_drawn(samples), "png")


def _drawn(samples: list[Sample]) -> Figure:
    made, axes = figure(
        11.0, 6.6, nrows=2, ncols=len(samples), sharex="col", gridspec_kw={"height_ratios": [1.35, 1.0]}
    )
    for column, sample in enumerate(samples):
        above, below = axes[0, column], axes[1, column]
        _responses(above, sample)
        _errors(below, sample)
        subtitle(above, sample.scene.title.partition(",")[0], _facts(sample))
        below.set_xlabel("time (s)")
        below.set_xlim(0.0, sample.exact.time[-1])
    axes[0, 0].set_ylabel("tip angle (rad)")
    axes[1, 0].set_ylabel("error / static deflection\n(envelope)")
    if "printed" in samples[0].curves:
        _point_out(axes[0, 0], samples[0])
    handles, labels = axes[0, 0].get_legend_handles_labels()
    made.legend(handles, labels, loc="outside lower center", ncols=4, handlelength=2.6, columnspacing=2.2)
    return made


def _facts(sample: Sample) -> str:
    stations = sample.scene.stations
    return f"{stations} stations, 1 N m on the tip from rest, step {THESIS_STEP:g} s; grey: ±5 % of rest"


def _responses(panel: Axes, sample: Sample) -> None:
    static = sample.static
    panel.axhspan(static * (1 - _BAND), static * (1 + _BAND), color="#eef0f3", zorder=0)
    panel.plot(
        sample.exact.time,
        sample.exact.tip,
        color="#b3b7bf",
        linewidth=5.0,
        label="exact (matrix exponential)",
    )
    for name, colour in _COLOURS.items():
        if name in sample.curves:
            curve = sample.curves[name]
            panel.plot(curve.time, curve.tip, color=colour, label=_NAMES[name], **_stroke(name))


def _stroke(name: str) -> dict[str, Any]:
    if name == "printed":
        return {"linewidth": 2.2, "linestyle": (0, (4, 1.5)), "zorder": 5}
    return {"linewidth": 1.3}


def _errors(panel: Axes, sample: Sample) -> None:
    panel.set_yscale("log")
    for name, colour in _COLOURS.items():
        if name in sample.curves:
            curve = sample.curves[name]
            panel.plot(curve.time, np.maximum(_envelope(curve), _FLOOR / 10), color=colour, **_stroke(name))
    panel.set_ylim(_FLOOR, 3.0)
    panel.xaxis.set_major_locator(_locator())


def _locator() -> Locator:
    from matplotlib.ticker import MaxNLocator

    return MaxNLocator(nbins=6, steps=[1, 2, 5, 10])


def _envelope(curve: Curve) -> Array:
    """Return the largest error in a window around each instant: no dips where the sign changes."""
    reach = round(_WINDOW * len(curve.time))
    padded = np.pad(np.abs(curve.error), reach, mode="reflect")
    envelope: Array = np.max(np.lib.stride_tricks.sliding_window_view(padded, 2 * reach + 1), axis=1)
    return envelope


def _point_out(panel: Axes, sample: Sample) -> None:
    """Mark from when on the response stays within the band: as printed, and in truth."""
    for curve, text, colour, weight in (
        (sample.curves["printed"], f"as printed,\n{_WITHIN} {{:.1f}} s", _COLOURS["printed"], "bold"),
        (sample.exact, f"in truth,\n{_WITHIN} {{:.1f}} s", INK, "normal"),
    ):
        outside = np.flatnonzero(np.abs(curve.tip / sample.static - 1.0) > _BAND)
        settled = float(curve.time[outside[-1] + 1])
        foot = 0.3 * sample.static
        panel.plot(
            [settled, settled], [foot, (1.0 - _BAND) * sample.static], color=colour, linewidth=1.0, zorder=6
        )
        panel.plot(settled, (1.0 - _BAND) * sample.static, marker="^", markersize=5, color=colour, zorder=6)
        panel.annotate(
            text.format(settled),
            (settled, foot),
            (3.0, -2.0),
            textcoords="offset points",
            color=colour,
            fontsize=9,
            fontweight=weight,
            ha="left",
            va="top",
        )
