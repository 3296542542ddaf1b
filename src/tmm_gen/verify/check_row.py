"""One comparison of a check."""

from __future__ import annotations

from dataclasses import dataclass

SLOPE = 0.1
"""How far a fitted order may be from the derived one."""


@dataclass(frozen=True)
class CheckRow:
    """One comparison.

    Parameters
    ----------
    check : str
        Key.
    value, bound : float
        What was found, and what it may be at most.
    meaning : str
        In a sentence.
    why : str
        Where the value is none since something broke off, or is too large for a known reason: that reason.
    """

    check: str
    value: float
    bound: float
    meaning: str
    why: str = ""

    @property
    def passed(self) -> bool:
        """Whether the value is within its bound; what is no number is not."""
        return self.value <= self.bound
