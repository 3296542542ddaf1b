"""How figures look: one palette, thin grids, no frames, the same bytes every time."""

from __future__ import annotations

import math
import re
import textwrap
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from io import BytesIO
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.text import Text
    from matplotlib.ticker import Formatter, LogFormatterMathtext

PALETTE = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f4f24", "#999933")
"""Colours that readers with colour blindness tell apart (Okabe & Ito 2008), and two more."""

INK = "#222222"
FAINT = "#8a8f98"

_STYLE: dict[str, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 9.5,
    "axes.titlesize": 11,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.labelsize": 9.5,
    "axes.labelcolor": INK,
    "axes.edgecolor": "#b8bcc4",
    "axes.linewidth": 0.8,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#e4e6ea",
    "grid.linewidth": 0.8,
    "xtick.color": INK,
    "xtick.major.size": 0,
    "ytick.major.size": 0,
    "xtick.minor.size": 0,
    "ytick.minor.size": 0,
    "ytick.color": INK,
    "text.color": INK,
    "text.parse_math": False,  # a scene's title may hold dollars
    "lines.linewidth": 1.8,
    "lines.solid_capstyle": "round",
    "legend.frameon": False,
    "legend.fontsize": 9,
    "figure.facecolor": "white",
    "savefig.facecolor": "white",
    "svg.hashsalt": "tmm-gen",
}


_ROUNDS = 4
"""How often titles are broken anew, as each break moves others."""
_SHORT = 30
"""Characters that have room in any picture."""
_ROOM = 0.4
"""Share of a picture's width that a title beside a field has, less its margins."""
_EDGE = 0.1
"""Left free beside a title, inches."""

_RAISED = str.maketrans("-0123456789.", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹·")


@contextmanager
def style() -> Iterator[None]:
    """Draw in this project's style inside the block."""
    import matplotlib as mpl

    with mpl.rc_context(_STYLE), warnings.catch_warnings():  # type: ignore[arg-type, unused-ignore]
        # a title in a script that the font lacks is drawn as boxes; it is a picture still
        warnings.filterwarnings("ignore", "Glyph .* missing from", UserWarning)
        yield


def figure(width: float, height: float, **layout: Any) -> tuple[Figure, Any]:
    """Return a figure of some size in inches and its axes, made without the global state of pyplot.

    To be called, and drawn in, inside a block of :func:`style`.

    Parameters
    ----------
    width, height : float
        Inches.
    **layout
        As for `matplotlib.figure.Figure.subplots`.
    """
    from matplotlib.figure import Figure

    made = Figure(figsize=(width, height), layout="constrained")
    return made, made.subplots(**layout)


def panelled(
    width: float, height: float, ratios: list[float], *, beside: bool = False, in_space: bool = False
) -> tuple[Figure, Any, Any]:
    """Return a figure of panels below each other with one axis of time, and a field beside them if wanted.

    Parameters
    ----------
    width, height : float
        Inches.
    ratios : list of float
        Heights of the panels.
    beside : bool
        Whether to leave half of the width to a field.
    in_space : bool
        Whether that field has three axes.

    Returns
    -------
    figure, panels, field
        The last is None where there is none.
    """
    from matplotlib.figure import Figure

    made = Figure(figsize=(width, height), layout="constrained")
    if in_space:
        # room for the labels of the upward axis, of which the layout knows nothing
        made.set_layout_engine("constrained", wspace=0.12)
    grid = made.add_gridspec(len(ratios), 1 + beside, height_ratios=ratios)
    field = made.add_subplot(grid[:, 0], projection="3d" if in_space else None) if beside else None
    if in_space and field is not None:
        field.set_anchor("N")
    panels: list[Any] = []
    for row in range(len(ratios)):
        panels.append(made.add_subplot(grid[row, int(beside)], sharex=panels[0] if panels else None))
    for panel in panels[:-1]:
        panel.tick_params(labelbottom=False)
    return made, panels, field


def picture(made: Figure, form: str) -> bytes:
    """Return a figure as bytes of a picture.

    Parameters
    ----------
    made : Figure
        From :func:`figure`.
    form : {"png", "svg", "pdf"}
        Format.
    """
    metadata = {"png": {"Software": "tmm-gen"}, "svg": {"Date": None}, "pdf": {"CreationDate": None}}[form]
    _write_powers_plainly(made)
    with style(), BytesIO() as buffer:
        _break_long_titles(made)
        made.savefig(buffer, format=form, dpi=160, metadata=metadata)
        return buffer.getvalue()


def _break_long_titles(made: Figure) -> None:
    """Break titles that would run out of the picture into lines, at blanks."""
    from matplotlib.text import Text

    whole, long = made.bbox, [text for text in made.findobj(Text) if len(text.get_text()) > _SHORT]
    if not any(text.get_window_extent().width > _ROOM * whole.width for text in long):
        return
    for text in long:
        _break(text, whole.width)  # as axes have no room beside a title that is wider than all of it
    for _ in range(_ROUNDS):
        made.draw_without_rendering()  # tells where they begin, now that they have so many lines
        edge = whole.x1 - _EDGE * made.dpi
        broken = [_break(text, edge - text.get_window_extent().x0) for text in long]
        if not any(broken):
            return


def _break(text: Text, room: float) -> bool:
    """Break a text into lines no longer than some room (pixels); return whether that was called for."""
    width = text.get_window_extent().width
    if width <= room or room <= 0.0 or text.get_rotation():
        return False
    longest = max(map(len, text.get_text().splitlines()))
    most = max(_SHORT // 2, int(longest * room / width) - 1)
    text.set_text(textwrap.fill(" ".join(text.get_text().split()), most))
    return True


def _write_powers_plainly(made: Figure) -> None:
    """Label logarithmic axes with plain characters: mathematical text is switched off."""
    from matplotlib.ticker import LogFormatterMathtext

    for axes in made.axes:
        for axis in (axes.xaxis, axes.yaxis):
            for formatter, change in (
                (axis.get_major_formatter(), axis.set_major_formatter),
                (axis.get_minor_formatter(), axis.set_minor_formatter),
            ):
                if isinstance(formatter, LogFormatterMathtext):
                    change(_plain(formatter))


def _plain(formatter: LogFormatterMathtext) -> Formatter:
    from matplotlib.ticker import Formatter

    class Plain(Formatter):
        """Another formatter's labels without mathematical text."""

        def set_axis(self, axis: Any) -> None:
            super().set_axis(axis)
            formatter.set_axis(axis)

        def set_locs(self, locs: Any) -> None:
            super().set_locs(locs)
            formatter.set_locs(locs)

        def __call__(self, x: float, pos: int | None = None) -> str:
            low, high = formatter.axis.get_view_interval() if formatter.axis else (x, x)
            return plain_power(formatter(x, pos)) if _has_room(x, low, high) else ""

    return Plain()


def _has_room(x: float, low: float, high: float) -> bool:
    """Return whether a tick can have a label: on half a decade or more 3 and 4 would touch, and 6 and 10."""
    if x <= 0.0 or low <= 0.0 or math.log10(high / low) < _NARROW:
        return True
    return round(10.0 ** (math.log10(x) % 1.0), 6) in (1.0, 2.0, 4.0, 10.0)


_NARROW = 0.5


def plain_power(label: str) -> str:
    """Return Matplotlib's label of a power without its markup: ``10⁻³``, ``2×10⁴``."""
    bare = label.removeprefix(r"$\mathdefault{").removesuffix("}$").replace(r"\times", "×")
    return re.sub(r"\^\{([^}]*)\}", lambda found: found[1].replace("\u2212", "-").translate(_RAISED), bare)


LEGEND_COLUMNS = 4
"""Names beside each other above axes, at most."""


def subtitle(axes: Axes, title: str, below: str) -> None:
    """Put a title over axes, and a fainter line between both; a legend of several names there stays below them."""
    legend = axes.get_legend()
    names = len(legend.get_texts()) if legend is not None else 0
    above = 6.0 + 14.0 * math.ceil(names / LEGEND_COLUMNS) if names > 2 else 0.0
    axes.set_title(title, loc="left", pad=22 + above)
    axes.annotate(
        below,
        (0.0, 1.0),
        (0.0, 8.0 + above),
        "axes fraction",
        "offset points",
        color=FAINT,
        fontsize=9,
        va="bottom",
    )
