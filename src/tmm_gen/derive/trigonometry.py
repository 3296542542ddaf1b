"""Sine and cosine from additions and multiplications alone, so that every machine gives the same bits.

An angle is brought to within an eighth of a turn by subtracting whole quarters, in parts whose products are exact
(Cody and Waite, Software Manual for the Elementary Functions, 1980). There, near-minimax polynomials (Chebyshev
expansions, by mpmath in 50 digits) stand for the functions; of as many terms as the number type can tell. The quarters
are put back by the theorem of addition, with sines and cosines of 0 and 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any

import mpmath

DIGITS = 50
_MARGIN = 1.0 + 2.0**-8
"""By how much the reduced angle may exceed an eighth of a turn: the multiple is that of a rounded quotient."""
_TERMS = 24
"""Of the series: far more than 50 digits need."""
_SPARE = 2
"""Bits by which polynomials are better than half a unit in the last place."""


@dataclass(frozen=True)
class Trigonometry:
    """Constants of sine and cosine in one number type, each exact in that type.

    Parameters
    ----------
    digits : int
        Of the significand in bits: 24 or 53.
    quarters_per_radian : float
        ``2/pi``.
    whole : float
        Added and subtracted, it rounds to a whole number.
    quarter : tuple of float
        ``pi/2`` in parts of few bits, the largest first.
    sine : tuple of float
        ``sin(r) = r + r z (s[0] + z (s[1] + ...))``, ``z = r^2``.
    cosine : tuple of float
        ``cos(r) = 1 - z/2 + z^2 (c[0] + z (c[1] + ...))``.
    largest_angle : float
        Up to which products of quarters and parts are exact, rad.
    """

    digits: int
    quarters_per_radian: float
    whole: float
    quarter: tuple[float, ...]
    sine: tuple[float, ...]
    cosine: tuple[float, ...]
    largest_angle: float


@cache
def trigonometry(digits: int, count_bits: int) -> Trigonometry:
    """Derive the constants of a number type.

    Parameters
    ----------
    digits : int
        Bits of its significand, the leading one included.
    count_bits : int
        Bits of the number of quarters; the more, the larger the angles, and the fewer the bits of a part.

    Returns
    -------
    Trigonometry
        For angles up to ``2**count_bits`` quarters of a turn.
    """
    with mpmath.workdps(DIGITS):
        quarter = mpmath.pi / 2
        end = (mpmath.pi / 4 * _MARGIN) ** 2
        return Trigonometry(
            digits=digits,
            quarters_per_radian=float(_rounded(1 / quarter, digits)),
            whole=float(mpmath.mpf(3) * 2 ** (digits - 2)),
            quarter=_parts(quarter, digits, count_bits),
            sine=_polynomial(_sine_beyond, end, end, digits),
            cosine=_polynomial(_cosine_beyond, end, end**2, digits),
            largest_angle=float(mpmath.floor(2**count_bits * quarter)),
        )


def _sine_beyond(z: Any) -> Any:
    """Return ``(sin(r) - r) / r^3`` of ``z = r^2``."""
    return _series(z, 3)


def _cosine_beyond(z: Any) -> Any:
    """Return ``(cos(r) - 1 + z/2) / z^2`` of ``z = r^2``."""
    return _series(z, 4)


def _series(z: Any, first: int) -> Any:
    """Sum ``sign (-z)^k / (first + 2k)!``, the series of sine or cosine from that power on."""
    sign = -1 if first % 4 in (2, 3) else 1
    return sign * mpmath.fsum((-z) ** k / mpmath.factorial(first + 2 * k) for k in range(_TERMS))


def _polynomial(function: Any, end: Any, weight: Any, digits: int) -> tuple[float, ...]:
    """Return coefficients, lowest first, of the shortest polynomial that is good enough on ``[0, end]``."""
    allowed = mpmath.mpf(2) ** -(digits + _SPARE)
    for terms in range(1, 20):
        coefficients, error = mpmath.chebyfit(function, [0, end], terms, error=True)
        if error * weight <= allowed:
            return tuple(float(_rounded(c, digits)) for c in reversed(coefficients))
    raise ArithmeticError("no polynomial is good enough")


def _parts(value: Any, digits: int, count_bits: int) -> tuple[float, ...]:
    """Split a number: all parts but the last so short that their products with a count are exact."""
    parts = []
    for bits in (digits - count_bits, digits - count_bits, digits):
        parts.append(_rounded(value, bits))
        value -= parts[-1]
    return tuple(float(part) for part in parts)


def _rounded(value: Any, bits: int) -> Any:
    """Round to a number of significant bits."""
    with mpmath.workprec(bits):
        return +mpmath.mpf(value)
