"""How long the next step is to be: a PI controller whose steps are rungs of a ladder.

With K. Gustafsson, Control theoretic techniques for stepsize selection in explicit Runge-Kutta methods, ACM Trans.
Math. Softw. 17 (1991), and the factors of E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, 2nd ed.
1996, section IV.2. What a kernel prepares for a length is kept for each rung.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

RATIO = math.sqrt(2.0)
"""From rung to rung; half of a step is two rungs below it."""

_SAFETY = 0.9
_P, _I = 0.4, 0.7
"""Weights of the last error but one and of the last, over the order of the error of a step."""

_SHRINK, _GROW = 0.1, 4.0
"""A step is no more than so many times as long as the one before."""

_BLOW = 0.25
"""Where a step could not be taken at all, or was refused twice: its error says nothing of the next one's."""

_LEAST_ERROR = 1e-4
"""A smaller error may be chance."""


@dataclass(eq=False)
class Ladder:
    """Lengths of steps.

    Parameters
    ----------
    first : float
        Length of the rung zero, s.
    order : float
        Of the integrator: the error of a step is of one order more.
    """

    first: float
    order: float
    _before: float = field(default=1.0, repr=False)
    _refused: int = field(default=0, repr=False)

    def rung(self, length: float) -> float:
        """Return the longest rung that is no longer than asked for, s."""
        number = math.floor(math.log(length / self.first) / math.log(RATIO) + 1e-9)
        # half a step has to be exactly a rung: powers of two are exact, and odd rungs are multiples of one root
        half, odd = divmod(number, 2)
        return float(math.ldexp(self.first * (RATIO if odd else 1.0), half))

    def accepted(self, length: float, wanted: float, error: float) -> float:
        """Return how long the next step is to be.

        Parameters
        ----------
        length, wanted : float
            Of the step that was kept, and as long as it was to be before a rung or a stop was looked for, s.
        error : float
            Of that step, as a share of what it may be.
        """
        if length * RATIO < wanted * (1.0 - 1e-9):  # cut short by a stop: says little of the steps behind it
            self._refused = 0
            return wanted
        k = self.order + 1.0
        error = max(error, _LEAST_ERROR)
        factor: float = _SAFETY * error ** (-_I / k) * self._before ** (_P / k)
        most = 1.0 if self._refused else _GROW
        self._before, self._refused = error, 0
        # not from the rung: small changes have to add up to the next one
        return wanted * min(max(factor, _SHRINK), most)

    def refused(self, length: float, error: float) -> float:
        """Return how long to try it next, by the error of a step that was not kept; infinite where it failed."""
        self._refused += 1
        factor = _BLOW
        if math.isfinite(error):
            factor = _SAFETY * error ** (-1.0 / (self.order + 1.0))
            factor = min(factor, _BLOW if self._refused > 1 else 1.0 / RATIO)
        return length * max(factor, _SHRINK)


def landing(length: float, left: float) -> tuple[float, bool]:
    """Return how long a step is with so much left to the next stop, and whether it ends there.

    Two steps are made equally long rather than one of them tiny.
    """
    if length >= left * (1.0 - 1e-9):
        return left, True
    return (0.5 * left, False) if 2.0 * length >= left * (1.0 - 1e-9) else (length, False)
