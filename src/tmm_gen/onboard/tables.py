"""Numbers and tables in C."""

from __future__ import annotations

import textwrap

import numpy as np
from numpy.typing import ArrayLike

from tmm_gen.c_language.real import Real
from tmm_gen.c_language.wrap import INDENT, WIDTH


def number(value: float, real: Real) -> str:
    """Write a number as the shortest decimal that reads back as the nearest of its type; tiny ones become zero.

    Raises
    ------
    ValueError
        If it is not finite, or too large.
    """
    if real.size == 8:
        text = repr(float(value))
    else:
        with np.errstate(over="ignore", under="ignore"):
            rounded = np.float32(value)
        value = float(rounded)
        text = (
            str(rounded)
            if float(str(rounded)) == value or np.float32(str(rounded)) == rounded
            else repr(value)
        )
        if not any(sign in text for sign in ".e"):
            text += ".0"
    if not np.isfinite(value):
        raise ValueError(f"{value!r} is no number of C")
    return text + real.suffix


def table(name: str, values: ArrayLike, dimension: str, real: Real) -> str:
    """Write a constant table.

    Parameters
    ----------
    name : str
        Of the table.
    values : array_like
        One or two axes.
    dimension : str
        Lengths in brackets.
    """
    array = np.asarray(values, float)
    nested = array.ndim == 2
    rows = [", ".join(number(v, real) for v in row) for row in np.atleast_2d(array)]
    lines: list[str] = []
    for row in rows:
        lines += filled(f"{{{row}}}," if nested else row)
    return "\n".join([f"static const real {name}{dimension} = {{", *lines, "};"])


def filled(text: str) -> list[str]:
    """Break a list of numbers into indented lines."""
    return textwrap.wrap(
        text,
        WIDTH,
        initial_indent=INDENT,
        subsequent_indent=INDENT,
        break_long_words=False,
        break_on_hyphens=False,
    )
