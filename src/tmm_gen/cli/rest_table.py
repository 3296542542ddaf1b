"""What a table of equilibria says the same way of an arm in a plane and in space."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from tmm_gen.scene import Scene

_DECIMALS = 9
"""Of what the table shows; beyond them an arm that hangs straight would have a tip beside its base."""


def six(value: float) -> str:
    """Return six digits of what is more than rounding."""
    return f"{round(value, _DECIMALS) + 0.0:.6g}"


def title_of(scene: Scene, count: int) -> str:
    """Return the line above the table."""
    return f"{scene.title}: {count} equilibri{'a' if count > 1 else 'um'}"


def say_starts(count: int) -> None:
    """Say from how many starts equilibria were looked for."""
    click.echo(f"looked for from {count} start{'s' * (count > 1)}: there may be more")
