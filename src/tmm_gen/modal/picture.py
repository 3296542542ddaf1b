"""Mode shapes and frequency responses as pictures."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.answer import Answer
from tmm_gen.modal.arm import LinearArm
from tmm_gen.modal.beam import BeamArm, beam_shape
from tmm_gen.modal.limbs import limbs_of
from tmm_gen.modal.modes import Mode
from tmm_gen.modal.parts import parts_of
from tmm_gen.style import FAINT, PALETTE, figure, picture, style, subtitle

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_KINDS = {"chain": "chain", "planar": "{} links", "spatial": "{} joints"}
"""What a curve is of."""

_COLUMNS = 3
_SWING = 0.12
"""Largest deflection of a drawn mode, relative to the arm's length."""


def mode_picture(
    arm: LinearArm, modes: Sequence[Mode], exact: tuple[BeamArm, Array] | None, form: str = "png"
) -> bytes:
    """Draw mode shapes, one panel each.

    Parameters
    ----------
    arm : LinearArm
        What swings.
    modes : sequence of Mode
        Its modes.
    exact : (BeamArm, array), optional
        The continuous beam and its natural frequencies, rad/s, to be drawn beside it.
    form : {"png", "svg", "pdf"}
        Format.
    """
    return picture(mode_figure(arm, modes, exact), form)


def mode_figure(arm: LinearArm, modes: Sequence[Mode], exact: tuple[BeamArm, Array] | None) -> Figure:
    """Return the figure that :func:`mode_picture` writes."""
    shaped = arm.scene.model.in_plane
    with style():
        columns = min(_COLUMNS, len(modes))
        rows = -(-len(modes) // columns)
        made, axes = figure(3.3 * columns, 0.6 + 2.3 * rows, nrows=rows, ncols=columns, squeeze=False)
        for number, (panel, mode) in enumerate(zip(axes.flat, modes, strict=False)):
            if not shaped:
                _draw_chain(panel, arm, mode)
            elif _is_straight(arm):
                like = mode.undamped
                omega = None if exact is None or like is None else float(exact[1][like])
                _draw_straight(panel, arm, mode, None if exact is None else exact[0], omega)
            else:
                _draw_bent(panel, arm, mode)
            _title(panel, number + 1, mode)
        for panel in axes.flat[len(modes) :]:
            panel.set_visible(False)
        for panel in axes[:, 0]:
            panel.set_ylabel(("deflection" if _is_straight(arm) else "y (m)") if shaped else "angle")
        below = "x (m)" if shaped else "station (0: base)"
        for column in range(columns):
            last = max(row for row in range(rows) if row * columns + column < len(modes))
            axes[last, column].set_xlabel(below)
        handles, labels = axes[0, 0].get_legend_handles_labels()
        if len(labels) > 1:
            made.legend(handles, labels, loc="outside lower center", ncols=len(labels))
        made.suptitle(arm.scene.title, x=0.01, ha="left", fontweight="bold", fontsize=11)
        return made


def _title(panel: Axes, number: int, mode: Mode) -> None:
    text = f"{mode.hertz:.4g} Hz" if mode.frequency else ("falls over" if mode.unstable else "turns freely")
    if mode.damping_ratio:
        text += f", ζ = {mode.damping_ratio:.2g}"
    panel.set_title(f"{number}:  {text}", fontsize=9.5, fontweight="normal")


def _is_straight(arm: LinearArm) -> bool:
    return arm.rest is not None and bool(np.max(np.abs(arm.rest.angles)) < 1e-9)


def _draw_chain(panel: Axes, arm: LinearArm, mode: Mode) -> None:
    angles = mode.shape if arm.hub else np.append(0.0, mode.shape)
    marker: Any = "o" if len(angles) <= 30 else None
    panel.axhline(0.0, color=FAINT, linewidth=0.8)
    panel.plot(np.arange(len(angles)), angles, marker=marker, markersize=3.5, color=PALETTE[0])
    panel.set_ylim(-1.15, 1.15)
    panel.locator_params(axis="x", integer=True)


def _nodes(arm: LinearArm, shape: Array) -> tuple[Array, Array]:
    """Return positions of base and link ends, and how the mode moves them, (2, n + 1) each."""
    assert arm.rest is not None
    turned, limbs = shape[int(arm.hub) :], limbs_of(arm.scene)
    angles, lengths = arm.rest.angles, np.array([link.length for link in arm.scene.links])
    along = np.array([lengths * np.cos(angles), lengths * np.sin(angles)])
    across = np.array([-lengths * np.sin(angles) * turned, lengths * np.cos(angles) * turned])
    zero = np.zeros((2, 1))
    place, moved = (np.concatenate([zero, limbs.outward(each.T).T], axis=1) for each in (along, across))
    return place, moved + parts_of(arm).base_moved(shape)[:, None]


def _strokes(arm: LinearArm) -> list[list[int]]:
    """Return the numbers of the nodes along each limb, its root first."""
    return [[host + 1, *range(start + 1, stop + 1)] for start, stop, host in limbs_of(arm.scene).runs]


def _draw_straight(
    panel: Axes, arm: LinearArm, mode: Mode, beam: BeamArm | None, omega: float | None
) -> None:
    place, moved = _nodes(arm, mode.shape)
    deflection = moved[1]
    tip = deflection[-1] if abs(deflection[-1]) > 1e-3 * np.max(np.abs(deflection)) else 1.0
    scale = np.sign(tip) / np.max(np.abs(deflection))
    panel.axhline(0.0, color=FAINT, linewidth=0.8)
    if beam is not None and omega is not None:
        along, exact = beam_shape(beam, omega)
        panel.plot(along, exact, color=PALETTE[1], linewidth=3.2, alpha=0.45, label="continuous beam")
    marker: Any = "o" if place.shape[1] <= 30 else None
    links = f"{arm.scene.stations} link{'s' * (arm.scene.stations > 1)}"
    look: dict[str, Any] = {"marker": marker, "markersize": 3, "linewidth": 1.2, "color": PALETTE[0]}
    for number, nodes in enumerate(_strokes(arm)):
        label = None if number else links
        panel.plot(place[0, nodes], scale * deflection[nodes], label=label, **look)
    panel.set_ylim(-1.2, 1.2)


def _draw_bent(panel: Axes, arm: LinearArm, mode: Mode) -> None:
    place, moved = _nodes(arm, mode.shape)
    step = _SWING * arm.scene.reach / np.max(np.hypot(*moved))
    for number, nodes in enumerate(_strokes(arm)):
        at_rest, way = place[:, nodes], step * moved[:, nodes]
        labels = (None, None) if number else ("at rest", "in the mode")
        panel.plot(*at_rest, color=FAINT, linewidth=1.4, label=labels[0])
        panel.plot(*(at_rest + way), color=PALETTE[0], label=labels[1])
        panel.plot(*(at_rest - way), color=PALETTE[0], linewidth=1.0, alpha=0.45)
    panel.set_aspect("equal", adjustable="datalim")


def bode_picture(answer: Answer, form: str = "png") -> bytes:
    """Draw magnitude and phase of one response; of a vector its largest component.

    Parameters
    ----------
    answer : Answer
        What to draw.
    form : {"png", "svg", "pdf"}
        Format.
    """
    return picture(bode_figure(answer), form)


def bode_figure(answer: Answer) -> Figure:
    """Return the figure that :func:`bode_picture` writes."""
    scene, hertz, beam, shown = answer.scene, answer.hertz, answer.beam, answer.largest
    response = answer.parts[shown]
    with style():
        made, axes = figure(8.0, 5.6, nrows=2, sharex=True, gridspec_kw={"height_ratios": [2.0, 1.0]})
        name = _KINDS[scene.model.kind].format(scene.stations)  # what its curve is called
        curves = [(name, response, PALETTE[0], 1.6, 1.0)]
        if beam is not None:
            curves.insert(0, ("continuous beam", beam, PALETTE[1], 3.4, 0.45))
        for label, values, colour, width, alpha in curves:
            look = {"color": colour, "linewidth": width, "alpha": alpha}
            axes[0].loglog(hertz, np.abs(values), label=label, **look)
            axes[1].semilogx(hertz, _phase(values), **look)
        if beam is not None:
            axes[0].legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, borderaxespad=0.2)
        axes[0].set_ylabel(f"magnitude ({answer.unit})")
        axes[1].set_ylabel("phase (°)")
        axes[1].set_yticks(np.arange(-180, 181, 90))
        axes[1].set_ylim(-195, 195)
        axes[1].set_xlabel("frequency (Hz)")
        axes[1].set_xlim(hertz[0], hertz[-1])
        subtitle(axes[0], scene.title, f"{shown} for a unit of {answer.given.name}")
        made.align_ylabels(axes)
        return made


def _phase(values: Complex) -> Array:
    """Return the phase in degrees, broken where it wraps around."""
    phase = np.degrees(np.angle(values))
    jumps = np.flatnonzero(np.abs(np.diff(phase)) > 180.0) + 1
    broken = phase.copy()
    broken[jumps] = np.nan
    return broken
