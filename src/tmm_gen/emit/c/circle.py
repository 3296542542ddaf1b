"""Own sine and cosine in C: constants for the template, and where the code needs them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

import sympy as sp

from tmm_gen.c_language.real import FLOAT, Real
from tmm_gen.derive.trigonometry import Trigonometry, trigonometry
from tmm_gen.emit.c.pair import pair_literal
from tmm_gen.program.statements import Program, Routine
from tmm_gen.program.variables import Ref, refs_in

COUNT_BITS = {"float32": 12, "float64": 20}
"""Bits of the number of quarter turns, by number type: a thousand turns, and a quarter of a million."""
ERROR = 2.25
"""Largest error of sine and cosine in units of ``2^-digits``, half a unit in the last place of 1."""
PAIR_DIGITS = 48
"""Of a sum of two floats."""
PAIR_ERROR = 2.0**-45
"""Largest error of sine and cosine of such a sum, relative to 1 and to the angle, whichever is larger."""
_DIGITS = {"float32": 24, "float64": 53}
_WORD = {"float32": "uint32_t", "float64": "uint64_t"}


def constants(real: Real) -> Trigonometry:
    """Return the constants of a number type."""
    if real.pair:
        return trigonometry(PAIR_DIGITS, COUNT_BITS["float64"])
    return trigonometry(_DIGITS[real.name], COUNT_BITS[real.name])


def error_of(real: Real) -> float:
    """Return the largest error of sine and cosine of a number type, up to its largest angle."""
    return PAIR_ERROR if real.pair else ERROR * 2.0 ** -constants(real).digits


@dataclass(frozen=True)
class Circle:
    """What the template of sine and cosine asks for, as literals.

    Parameters
    ----------
    real : Real
        Number type.
    """

    real: Real
    by_bits: bool = False
    """Whether quarter turns are made of bits instead of looked up in a table, which vectors of numbers cannot do."""

    @property
    def sign_shift(self) -> int:
        """By how many bits the second lowest one is shifted to become the sign."""
        return 62 if self.real.name == "float64" else 30

    @property
    def word(self) -> str:
        """Unsigned integer of the size of a number."""
        return _WORD[self.real.name]

    @property
    def error(self) -> str:
        """Largest error, in decimal."""
        return f"{error_of(self.real):.1e}"

    @property
    def largest_angle(self) -> str:
        """Largest angle for which the stated error holds, in decimal."""
        return f"{constants(self.real).largest_angle:.0f}"

    @property
    def quarters(self) -> str:
        """``2/pi``."""
        return self.real.shortest(constants(self.real).quarters_per_radian)

    @property
    def whole(self) -> str:
        """What rounds to whole numbers."""
        return self.real.shortest(constants(self.real).whole)

    @property
    def parts(self) -> list[str]:
        """``pi/2`` in parts."""
        return [self.real.shortest(part) for part in constants(self.real).quarter]

    @property
    def sine(self) -> list[str]:
        """Coefficients of the sine, the last first."""
        return [self.real.shortest(c) for c in reversed(constants(self.real).sine)]

    @property
    def cosine(self) -> list[str]:
        """Coefficients of the cosine, the last first."""
        return [self.real.shortest(c) for c in reversed(constants(self.real).cosine)]

    def number(self, value: float) -> str:
        """Write a number."""
        return self.real.literal(value)


class PairCircle(Circle):
    """The same for numbers that are sums of two: constants are such sums where they have to be."""

    @property
    def quarters(self) -> str:
        """``2/pi``: a float, as it only counts."""
        return FLOAT.shortest(constants(FLOAT).quarters_per_radian)

    @property
    def whole(self) -> str:
        """What rounds a float to whole numbers."""
        return FLOAT.shortest(constants(FLOAT).whole)

    @property
    def quarter(self) -> str:
        """``pi/2``."""
        return pair_literal(math.pi / 2.0)

    @property
    def sine(self) -> list[str]:
        """Coefficients of the sine, the last first."""
        return [pair_literal(c) for c in reversed(constants(self.real).sine)]

    @property
    def cosine(self) -> list[str]:
        """Coefficients of the cosine, the last first."""
        return [pair_literal(c) for c in reversed(constants(self.real).cosine)]


@dataclass
class Turns:
    """Angles whose sine and cosine are known within one block of C: each is computed once.

    Parameters
    ----------
    names : iterator of str
        For variables of the function.
    known : dict from sympy.Expr to str
        Variables by angle.
    """

    names: Iterator[str]
    known: dict[sp.Expr, str] = field(default_factory=dict)

    def new_in(self, value: sp.Expr) -> list[tuple[sp.Expr, str]]:
        """Return angles of an expression that are not known yet, with names for them, and remember them."""
        found = [(angle, next(self.names)) for angle in angles_in(value) if angle not in self.known]
        self.known.update(found)
        return found

    def forget(self, target: Ref) -> None:
        """Drop what an assignment changes."""
        for angle in list(self.known):
            if any(ref.variable == target.variable for ref in refs_in(angle)):
                del self.known[angle]


def angles_in(value: sp.Expr) -> list[sp.Expr]:
    """Return the arguments of sines and cosines, each once, in a fixed order."""
    found = {call.args[0] for call in sp.sympify(value).atoms(sp.sin, sp.cos)}
    return sorted(found, key=sp.default_sort_key)


def has_angles(routine: Routine) -> bool:
    """Whether a routine takes a sine or a cosine."""
    return any(angles_in(value) for value in routine.values())


def uses_circle(program: Program) -> bool:
    """Whether a program takes a sine or a cosine anywhere."""
    routines = (program.prepare, program.initialise, *program.steps, program.output)
    return any(map(has_angles, routines))
