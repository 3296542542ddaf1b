"""Error against time as a picture: one arm on the left, many on the right, on the same axes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING

import numpy as np

from tmm_gen.style import FAINT, INK, PALETTE, figure, picture, style, subtitle

if TYPE_CHECKING:
    from matplotlib.axes import Axes

OURS = "tmm-gen"
_COLOURS = dict(zip(("newmark", "sdirk4", "radau3"), PALETTE, strict=False))
_MARKS = ("o", "s", "^", "v", "D", "P", "X")


@dataclass(frozen=True)
class Curve:
    """What somebody's settings leave and take; numbers are kept to four digits.

    Parameters
    ----------
    panel : str
        "one" arm, or "many".
    name : str
    settings : list of float
        Steps between checkpoints, or tolerances.
    errors : list of float
        m.
    seconds : list of float
        For a simulated second of one arm.
    """

    panel: str
    name: str
    settings: list[float]
    errors: list[float]
    seconds: list[float]

    @property
    def ours(self) -> bool:
        """Whether tmm-gen has drawn it."""
        return self.name.startswith(OURS)

    def values(self) -> dict[str, object]:
        """Return all of it for a file."""
        return asdict(self)

    def front(self) -> tuple[list[float], list[float]]:
        """Return seconds and errors of the settings that no quicker one of the same curve beats."""
        seconds: list[float] = []
        errors: list[float] = []
        for taken, left in sorted(zip(self.seconds, self.errors, strict=True)):
            if not errors or left < errors[-1]:
                seconds.append(taken)
                errors.append(left)
        return seconds, errors

    def time_to(self, error: float) -> float | None:
        """Return the seconds in which an error is reached, between settings by powers; None where it is not."""
        seconds, errors = self.front()
        if not errors or errors[-1] > error:
            return None
        if errors[0] <= error:
            return seconds[0]
        return float(np.exp(np.interp(-np.log(error), -np.log(errors), np.log(seconds))))


def curves_of(rows: Iterable[tuple[str, str, float, float, float]]) -> list[Curve]:
    """Return curves by rows of panel, name, setting, error and seconds."""
    found: dict[tuple[str, str], Curve] = {}
    for panel, name, setting, error, seconds in rows:
        curve = found.setdefault((panel, name), Curve(panel, name, [], [], []))
        curve.settings.append(_rounded(setting))
        curve.errors.append(_rounded(error))
        curve.seconds.append(_rounded(seconds))
    return list(found.values())


def _rounded(number: float) -> float:
    return float(f"{number:.4g}")


def speed_picture(curves: list[Curve], links: int) -> bytes:
    """Draw the curves as a PNG."""
    alone = [c for c in curves if c.panel == "one"]
    peers = [c for c in alone if not c.ours]
    marks = dict(zip((c.name for c in peers), _MARKS, strict=False))
    best = min(peers, key=lambda c: c.time_to(1e-4) or np.inf)
    with style():
        made, (left, right) = figure(11.0, 5.4, ncols=2, sharex=True, sharey=True)
        _draw(left, alone, marks)
        _draw(right, [best, *(c for c in curves if c.panel == "many")], marks)
        subtitle(left, "One arm", f"{links} links fall for a second; down and to the left is better")
        subtitle(right, "Many arms at once", "on one core, time for each of them; the peer one after another")
        left.set_ylabel("largest error of the tip (m)")
        made.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=3)
        return picture(made, "png")


def _draw(panel: Axes, curves: list[Curve], marks: Mapping[str, str]) -> None:
    for curve in curves:
        seconds, errors = curve.front()
        milliseconds = [1e3 * each for each in seconds]
        if curve.ours:
            colour = _COLOURS[curve.name.split(", ")[1]]
            panel.plot(
                milliseconds, errors, color=colour, linewidth=2.4, marker=".", label=curve.name, zorder=3
            )
        else:
            panel.plot(
                milliseconds,
                errors,
                color=FAINT,
                linewidth=1.0,
                marker=marks[curve.name],
                markersize=4,
                markerfacecolor="white",
                markeredgecolor=INK,
                markeredgewidth=0.7,
                label=curve.name,
            )
    panel.set_xscale("log")
    panel.set_yscale("log")
    panel.set_ylim(1e-9, 0.3)
    panel.set_xlabel("computing time for a simulated second (ms)")
