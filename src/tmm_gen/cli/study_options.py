"""Options that say what a study varies, shared by `trade` and `tune`."""

from __future__ import annotations

import math
import os
from collections.abc import Callable
from functools import partial

import click


def one_thread() -> None:
    """Keep linear algebra to one thread: for small matrices more only wait for each other on a busy machine.

    Has an effect if NumPy has not been imported yet.
    """
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")


def words(_context: click.Context, _parameter: click.Parameter, value: str | None) -> tuple[str, ...]:
    """Split a list at its commas."""
    return tuple(word.strip() for word in (value or "").split(",") if word.strip())


def numbers(_context: click.Context, parameter: click.Parameter, value: str | None) -> tuple[float, ...]:
    """Read positive numbers between commas."""
    found = []
    for word in words(_context, parameter, value):
        try:
            number = float(word)
        except ValueError:
            number = math.nan
        if not 0.0 < number < math.inf:
            raise click.BadParameter(f"'{word}' is no positive number", param=parameter)
        found.append(number)
    return tuple(found)


def whole_numbers(
    _context: click.Context, parameter: click.Parameter, value: str | None, *, least: int = 1
) -> tuple[int, ...]:
    """Read whole numbers between commas, positive or from another least one."""
    found = []
    for word in words(_context, parameter, value):
        if not word.isdecimal() or int(word) < least:
            what = "positive whole number" if least == 1 else f"whole number from {least}"
            raise click.BadParameter(f"'{word}' is no {what}", param=parameter)
        found.append(int(word))
    return tuple(found)


corrections_option = click.option(
    "--corrections",
    metavar="N,N",
    callback=partial(whole_numbers, least=0),
    help="Corrections per stage of an arm in a plane, behind its sweeps; by default the scene's.",
)
"""What `trade` and `tune` vary of corrections."""


def one_of(*choices: str) -> Callable[[click.Context, click.Parameter, str | None], tuple[str, ...]]:
    """Return a callback that reads some of several words."""

    def read(context: click.Context, parameter: click.Parameter, value: str | None) -> tuple[str, ...]:
        found = words(context, parameter, value)
        for word in found:
            if word not in choices:
                raise click.BadParameter(f"'{word}' is none of {', '.join(choices)}", param=parameter)
        return found

    return read
