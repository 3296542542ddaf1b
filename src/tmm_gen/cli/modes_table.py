"""What tables of modes say of each, whatever kind of arm it is of."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from tmm_gen.modal.modes import Mode

_UNSURE = 1e-6
"""Relative error that a frequency's residual may leave open without a word: the table shows six digits."""


def mode_row(number: int, mode: Mode) -> dict[str, object]:
    """Return what is known of a mode, counted from 0."""
    return {
        "mode": number + 1,
        "frequency_hz": mode.hertz,
        "angular_frequency": mode.frequency,
        "damping_ratio": mode.damping_ratio,
        "poles": [{"real": pole.real, "imaginary": pole.imag} for pole in mode.poles],
        "motion": mode.motion,
        "shape": mode.shape,
        "error_bound": mode.bound,
    }


def say_unsure(rows: Sequence[dict[str, Any]]) -> None:
    """Say which frequencies rounding may spoil."""
    unsure = [row["mode"] for row in rows if row["error_bound"] > _UNSURE]
    if unsure:
        click.echo(
            f"rounding may spoil more than {_UNSURE:g} of the frequency of mode {', '.join(map(str, unsure))} "
            "(error_bound in --json says how much)"
        )
