"""Errors a user can mend, each with the exit code the command line ends with.

Anything else that escapes a command is a defect of tmm-gen and keeps its traceback.
"""

from __future__ import annotations

import os
import traceback
from typing import ClassVar

__all__ = ["CheckFailed", "UserError", "beyond", "of_numbers"]

_OF_LIBRARIES = ("infs or NaNs", "invalid numeric entries", "too far from generalized Schur form")
"""In what words NumPy and SciPy refuse numbers that are none."""


class UserError(Exception):
    """Bad usage or a bad scene: the message says what is wrong, where, and how to mend it.

    Subclasses may set another ``exit_code``; the command line prints ``error: <message>`` on
    standard error and ends with it.
    """

    exit_code: ClassVar[int] = 2


class CheckFailed(UserError):  # noqa: N818 - it names an outcome, not a mistake
    """A check ran to its end and did not hold: drifted files, a figure out of its tolerance."""

    exit_code: ClassVar[int] = 1


def of_numbers(error: Exception) -> bool:
    """Return whether an error is what numbers do that leave the range of floating point."""
    named = {kind.__name__ for kind in type(error).__mro__}
    if isinstance(error, ValueError) and any(words in str(error) for words in _OF_LIBRARIES):
        return True
    return bool(named & {"ArithmeticError", "LinAlgError"})


def beyond(error: Exception) -> str:
    """Say of a scene, to be read after its name, that its numbers leave the range of floating point, and where."""
    place = traceback.extract_tb(error.__traceback__)[-1]
    return (
        f"its numbers leave the range of floating point ({type(error).__name__}: {error}, in "
        f"{place.filename.rpartition(os.sep)[2]}:{place.lineno}). Choose units in which they are nearer to 1; if they "
        "are ordinary ones, this is a defect of tmm-gen."
    )
