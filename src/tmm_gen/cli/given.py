"""Options that several frequency-domain commands share."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from tmm_gen.cli.outputs import OutputFile
from tmm_gen.errors import UserError

if TYPE_CHECKING:
    from tmm_gen.scene import Scene

PICTURE = "picture"
"""What ``--plot`` without a file stands for."""

_PICTURES = (".png", ".svg", ".pdf")


def picture_option(context: click.Context, parameter: click.Parameter, value: str | None) -> Path | None:
    """Check the name of a picture."""
    if value in (None, PICTURE):
        return None if value is None else Path(value)
    return OutputFile(*_PICTURES).convert(value, parameter, context)


def positive(_context: click.Context, parameter: click.Parameter, value: float | None) -> float | None:
    """Check a positive number."""
    if value is not None and not 0.0 < value < math.inf:
        raise click.BadParameter("must be a positive number", param=parameter)
    return value


def finite(_context: click.Context, parameter: click.Parameter, value: float | None) -> float | None:
    """Check a finite number."""
    if value is not None and not math.isfinite(value):
        raise click.BadParameter("must be a finite number", param=parameter)
    return value


def constant_inputs(scene: Scene, given: Sequence[str]) -> dict[str, float]:
    """Read ``NAME=VALUE`` words.

    Raises
    ------
    UserError
        If a word is none of these, names no input, or the scene is a chain, whose motion no load changes.
    """
    names = [item.name for item in scene.inputs]
    found: dict[str, float] = {}
    for text in given:
        name, equals, value = text.partition("=")
        if scene.model.linear:
            raise UserError(
                f"--input {text}: a chain is linear, its modes do not depend on loads. Leave it out."
            )
        if not equals or name not in names:
            listed = f"inputs are {', '.join(names)}" if names else "the scene has no [[input]]"
            raise UserError(f"--input {text}: write NAME=VALUE; {listed}.")
        try:
            number = float(value)
        except ValueError:
            number = math.nan
        if not math.isfinite(number):
            raise UserError(f"--input {text}: '{value}' is not a number.")
        found[name] = number
    return found
