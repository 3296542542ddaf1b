"""Numbers that know how far rounding may take a kernel from them.

Beside its value in many digits, a number carries samples of its rounding error: every operation passes errors on as
its derivative says, to first order, and adds one of its own, of one unit roundoff and of random sign. Worst-case
bounds would be of no use here: they take no account of errors that cancel, and in a sweep over many links they grow
beyond all bounds where real errors do not (Higham, Accuracy and Stability of Numerical Algorithms, section 2.8).
"""

from __future__ import annotations

import random
from dataclasses import dataclass, field
from functools import cache
from typing import Any

import mpmath
import numpy as np
from numpy.typing import NDArray

SAMPLES = 8
_ROWS = 4093
"""A prime, so that remainders of mantissas are spread over all rows."""


@cache  # of use to searches for a test's bounds alone
def _signs() -> NDArray[np.float64]:
    draw = random.Random(2718).random  # the same on every machine and in every version of Python
    return np.array([[1.0 if draw() < 0.5 else -1.0 for _ in range(SAMPLES)] for _ in range(_ROWS)])


_NONE = np.zeros(SAMPLES)


@dataclass(eq=False, slots=True)  # not frozen: to make one takes as long as to multiply two
class Estimate:
    """A value and samples of its error; not to be changed.

    Parameters
    ----------
    value : mpmath.mpf
        As exact as its precision.
    errors : array, shape (SAMPLES,)
        What a kernel's value may be off, in units of its type's unit roundoff (half its epsilon).

    Attributes
    ----------
    plain : float
        The value, rounded.
    """

    value: Any
    errors: NDArray[np.float64] = field(default_factory=lambda: _NONE)
    plain: float = field(init=False)

    def __post_init__(self) -> None:
        """Round once: every operation asks."""
        self.plain = float(self.value)

    @property
    def error(self) -> float:
        """The largest of the samples, and one rounding more: that of the value as it is written down."""
        return float(np.abs(self.errors).max()) + abs(self.plain)

    def _mpmath_(self, *_: object) -> Any:
        """Say that it is no number of mpmath's, where one of them stands on the left: the operation is ours.

        What mpmath says by itself holds all digits of both in words, which takes ten times as long as to multiply.
        """
        raise TypeError

    def __add__(self, other: object) -> Estimate:
        """Add."""
        other = estimate_of(other)
        return _rounded(self.value + other.value, self.errors + other.errors)

    def __sub__(self, other: object) -> Estimate:
        """Subtract."""
        other = estimate_of(other)
        return _rounded(self.value - other.value, self.errors - other.errors)

    def __rsub__(self, other: object) -> Estimate:
        """Subtract from a number."""
        return estimate_of(other) - self

    def __neg__(self) -> Estimate:
        """Change sign, which is exact."""
        return Estimate(-self.value, -self.errors)

    def __mul__(self, other: object) -> Estimate:
        """Multiply."""
        other = estimate_of(other)
        return _rounded(self.value * other.value, self.plain * other.errors + other.plain * self.errors)

    def __truediv__(self, other: object) -> Estimate:
        """Divide."""
        other = estimate_of(other)
        quotient = self.value / other.value
        errors = (self.errors - float(quotient) * other.errors) / other.plain
        return _rounded(quotient, errors)

    def __rtruediv__(self, other: object) -> Estimate:
        """Divide a number."""
        return estimate_of(other) / self

    def __pow__(self, exponent: int) -> Estimate:
        """Multiply with itself, as backends write whole powers."""
        product = self
        for _ in range(abs(int(exponent)) - 1):
            product = product * self
        return product if exponent > 0 else 1 / product

    def __gt__(self, other: float) -> bool:
        """Compare values."""
        return bool(self.value > other)

    __radd__ = __add__
    __rmul__ = __mul__


def sine(angle: Estimate) -> Estimate:
    """Return the sine; libraries are right to one unit in the last place, two roundoffs."""
    return _rounded(mpmath.sin(angle.value), float(mpmath.cos(angle.value)) * angle.errors, 2.0)


def cosine(angle: Estimate) -> Estimate:
    """Return the cosine, as right as the sine."""
    return _rounded(mpmath.cos(angle.value), -float(mpmath.sin(angle.value)) * angle.errors, 2.0)


def root(number: object) -> Estimate:
    """Return the square root, which is rounded once; also of a constant, as coefficients of integrators have it."""
    square = estimate_of(number)
    found = mpmath.sqrt(square.value)
    return _rounded(found, square.errors / (2.0 * float(found)))


FUNCTIONS = ({"sin": sine, "cos": cosine, "sqrt": root}, "mpmath")
"""As modules of :func:`sympy.lambdify`."""


def estimate_of(number: object) -> Estimate:
    """Return a constant of an expression; whole numbers are exact, others rounded."""
    if isinstance(number, Estimate):
        return number
    value = mpmath.mpf(number)
    return Estimate(value) if isinstance(number, int) else _rounded(value, _NONE)


def _rounded(value: Any, errors: NDArray[np.float64], units: float = 1.0) -> Estimate:
    """Return a result with a rounding error of its own, whose signs follow from its digits."""
    found = Estimate(value)
    found.errors = errors + units * found.plain * _signs()[value.man % _ROWS]
    return found
