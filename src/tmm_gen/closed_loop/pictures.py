"""Closed loops as a picture: the angle of each tip and its motor's torque, a column for each condition."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from tmm_gen.closed_loop.compare import Trial
from tmm_gen.closed_loop.figures import BAND, way_of
from tmm_gen.closed_loop.loop import Loop
from tmm_gen.control.task.problem import ControlProblem
from tmm_gen.style import FAINT, PALETTE, figure, picture, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_LINES = ("-", "--", ":", "-.")
_WIDTH = 4.2
"""Of a column, inches."""


def comparison_picture(trials: Sequence[Trial], problem: ControlProblem, form: str = "png") -> bytes:
    """Draw :func:`comparison_figure` into a file's bytes, in a format: "png", "svg" or "pdf"."""
    return picture(comparison_figure(trials, problem), form)


def comparison_figure(trials: Sequence[Trial], problem: ControlProblem) -> Figure:
    """Draw trials: a column for each condition, tip angle and torque of each motor.

    Parameters
    ----------
    trials : sequence of Trial
        At least one.
    problem : ControlProblem
        Gives motors and bounds.
    """
    conditions = list(dict.fromkeys(trial.condition for trial in trials))
    kinds = list(dict.fromkeys(trial.kind.name for trial in trials))
    motors = problem.motors.names
    with style():
        made, spare = figure(max(8.0, 0.8 + _WIDTH * len(conditions)), 6.4 * len(motors))
        spare.remove()
        axes = made.subplots(
            2 * len(motors),
            len(conditions),
            sharex=True,
            sharey="row",
            squeeze=False,
            gridspec_kw={"height_ratios": [3, 2] * len(motors)},
        )
        for column, condition in enumerate(conditions):
            axes[0, column].set_title(condition.title)
            axes[-1, column].set_xlabel("time (s)")
            shown = [trial for trial in trials if trial.condition is condition]
            for k in range(len(motors)):
                upper, lower = axes[2 * k : 2 * k + 2, column]
                _targets(upper, lower, problem, shown[0].loop, k)
                for trial in shown:
                    _curves(upper, lower, trial, kinds.index(trial.kind.name), k)
        for k, name in enumerate(motors):
            whose = "" if problem.motors.on_hub else f" of {name}"
            if trials[0].loop.wanted is None:
                axes[2 * k, 0].set_ylim(*_span([trial.loop for trial in trials], k))
            axes[2 * k, 0].set_ylabel(f"tip angle{whose} (rad)")
            axes[2 * k + 1, 0].set_ylabel(f"torque{whose} (N m)")
        axes[0, 0].legend(loc="lower right")
        return made


def _span(loops: Sequence[Loop], k: int) -> tuple[float, float]:
    """Return what a motor's panel shows: its tip's way with some room, not all of a loop that goes astray."""
    loop, way = loops[0], way_of(loops[0])
    ends = np.array([loop.tip[0, k], loop.goal[k]])
    seen = np.concatenate([ends, *(each.tip[:, k] for each in loops)])
    seen = seen[np.isfinite(seen)]
    if way:
        seen = np.clip(seen, ends.min() - 0.25 * way, ends.max() + 0.25 * way)
    room = 2.0 * BAND * way or 0.05 * float(np.ptp(seen)) or 1.0
    return float(seen.min()) - room, float(seen.max()) + room


def _targets(upper: Axes, lower: Axes, problem: ControlProblem, loop: Loop, k: int) -> None:
    """Draw a motor's reference with its band, or what its joint is to follow, and the bounds of its torque."""
    width, goal = BAND * way_of(loop), loop.goal[k]
    if loop.wanted is None:
        band = f"target, within {100.0 * BAND:g} % of the way"
        upper.axhspan(goal - width, goal + width, color=FAINT, alpha=0.25, linewidth=0, label=band)
    else:  # tips sag from it
        upper.plot(loop.sampled, loop.wanted[:, k], color=FAINT, linewidth=3.0, label="joint, as asked for")
    for bound in problem.torque:
        lower.axhline(bound[k], color=FAINT, linewidth=1.0, linestyle=":")


def _curves(upper: Axes, lower: Axes, trial: Trial, number: int, k: int) -> None:
    colour, line = PALETTE[number % len(PALETTE)], _LINES[number // len(PALETTE) % len(_LINES)]
    loop = trial.loop
    upper.plot(loop.time, loop.tip[:, k], color=colour, linestyle=line, label=trial.kind.title)
    lower.step(loop.sampled, loop.torque[:, k], where="post", color=colour, linestyle=line, linewidth=1.2)
