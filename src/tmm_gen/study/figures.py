"""Work-precision diagrams: what accuracy costs, the points that nothing beats marked."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from tmm_gen.errors import CheckFailed
from tmm_gen.study.configuration import Family
from tmm_gen.study.findings import by_family
from tmm_gen.study.point import Point
from tmm_gen.study.study import Study
from tmm_gen.style import FAINT, INK, PALETTE, figure, picture, style, subtitle

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_LINES: tuple[Literal["-", "--", ":", "-."], ...] = ("-", "--", ":", "-.")
_COLOURS = (*PALETTE, INK, "#7b3294", "#b2182b")
"""One for each integrator."""
_RING: dict[str, Any] = {
    "markersize": 8,
    "markerfacecolor": "none",
    "markeredgecolor": INK,
    "markeredgewidth": 0.9,
}
_THIN, _THICK = 1.0, 6.0
"""Widths of lines, in points."""

_SIZE = (4.4, 4.6)
"""Inches: on a phone's screen letters are then as large as the text around."""

Price = Callable[[Point], float | None]


def require_finished(study: Study) -> None:
    """Refuse a study of which nothing can be drawn.

    Raises
    ------
    CheckFailed
        If no configuration finished.
    """
    if not any(point.finished for point in study.points):
        raise CheckFailed(
            f"{study.scene.source.origin}: no configuration finished, so that there is nothing to draw. "
            "Try shorter --steps."
        )


def trade_picture(study: Study, form: str = "png") -> bytes:
    """Draw :func:`trade_figure` into a file's bytes, in a format: "png", "svg" or "pdf"."""
    return picture(trade_figure(study), form)


def trade_figure(study: Study, wide: bool = True) -> Figure:
    """Draw error against time, or against operations where no times were measured.

    Parameters
    ----------
    study : Study
        With one finished point at least.
    wide : bool
        Whether the legend stands beside.
    """
    return _time_figure(study, wide) if study.timed else _operations_figure(study, wide)


def time_picture(study: Study, form: str = "svg", wide: bool = True) -> bytes:
    """Draw error against microseconds for a simulated second, the unit of tables and sentences."""
    return picture(_time_figure(study, wide), form)


def operations_picture(study: Study, form: str = "svg", wide: bool = True) -> bytes:
    """Draw error against floating-point operations for a simulated second."""
    return picture(_operations_figure(study, wide), form)


def _time_figure(study: Study, wide: bool) -> Figure:
    title, what = "What accuracy costs in time", "µs of computing for a simulated second"
    return _cost_figure(study, _microseconds, title, what, wide)


def _operations_figure(study: Study, wide: bool) -> Figure:
    title, what = "What accuracy costs in operations", "floating-point operations for a simulated second"
    return _cost_figure(study, lambda p: p.operations_per_second, title, what, wide)


def _microseconds(point: Point) -> float | None:
    return None if point.ns_per_second is None else point.ns_per_second / 1e3


def step_picture(study: Study, form: str = "svg", wide: bool = True) -> bytes:
    """Draw the time error against the step: slopes are orders."""
    return picture(_step_figure(study, wide), form)


def _step_figure(study: Study, wide: bool) -> Figure:
    with style():
        made, axes = figure(*_size(wide))
        shown = _drawn_families(study)
        for family, points in shown:
            steps = [p.configuration.step for p in points]
            _line(axes, shown, family, steps, [p.result.error or 0.0 for p in points])
        _logarithmic(axes, "step (s)", "time error, relative to the travel")
        subtitle(axes, "Error against step", "slopes are orders of accuracy")
        _legend(made, shown, wide)
        return made


def modelling_picture(study: Study, form: str = "svg", wide: bool = True) -> bytes:
    """Draw the modelling error against the number of links."""
    with style():
        made, axes = figure(*_size(wide))
        rows = sorted(study.modelling.values(), key=lambda each: each.links)
        axes.loglog([r.links for r in rows], [r.error for r in rows], "o-", color=PALETTE[0])
        apart = [r.links for k, r in enumerate(rows) if not k or r.links > 1.15 * rows[k - 1].links]
        axes.set_xticks(apart, [str(links) for links in apart])
        axes.minorticks_off()
        axes.set_xlabel("links")
        axes.set_ylabel("modelling error, relative to the travel")
        subtitle(axes, "What few links cost in accuracy", f"observed order {rows[0].order:.2f}")
        return picture(made, form)


def _cost_figure(study: Study, price: Price, title: str, what: str, wide: bool) -> Figure:
    with style():
        made, axes = figure(*_size(wide))
        shown = _drawn_families(study)
        for family, points in shown:
            costs = [price(p) or 0.0 for p in points]
            _line(axes, shown, family, costs, [study.error(p) for p in points])
        front = [(price(p) or 0.0, study.error(p)) for p in study.front(price)]
        axes.plot(*zip(*front, strict=True), "o", zorder=4, **_RING)
        whole = "time and modelling error" if study.varies_links else "time error"
        _logarithmic(axes, what, f"{whole}, relative to the travel")
        subtitle(axes, title, study.scene.name)
        _legend(made, shown, wide, rings=True)
        return made


def _drawn_families(study: Study) -> list[tuple[Family, list[Point]]]:
    return [(family, points) for family, points in by_family(study.points) if points]


def _line(
    axes: Axes,
    shown: list[tuple[Family, list[Point]]],
    family: Family,
    x: list[float],
    y: list[float],
) -> None:
    """Draw a family: a colour for its integrator, a line for what else tells it apart.

    Methods of one order have much the same errors: each is drawn thinner than the one below it, so that none is hidden.
    """
    integrators, variants = _told_apart(shown)
    number = integrators.index(family.integrator)
    width = _width(number, len(integrators))
    axes.plot(
        x,
        y,
        color=_COLOURS[number % len(_COLOURS)],
        linestyle=_LINES[variants.index(family.variant) % len(_LINES)],
        marker="o" if variants.index(family.variant) == 0 else "s",
        markersize=width + 1.8,
        linewidth=width,
        zorder=2.0 + number / len(integrators),
    )


def _width(number: int, count: int) -> float:
    """Return the width of an integrator's line, in points: wider, the more are drawn above it."""
    return _THIN + min(2.0, (_THICK - _THIN) / max(count - 1, 1)) * (count - 1 - number)


def _told_apart(shown: list[tuple[Family, list[Point]]]) -> tuple[list[str], list[str]]:
    """Return integrators, and what else tells families apart, in order."""
    integrators = list(dict.fromkeys(family.integrator for family, _ in shown))
    return integrators, list(dict.fromkeys(family.variant for family, _ in shown))


def _logarithmic(axes: Axes, x: str, y: str) -> None:
    """Set scales, labels and limits of axes whose lines are drawn: the least error has its place."""
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    drawn = np.concatenate([np.asarray(line.get_ydata(), float) for line in axes.lines])
    low = float(np.min(drawn[drawn > 0.0]))
    axes.set_ylim(max(low / 3.0, 1e-15), 2.0)
    for level in (1e-2, 1e-4, 1e-6):
        axes.axhline(level, color=FAINT, linewidth=0.6, zorder=0)


def _legend(made: Figure, shown: list[tuple[Family, list[Point]]], wide: bool, rings: bool = False) -> None:
    """Explain colours, lines and rings."""
    from matplotlib.lines import Line2D

    integrators, variants = _told_apart(shown)
    handles = [
        Line2D([], [], color=_COLOURS[k % len(_COLOURS)], linewidth=_width(k, len(integrators)), label=name)
        for k, name in enumerate(integrators)
    ]
    if len(variants) > 1:
        handles += [
            Line2D([], [], color=INK, linestyle=_LINES[k % len(_LINES)], linewidth=1.2, label=name)
            for k, name in enumerate(variants)
        ]
    if rings:
        handles.append(Line2D([], [], linestyle="", marker="o", label="beaten by none", **_RING))
    if wide:
        made.legend(handles=handles, loc="outside right center")
    else:
        made.legend(handles=handles, loc="outside lower center", ncols=3, fontsize=8, columnspacing=1.0)


def _size(wide: bool) -> tuple[float, float]:
    return (8.0, 5.0) if wide else _SIZE
