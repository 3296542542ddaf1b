"""Closed loops as a picture: the tip's angle and the torque, a column for each condition."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from tmm_gen.closed_loop.compare import Trial
from tmm_gen.closed_loop.figures import BAND
from tmm_gen.control.problem import ControlProblem
from tmm_gen.style import FAINT, PALETTE, figure, picture, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_LINES = ("-", "--", ":", "-.")
_WIDTH = 4.2
"""Of a column, inches."""


def comparison_picture(trials: Sequence[Trial], problem: ControlProblem, form: str = "png") -> bytes:
    """Draw trials.

    Parameters
    ----------
    trials : sequence of Trial
        At least one.
    problem : ControlProblem
        Gives the reference and the bounds.
    form : {"png", "svg", "pdf"}
        Format.
    """
    conditions = list(dict.fromkeys(trial.condition for trial in trials))
    names = list(dict.fromkeys(trial.kind.name for trial in trials))
    with style():
        made, spare = figure(max(8.0, 0.8 + _WIDTH * len(conditions)), 6.4)
        spare.remove()
        axes = made.subplots(
            2,
            len(conditions),
            sharex=True,
            sharey="row",
            squeeze=False,
            gridspec_kw={"height_ratios": [3, 2]},
        )
        for column, condition in enumerate(conditions):
            upper, lower = axes[:, column]
            _targets(upper, lower, problem)
            upper.set_title(condition.title)
            lower.set_xlabel("time (s)")
            for trial in trials:
                if trial.condition is condition:
                    _curves(upper, lower, trial, names.index(trial.kind.name))
        way = problem.reference - problem.start
        edges = np.array([problem.start - 0.1 * way, problem.reference + 0.25 * way])
        axes[0, 0].set_ylim(edges.min(), edges.max())
        axes[0, 0].set_ylabel("tip angle (rad)")
        axes[1, 0].set_ylabel("torque (N m)")
        axes[0, 0].legend(loc="lower right")
        return picture(made, form)


def _targets(upper: Axes, lower: Axes, problem: ControlProblem) -> None:
    """Draw the reference with its band, and the bounds of the torque."""
    width = BAND * abs(problem.reference - problem.start)
    upper.axhspan(problem.reference - width, problem.reference + width, color=FAINT, alpha=0.25, linewidth=0)
    for bound in problem.torque:
        lower.axhline(bound, color=FAINT, linewidth=1.0, linestyle=":")


def _curves(upper: Axes, lower: Axes, trial: Trial, number: int) -> None:
    colour, line = PALETTE[number % len(PALETTE)], _LINES[number // len(PALETTE) % len(_LINES)]
    loop = trial.loop
    upper.plot(loop.time, loop.tip, color=colour, linestyle=line, label=trial.kind.title)
    lower.step(loop.sampled, loop.torque, where="post", color=colour, linestyle=line, linewidth=1.2)
