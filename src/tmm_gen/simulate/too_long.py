"""The refusal of a run whose step is too long for its motion: shorter steps may mend it."""

from __future__ import annotations

from tmm_gen.errors import UserError

LEAST = 4.0
"""How many times shorter a step is tried where nothing tells it."""


class TooLongError(UserError):
    """A motion that its steps do not follow.

    Parameters
    ----------
    message : str
        What is wrong and what to do.
    reason : str
        The same in a clause, of the run that was refused.
    times : float
        How many times shorter a step has to be, as far as can be told.
    """

    def __init__(
        self, message: str = "", *, reason: str = "the equations could not be solved", times: float = LEAST
    ) -> None:
        super().__init__(message)
        self.reason = reason
        self.times = times
