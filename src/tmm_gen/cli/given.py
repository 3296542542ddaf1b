"""Options that several frequency-domain commands share."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import click

from tmm_gen.cli.outputs import OutputFile

_Command = TypeVar("_Command", bound=Callable[..., Any])

PICTURE = "picture"
"""What ``--plot`` without a file stands for."""

_PICTURES = (".png", ".svg", ".pdf")


def plot_option(what: str, ending: str = "") -> Callable[[_Command], _Command]:
    """Return the option ``--plot``; gives a command the argument ``picture``.

    Parameters
    ----------
    what : str
        What is drawn, to be read after "Draw".
    ending : str
        Of the file that is written by default, between the scene's name and ``.png``.
    """
    return click.option(
        "--plot",
        "picture",
        metavar="[FILE.png]",
        is_flag=False,
        flag_value=PICTURE,
        callback=_picture,
        help=f"Draw {what}; by default into NAME{ending}.png.",
    )


resting_input_option = click.option(
    "--input",
    "given",
    metavar="NAME=VALUE",
    multiple=True,
    help="A constant input that an arm rests under. Repeatable; the rest is zero.",
)
"""The option of commands that look at an arm at rest; gives a command the argument ``given``."""


def picture_file(picture: Path, name: str, ending: str = "") -> Path:
    """Return where a picture goes: the file that was named, or one by the scene's name."""
    return Path(f"{name}{ending}.png") if picture == Path(PICTURE) else picture


def _picture(context: click.Context, parameter: click.Parameter, value: str | None) -> Path | None:
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
