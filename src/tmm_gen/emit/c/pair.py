"""Numbers as unevaluated sums of two of type float: 48 bits from a processor that has 24.

The sum of two floats and its rounding error, or their product and its error, are two floats again (Dekker, Numerische
Mathematik 18, 1971; Knuth, The Art of Computer Programming, volume 2, section 4.2.2). Sums, products and quotients of
such pairs follow by a few operations in single precision, the product's error by one fused multiply-add (Joldes,
Muller, Popescu, ACM Transactions on Mathematical Software 44, 2017, algorithms 5, 10 and 17). Here is how expressions
are written in these functions, and the functions themselves in Python, with the bits of C.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
import sympy as sp

from tmm_gen.c_language.real import COMPENSATED, FLOAT
from tmm_gen.emit.c.printer import CPrinter
from tmm_gen.emit.expressions import is_negative, numerator_and_denominator, opposite, ordered_terms
from tmm_gen.program.variables import Ref, Role, Variable

_DIGITS = 30
"""Of irrational numbers, to be rounded to the 14 of a pair."""

PLAIN = (Role.INPUT, Role.GIVEN, Role.OUTPUT)
"""Roles of variables that are single numbers: what callers hand over and get."""

_CALLS = {
    "plus": (),
    "minus": ("plus", "opposite"),
    "opposite": (),
    "scaled": (),
    "times": (),
    "over": ("times", "minus", "pair_of"),
    "over_root": ("times", "minus", "pair_of"),
    "pair_of": (),
}
"""Functions of pairs in C, and which of them each calls."""


def parts(value: Fraction | float) -> tuple[float, float]:
    """Split a number into a float and another for what it lacks.

    Raises
    ------
    UserError
        If it is beyond the range of float.
    """
    high = FLOAT.round(float(value))
    return high, float(np.float32(float(Fraction(value) - Fraction(high))))


def pair_literal(value: Fraction | float) -> str:
    """Write a number as the members of a pair in braces."""
    high, low = parts(value)
    return f"{{{FLOAT.shortest(high)}, {FLOAT.shortest(low)}}}"


def functions_in(text: str) -> frozenset[str]:
    """Return the functions of pairs that a text of C calls, and those that they call."""
    found = {name for name in _CALLS if re.search(rf"\b{name}\(", text)}
    while more := {called for name in found for called in _CALLS[name]} - found:
        found |= more
    return frozenset(found)


class PairPrinter(CPrinter):
    """Writes expressions as calls of functions of pairs, in the order in which others write operations.

    Parameters
    ----------
    refer : callable
        Writes a reference.
    constant : callable
        Writes a constant, by default as a compound literal of C.
    factor : callable
        Writes a power of two, by default as a literal of C.
    """

    def __init__(
        self,
        refer: Callable[[Ref], str],
        constant: Callable[[Fraction | float], str] = lambda value: f"(pair){pair_literal(value)}",
        factor: Callable[[float], str] = FLOAT.literal,
    ) -> None:
        super().__init__(COMPENSATED, refer)
        self._constant = constant
        self._factor = factor

    def text(self, expression: sp.Expr) -> str:
        """Write an expression whose value is a pair."""
        e = sp.sympify(expression)
        if isinstance(e, Ref):
            return f"pair_of({self._refer(e)})" if e.variable.role in PLAIN else self._refer(e)
        if e.is_Number:
            return self._constant(Fraction(int(e.p), int(e.q)) if e.is_Rational else float(e))
        if e.is_number:  # an integrator's square root: a constant, never computed by a processor of 24 bits
            return self._constant(_nearest(e))
        if e.is_Add:
            return self._folded_sum(e)
        if e.is_Mul:
            return self._folded_product(e)
        if e.is_Pow and e.exp.is_Integer:
            return self._quotient_of([], [e.base] * -int(e.exp)) if e.exp < 0 else self._powers(e)
        if isinstance(e, sp.sin | sp.cos):
            return self.call(e)
        if e.is_Pow and e.exp == -sp.S.Half:
            return f"over_root({self.text(e.base)})"
        raise TypeError(f"no way to write {sp.srepr(e)} in pairs")

    def _folded_sum(self, e: sp.Expr) -> str:
        first, *others = ordered_terms(e)
        text = self.text(first)
        for term in others:
            text = (
                f"minus({text}, {self.text(opposite(term))})"
                if is_negative(term)
                else f"plus({text}, {self.text(term)})"
            )
        return text

    def _folded_product(self, e: sp.Expr) -> str:
        if is_negative(e):
            return f"opposite({self.text(opposite(e))})"
        numbers = [f for f in sp.Mul.make_args(e) if f.is_number]
        if all(f.is_Number for f in numbers):
            return self._quotient_of(*numerator_and_denominator(e))
        above, below = numerator_and_denominator(sp.Mul(*(f for f in e.args if not f.is_number)))
        return self._quotient_of([sp.Mul(*numbers), *above], below)

    def _quotient_of(self, above: Sequence[sp.Expr], below: Sequence[sp.Expr]) -> str:
        upper = self._factors(above) if above else self._constant(1.0)
        return f"over({upper}, {self._factors(below)})" if below else upper

    def _powers(self, e: sp.Expr) -> str:
        return self._factors([e.base] * int(e.exp))

    def _factors(self, factors: Iterable[sp.Expr]) -> str:
        first, *others = factors
        if first.is_Number and others and _is_power_of_two(first):
            second, *others = others
            text = f"scaled({self.text(second)}, {self._factor(float(first))})"
        else:
            text = self.text(first)
        for factor in others:
            text = f"times({text}, {self.text(factor)})"
        return text


def is_pair(variable: Variable) -> bool:
    """Whether a variable of a compensated kernel is a pair."""
    return variable.role not in PLAIN


def _nearest(number: sp.Expr) -> Fraction:
    """Return an irrational number, right beyond the bits of any pair."""
    return Fraction(str(number.evalf(_DIGITS)))


def _is_power_of_two(value: sp.Expr) -> bool:
    return bool(value.is_Rational) and all(int(n).bit_count() == 1 for n in (value.p, value.q))


@dataclass(frozen=True)
class Pair:
    """A sum of two numbers of type ``numpy.float32``."""

    high: Any
    low: Any

    @classmethod
    def of(cls, value: Fraction | float) -> Pair:
        """Return the pair next to a number."""
        return cls(*map(np.float32, parts(value)))

    def __float__(self) -> float:
        """Return the sum, exact in double precision."""
        return float(self.high) + float(self.low)


def plus(a: Pair, b: Pair) -> Pair:
    """Add."""
    total = a.high + b.high
    part = total - a.high
    lost = (a.high - (total - part)) + (b.high - part)
    return _normalised(total, lost + (a.low + b.low))


def minus(a: Pair, b: Pair) -> Pair:
    """Subtract."""
    return plus(a, opposite_of(b))


def opposite_of(a: Pair) -> Pair:
    """Change the sign."""
    return Pair(-a.high, -a.low)


def scaled(a: Pair, factor: float) -> Pair:
    """Multiply by a power of two."""
    return Pair(a.high * np.float32(factor), a.low * np.float32(factor))


def times(a: Pair, b: Pair) -> Pair:
    """Multiply."""
    product = a.high * b.high
    lost = np.float32(float(a.high) * float(b.high) - float(product))  # exact in double, as fmaf is
    return _normalised(product, lost + (a.high * b.low + a.low * b.high))


def over(a: Pair, b: Pair) -> Pair:
    """Divide."""
    quotient = a.high / b.high
    rest = minus(a, times(b, Pair(quotient, np.float32(0.0))))
    return _normalised(quotient, rest.high / b.high)


def over_root(a: Pair) -> Pair:
    """Return one over the root."""
    rough = np.float32(1.0) / np.sqrt(a.high)
    square = times(Pair(rough, np.float32(0.0)), Pair(rough, np.float32(0.0)))
    rest = minus(Pair.of(1.0), times(a, square))
    return _normalised(rough, np.float32(0.5) * rough * rest.high)


def _normalised(high: Any, low: Any) -> Pair:
    total = high + low
    return Pair(total, low - (total - high))
