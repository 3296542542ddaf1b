"""Maps of growth as a picture: measured beside derived, a row for each integrator."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.stability.map import GrowthMap
from tmm_gen.style import FAINT, INK, figure, picture, style, subtitle

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Array = NDArray[np.float64]

_FINEST = 1e-4
"""Growth and decay in a step between this and `_COARSEST` take up the scale of colours."""
_COARSEST = 10.0
_TICKS = (-10.0, -1.0, -0.1, -0.01, -0.001, 0.0, 0.001, 0.01, 0.1, 1.0, 10.0)


def map_picture(maps: Sequence[GrowthMap], form: str = "png") -> bytes:
    """Draw :func:`map_figure` into a file's bytes, in a format: "png", "svg" or "pdf"."""
    return picture(map_figure(maps), form)


def map_figure(maps: Sequence[GrowthMap]) -> Figure:
    """Draw maps, a row for each: measured on the left, derived on the right.

    Parameters
    ----------
    maps : sequence of GrowthMap
        Of one scene.
    """
    with style():
        return _drawn(maps)


def _drawn(maps: Sequence[GrowthMap]) -> Figure:
    made, axes = figure(10.0, 1.1 + 3.3 * len(maps), nrows=len(maps), ncols=2, sharey="row", squeeze=False)
    mesh: Any = None
    for row, each in enumerate(maps):
        measured, derived = axes[row]
        name = each.scene.integrator.name
        mesh = _panel(measured, each, each.measured)
        _panel(derived, each, each.derived)
        off = int(np.sum(each.differs))
        said = f"{off} of {each.differs.size} cells differ (dots)" if off else _agreement(each)
        subtitle(measured, f"{name}: measured by running the kernel", said)
        subtitle(derived, f"{name}: derived", "spectral radius of the amplification matrix, worst mode")
        measured.plot(*_centres(each, each.differs), ".", color=INK, markersize=3, zorder=5)
        measured.set_ylabel("stiffness / the scene's")
    for panel in axes[-1]:
        panel.set_xlabel("step (s); cross: the scene")
    bar = made.colorbar(mesh, ax=axes, shrink=min(1.0, 0.85 / len(maps) + 0.15), pad=0.02)
    bar.set_ticks([float(_scaled(np.array(np.sign(tick) * np.log1p(abs(tick))))) for tick in _TICKS])
    bar.set_ticklabels([_label(tick) for tick in _TICKS])
    bar.set_label("growth ρ − 1 (red) or decay 1 − 1/ρ (blue) in a step")
    bar.outline.set_visible(False)
    return made


def _agreement(each: GrowthMap) -> str:
    finite = np.abs(each.difference[np.isfinite(each.difference)])
    return (
        f"agrees with the derived map in all {each.differs.size} cells, to {np.max(finite, initial=0.0):.0e}"
    )


def _label(tick: float) -> str:
    return "0" if tick == 0.0 else f"{tick:+g}".replace("-", "−")


def _panel(panel: Axes, each: GrowthMap, radii: Array) -> Any:
    with np.errstate(divide="ignore"):
        value = _scaled(np.clip(np.log(radii), -50.0, 50.0))
    mesh = panel.pcolormesh(
        each.steps,
        each.factors,
        value,
        cmap="RdBu_r",
        vmin=-1.0,
        vmax=1.0,
        shading="nearest",
        rasterized=True,
    )
    if np.any(each.grows) and not np.all(each.grows):
        panel.contour(
            each.steps, each.factors, each.grows.astype(float), [0.5], colors=[INK], linewidths=[1.0]
        )
    panel.plot(each.scene.integrator.step, 1.0, "x", color=INK, markersize=7, markeredgewidth=1.8, zorder=6)
    panel.set_xscale("log")
    panel.set_yscale("log")
    panel.grid(False)
    panel.axhline(1.0, color=FAINT, linewidth=0.6, zorder=4)
    return mesh


def _centres(each: GrowthMap, chosen: NDArray[np.bool_]) -> tuple[Array, Array]:
    rows, columns = np.nonzero(chosen)
    return each.steps[columns], each.factors[rows]


def _scaled(logarithm: Array) -> Array:
    """Return -1 to 1: signed, and logarithmic beyond `_FINEST`."""
    size = np.log1p(np.abs(logarithm) / _FINEST) / np.log1p(_COARSEST / _FINEST)
    scaled: Array = np.sign(logarithm) * np.minimum(size, 1.0)
    return scaled
