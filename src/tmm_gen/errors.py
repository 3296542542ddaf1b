"""Errors a user can mend, each with the exit code the command line ends with.

Anything else that escapes a command is a defect of tmm-gen and keeps its traceback.
"""

from __future__ import annotations

from typing import ClassVar

__all__ = ["CheckFailed", "UserError"]


class UserError(Exception):
    """Bad usage or a bad scene: the message says what is wrong, where, and how to mend it.

    Subclasses may set another ``exit_code``; the command line prints ``error: <message>`` on
    standard error and ends with it.
    """

    exit_code: ClassVar[int] = 2


class CheckFailed(UserError):  # noqa: N818 - it names an outcome, not a mistake
    """A check ran to its end and did not hold: drifted files, a figure out of its tolerance."""

    exit_code: ClassVar[int] = 1
