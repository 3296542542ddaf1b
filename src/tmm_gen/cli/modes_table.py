"""What tables of modes say of each, whatever kind of arm it is of."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import click

_UNSURE = 1e-6
"""Relative error that a frequency's residual may leave open without a word: the table shows six digits."""


def say_unsure(rows: Sequence[dict[str, Any]]) -> None:
    """Say which frequencies rounding may spoil."""
    unsure = [row["mode"] for row in rows if row["error_bound"] > _UNSURE]
    if unsure:
        click.echo(
            f"rounding may spoil more than {_UNSURE:g} of the frequency of mode {', '.join(map(str, unsure))} "
            "(error_bound in --json says how much)"
        )
