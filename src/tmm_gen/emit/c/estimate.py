"""Numbers that know how far rounding can have taken a kernel from them.

First-order running error analysis (Wilkinson; Higham, Accuracy and Stability of Numerical Algorithms, section
3.3): beside its value in many digits, a number carries a bound of its rounding error in units of the unit
roundoff. It holds with or without fused multiply-add.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import mpmath


@dataclass(frozen=True)
class Estimate:
    """A value and a bound of its error.

    Parameters
    ----------
    value : mpmath.mpf
        As exact as its precision.
    error : float
        Bound of the error of a kernel's value, in units of its type's unit roundoff (half its epsilon).
    """

    value: Any
    error: float = 0.0

    def __add__(self, other: object) -> Estimate:
        """Add."""
        other = estimate_of(other)
        return _rounded(self.value + other.value, self.error + other.error)

    def __sub__(self, other: object) -> Estimate:
        """Subtract."""
        other = estimate_of(other)
        return _rounded(self.value - other.value, self.error + other.error)

    def __rsub__(self, other: object) -> Estimate:
        """Subtract from a number."""
        return estimate_of(other) - self

    def __neg__(self) -> Estimate:
        """Change sign, which is exact."""
        return Estimate(-self.value, self.error)

    def __mul__(self, other: object) -> Estimate:
        """Multiply."""
        other = estimate_of(other)
        error = _size(self.value) * other.error + _size(other.value) * self.error
        return _rounded(self.value * other.value, error)

    def __truediv__(self, other: object) -> Estimate:
        """Divide."""
        other = estimate_of(other)
        quotient = self.value / other.value
        return _rounded(quotient, (self.error + _size(quotient) * other.error) / _size(other.value))

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
    value = mpmath.sin(angle.value)
    return Estimate(value, angle.error * _size(mpmath.cos(angle.value)) + 2.0 * _size(value))


def cosine(angle: Estimate) -> Estimate:
    """Return the cosine."""
    value = mpmath.cos(angle.value)
    return Estimate(value, angle.error * _size(mpmath.sin(angle.value)) + 2.0 * _size(value))


FUNCTIONS = ({"sin": sine, "cos": cosine}, "mpmath")
"""As modules of :func:`sympy.lambdify`."""


def estimate_of(number: object) -> Estimate:
    """Return a constant of an expression, which a kernel holds to rounding."""
    if isinstance(number, Estimate):
        return number
    value = mpmath.mpf(number)
    return Estimate(value, 0.0 if isinstance(number, int) else _size(value))


def _rounded(value: Any, error: float) -> Estimate:
    return Estimate(value, error + _size(value))


def _size(value: Any) -> float:
    return abs(float(value))
