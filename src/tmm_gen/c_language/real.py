"""The number type of emitted C."""

from __future__ import annotations

import struct
from dataclasses import dataclass

import numpy as np

from tmm_gen.errors import UserError
from tmm_gen.scene.emit import Emit


@dataclass(frozen=True)
class Real:
    """A floating-point type of C.

    Parameters
    ----------
    name : str
        As scenes say it: "float64" or "float32".
    c : str
        "double" or "float".
    suffix : str
        Of literals and of the functions of ``<math.h>``.
    size : int
        Bytes.
    epsilon : float
        Distance from 1 to the next number.
    pair : bool
        Whether parameters, model and state hold sums of two numbers of the type; inputs and outputs never do.
    """

    name: str
    c: str
    suffix: str
    size: int
    epsilon: float
    pair: bool = False

    @property
    def number_size(self) -> int:
        """Bytes of a number of parameters, model or state."""
        return 2 * self.size if self.pair else self.size

    @property
    def largest_name(self) -> str:
        """Largest finite number, as ``<float.h>`` calls it."""
        return "DBL_MAX" if self.size == 8 else "FLT_MAX"

    @property
    def smallest(self) -> float:
        """The smallest positive number held with all its digits."""
        return 2.0**-126 if self.size == 4 else 2.0**-1022

    @property
    def largest(self) -> float:
        """The largest number."""
        return float(np.finfo(np.float32 if self.size == 4 else np.float64).max)

    def literal(self, value: float) -> str:
        """Write a number: the shortest decimal that reads back as the same ``double``.

        Raises
        ------
        UserError
            If the type cannot hold it.
        """
        self.round(value)
        return repr(float(value)) + self.suffix

    def shortest(self, value: float) -> str:
        """Write a number of the type: the shortest decimal that reads back as the same."""
        return self.literal(float(str(np.float32(value)))) if self.size == 4 else self.literal(value)

    def function(self, name: str) -> str:
        """Return the name of a function of ``<math.h>`` for this type."""
        return name + self.suffix

    def round(self, value: float) -> float:
        """Return the nearest number of the type.

        Raises
        ------
        UserError
            If it is too large, or so small that it would become zero.
        """
        if self.size == 8:
            return float(value)
        try:
            rounded: float = struct.unpack("f", struct.pack("f", value))[0]
        except OverflowError:
            rounded = float("inf")
        if rounded in (float("inf"), float("-inf")) or (rounded == 0) != (value == 0):
            raise UserError(
                f"{value!r} is out of the range of emit.real = '{self.name}'; "
                "write emit.real = 'float64', or choose other units"
            )
        return rounded


DOUBLE = Real("float64", "double", "", 8, 2.0**-52)
FLOAT = Real("float32", "float", "f", 4, 2.0**-23)
COMPENSATED = Real("float32", "float", "f", 4, 2.0**-45, pair=True)
"""Pairs of floats; sums and products of two are right within ``2^-46``."""
REALS: dict[str, Real] = {real.name: real for real in (DOUBLE, FLOAT)}
"""By the name scenes use; see :func:`real_of` for pairs."""


def real_of(emit: Emit) -> Real:
    """Return the number type of a scene's C code."""
    return COMPENSATED if emit.compensated else REALS[emit.real]
