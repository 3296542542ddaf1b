"""Numbers as a scene writes them: derived ones are worked out exactly, and rounded once."""

from __future__ import annotations

import math
from fractions import Fraction


def exact(value: float) -> Fraction:
    """Return a number as the scene writes it: the shortest decimal that reads back as the same."""
    return Fraction(repr(float(value)))


def nearest(value: Fraction) -> float:
    """Return the nearest number, which is written as shortly as a person would: 34.5, not 34.49999999999999."""
    try:
        return float(value)
    except OverflowError:
        return math.inf
