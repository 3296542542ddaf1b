"""Comparison of two runs bit for bit."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass

from tmm_gen.c_language.real import Real
from tmm_gen.target.run import HarnessRun


@dataclass(frozen=True)
class Difference:
    """How two runs differ.

    Parameters
    ----------
    first : str
        Key of the first line that differs ("hash0"); "" where none does.
    one_step : float
        Largest difference of a number of the state after one step, relative to the largest number of the state.
    last_step : float
        The same after the last step.
    """

    first: str
    one_step: float
    last_step: float

    @property
    def equal(self) -> bool:
        """Whether all bits are equal."""
        return not self.first


def compare_bits(one: HarnessRun, other: HarnessRun, real: Real) -> Difference:
    """Compare what two machines computed.

    Parameters
    ----------
    one, other : HarnessRun
        Of the same harness.
    real : Real
        Number type.
    """
    keys = [key for key in one.bits if key in other.bits]
    if set(one.bits) != set(other.bits):
        raise ValueError("the runs are of different harnesses")
    first = next((key for key in keys if one.bits[key] != other.bits[key]), "")
    return Difference(
        first, *(_apart(one.bits[which], other.bits[which], real) for which in ("first", "last"))
    )


def _apart(one: str, other: str, real: Real) -> float:
    a, b = list(numbers(one, real)), list(numbers(other, real))
    largest = max((abs(x) for x in a), default=0.0) or 1.0
    return max((abs(x - y) for x, y in zip(a, b, strict=True)), default=0.0) / largest


def numbers(text: str, real: Real) -> Iterator[float]:
    """Yield the numbers of a line of bits, bytes in the order of memory, the lowest first."""
    for word in text.split():
        if len(word) == 2 * real.size:
            yield struct.unpack("<d" if real.size == 8 else "<f", bytes.fromhex(word))[0]
