"""Arguments that must be names, texts or whole numbers."""

from __future__ import annotations

from os import PathLike
from pathlib import Path

import numpy as np

from tmm_gen.errors import UserError

__all__ = ["path_of", "text_of", "whole"]


def path_of(what: str, value: object) -> Path:
    """Return a path.

    Raises
    ------
    UserError
        If it is none.
    """
    if isinstance(value, str | PathLike) and str(value) and "\0" not in str(value):
        return Path(value)
    raise UserError(f"{what}: {value!r} is no name of a file or folder. Name one.")


def text_of(what: str, value: object) -> str:
    """Return a text.

    Raises
    ------
    UserError
        If it is none.
    """
    if isinstance(value, str):
        return value
    raise UserError(f"{what}: takes the text of a scene file, not {type(value).__name__}.")


def whole(what: str, value: object, least: int) -> int:
    """Return a whole number.

    Raises
    ------
    UserError
        If it is none, or too small.
    """
    if isinstance(value, int | np.integer) and not isinstance(value, bool) and value >= least:
        return int(value)
    raise UserError(f"{what}: must be a whole number from {least}, not {value!r}.")
