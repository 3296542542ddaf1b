"""What became of the extremes of a grid, as a picture."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from extremes_of_chains.chains import DIVERGED, REFUSED, RIGHT, WRONG, ChainVerdict
from extremes_of_chains.extreme import ChainExtreme

from tmm_gen.style import FAINT, figure, picture, style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Judged = Sequence[tuple[ChainExtreme, ChainVerdict]]

_COLOURS = {RIGHT: "#009e73", REFUSED: "#c9cdd4", DIVERGED: "#e69f00", WRONG: "#c00000"}
_STATUSES = tuple(_COLOURS)


def extremes_picture(judged: Judged, kernels: Sequence[Mapping[str, str]], steps: Sequence[float]) -> bytes:
    """Draw a grid: a column for each length and integrator, a row for each kernel, as a PNG.

    Parameters
    ----------
    judged : sequence of (ChainExtreme, ChainVerdict)
        Those loaded, undamped and in halves are drawn.
    kernels : sequence of mapping
        Number type, sweep and unknown of the rows.
    steps : sequence of float
        As shares of the first period.
    """
    with style():
        return picture(_drawn(judged, kernels, steps), "png")


def _drawn(judged: Judged, kernels: Sequence[Mapping[str, str]], steps: Sequence[float]) -> Figure:
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    plain = [
        (e, v)
        for e, v in judged
        if (e.damping, e.start, e.pattern) == (0.0, "loaded", "halves") and e.step in steps
    ]
    columns = [key for key in dict.fromkeys((e.integrator, e.links) for e, _ in plain) if _many(plain, key)]
    made, axes = figure(
        1.6 + 1.25 * len(columns),
        1.6 + 1.35 * len(kernels),
        nrows=len(kernels),
        ncols=len(columns),
        squeeze=False,
    )
    for row, kernel in enumerate(kernels):
        for column, key in enumerate(columns):
            panel = axes[row, column]
            panel.set_xticks([])
            panel.set_yticks([])
            panel.grid(False)
            panel.spines[:].set_visible(False)
            shown = _cells(plain, key, kernel, steps)
            if shown is None:
                continue
            panel.imshow(shown, cmap=ListedColormap(list(_COLOURS.values())), vmin=0, vmax=3, aspect="auto")
            if row == 0:
                panel.set_title(_heading(key), fontsize=9)
        axes[row, 0].set_ylabel("\n".join(kernel.values()), rotation=0, ha="right", va="center", fontsize=8.5)
    made.legend(
        handles=[Patch(color=_COLOURS[status], label=status) for status in _STATUSES],
        loc="outside upper center",
        ncols=4,
    )
    made.supxlabel(
        "in each panel, left to right: step 1e-9 to 10 first periods; top to bottom: ratios of stiffness, and "
        "of inertia within, 1e-12 to 1e12",
        fontsize=9,
        color=FAINT,
    )
    return made


def _many(plain: Judged, key: tuple[str, int]) -> bool:
    return sum((e.integrator, e.links) == key for e, _ in plain) > 1


def _heading(key: tuple[str, int]) -> str:
    name, links = key
    counted = f"{links:,} link{'s' * (links > 1)}".replace(",", " ")
    return counted if name == "newmark" else f"{counted}\n{name}"


def _cells(
    plain: Judged, key: tuple[str, int], kernel: Mapping[str, str], steps: Sequence[float]
) -> np.ndarray[Any, Any] | None:
    """Return numbers of statuses, ratios below each other and steps beside each other; None where there are none."""
    found = {
        (e.stiffness_ratio, e.inertia_ratio, e.step): _STATUSES.index(v.status)
        for e, v in plain
        if (e.integrator, e.links) == key
        and {"real": e.real, "sweep": e.sweep, "unknown": e.unknown} == dict(kernel)
    }
    if not found:
        return None
    ratios = sorted({(k, m) for k, m, _ in found})
    used = [step for step in steps if any(step == each for _, _, each in found)]
    return np.array([[found.get((*ratio, step), np.nan) for step in used] for ratio in ratios], float)
