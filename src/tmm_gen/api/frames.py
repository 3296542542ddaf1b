"""Data frames, where pandas is installed."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from tmm_gen.errors import UserError
from tmm_gen.extras import install

__all__ = ["pandas"]


def pandas() -> Any:
    """Import pandas.

    Raises
    ------
    UserError
        If it is not installed.
    """
    try:
        return import_module("pandas")
    except ImportError:
        raise UserError(f"to_pandas() needs pandas, which is not installed: {install('pandas')}") from None
