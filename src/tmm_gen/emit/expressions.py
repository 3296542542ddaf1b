"""Printing of expressions, the same operations in the same order in every language.

Backends agree to rounding because they print from here: sums and products are written in one canonical order,
small integer powers as products, quotients as one division, rational factors as exact literals or as one
quotient of literals. A language only says how it writes numbers, references and functions.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from functools import lru_cache

import sympy as sp

from tmm_gen.errors import UserError
from tmm_gen.program.variables import Ref

_SUM, _PRODUCT, _ATOM = 1, 2, 3


_WHOLE = 2**1000
"""Beyond this a fraction's terms are no numbers of their own; what follows of absurd parameters of an integrator."""


def _float(value: sp.Expr) -> float:
    """Return the nearest number.

    Raises
    ------
    UserError
        If there is none.
    """
    try:
        nearest = float(value)
    except OverflowError:
        nearest = math.inf
    if math.isinf(nearest) or (nearest == 0.0 and value != 0):
        raise UserError(
            f"the integrator's parameters and the step lead to a coefficient of {sp.N(value, 3)}, beyond the range "
            "of floating point. Choose parameters that are nearer to 1."
        )
    return nearest


class ExpressionPrinter(ABC):
    """Turns SymPy expressions into text of a language."""

    times = " * "
    """How a product's factors are joined."""
    over = " / "
    """How a quotient's parts are joined."""

    @abstractmethod
    def reference(self, ref: Ref) -> str:
        """Write a scalar or an array element."""

    @abstractmethod
    def literal(self, value: float) -> str:
        """Write a non-negative floating-point number."""

    def function(self, name: str) -> str:
        """Write the name of ``sin``, ``cos`` or ``sqrt``."""
        return name

    def call(self, e: sp.Function) -> str:
        """Write a call of ``sin`` or ``cos``."""
        return f"{self.function(type(e).__name__)}({', '.join(self.text(a) for a in e.args)})"

    def text(self, expression: sp.Expr) -> str:
        """Write an expression."""
        return self._print(sp.sympify(expression))[0]

    def _print(self, e: sp.Expr) -> tuple[str, int]:
        if isinstance(e, Ref):
            return self.reference(e), _ATOM
        if e.is_Number:
            return self._number(e)
        if e.is_NumberSymbol:
            return self.literal(float(e)), _ATOM
        if e.is_Add:
            return self._sum(e), _SUM
        if e.is_Mul:
            return self._product(e)
        if e.is_Pow:
            return self._power(e)
        if isinstance(e, sp.Function):
            return self.call(e), _ATOM
        raise TypeError(f"no way to write {sp.srepr(e)}")

    def _number(self, e: sp.Expr) -> tuple[str, int]:
        sign = "-" if e.is_negative else ""
        value = abs(e)
        level = _PRODUCT if sign else _ATOM
        nearest = _float(value)
        if (
            isinstance(value, sp.Rational)
            and sp.Rational(nearest) != value
            and max(value.p, value.q) < _WHOLE
        ):
            return f"{sign}({self.literal(float(value.p))} / {self.literal(float(value.q))})", level
        return sign + self.literal(nearest), level

    def _sum(self, e: sp.Expr) -> str:
        terms = ordered_terms(e)
        text = self._factor_text(terms[0], _SUM)
        for term in terms[1:]:
            if is_negative(term):
                text += f" - {self._factor_text(opposite(term), _PRODUCT)}"
            else:
                text += f" + {self._factor_text(term, _PRODUCT)}"
        return text

    def _product(self, e: sp.Expr) -> tuple[str, int]:
        if is_negative(e):
            return f"-{self._factor_text(opposite(e), _PRODUCT)}", _PRODUCT
        above, below = numerator_and_denominator(e)
        text = self.times.join(
            self._factor_text(f, _PRODUCT if i == 0 else _ATOM) for i, f in enumerate(above)
        )
        return self._quotient(text or self.literal(1.0), below), _PRODUCT

    def _quotient(self, above: str, below: Sequence[sp.Expr]) -> str:
        if not below:
            return above
        under = self.times.join(self._factor_text(f, _ATOM) for f in below)
        return f"{above}{self.over}{under}" if len(below) == 1 else f"{above}{self.over}({under})"

    def _power(self, e: sp.Expr) -> tuple[str, int]:
        base, exponent = e.as_base_exp()
        if exponent.is_Integer and exponent > 0:
            return self.times.join([self._factor_text(base, _ATOM)] * int(exponent)), _PRODUCT
        if exponent.is_Integer:
            return self._quotient(self.literal(1.0), [base] * int(-exponent)), _PRODUCT
        if exponent == sp.Rational(1, 2):
            return f"{self.function('sqrt')}({self.text(base)})", _ATOM
        if exponent == sp.Rational(-1, 2):
            return f"{self.literal(1.0)}{self.over}{self.function('sqrt')}({self.text(base)})", _PRODUCT
        raise TypeError(f"no way to write the power {e}")

    def _factor_text(self, e: sp.Expr, level: int) -> str:
        text, own = self._print(e)
        return text if own >= level and not (level == _ATOM and text.startswith("-")) else f"({text})"


@lru_cache(maxsize=1 << 16)  # every language asks again
def ordered_terms(e: sp.Expr) -> tuple[sp.Expr, ...]:
    """Return the terms of a sum in printing order: a positive one first if there is one."""
    terms = list(sp.Add.make_args(e))
    terms.sort(key=lambda t: sp.default_sort_key(t))
    first = next((i for i, t in enumerate(terms) if not is_negative(t)), 0)
    return (terms[first], *terms[:first], *terms[first + 1 :])


@lru_cache(maxsize=1 << 16)
def numerator_and_denominator(e: sp.Expr) -> tuple[tuple[sp.Expr, ...], tuple[sp.Expr, ...]]:
    """Split a product into factors above and below the line, numbers first."""
    above: list[sp.Expr] = []
    below: list[sp.Expr] = []
    for factor in sp.Mul.make_args(e):
        base, exponent = factor.as_base_exp()
        if exponent.is_Integer and exponent < 0 and not factor.is_Number:
            below.append(base**-exponent)
        elif factor != 1:
            above.append(factor)
    return tuple(sorted(above, key=_numbers_first)), tuple(sorted(below, key=_numbers_first))


def _numbers_first(factor: sp.Expr) -> tuple[bool, tuple[object, ...]]:
    return not factor.is_Number, sp.default_sort_key(factor)


@lru_cache(maxsize=1 << 16)
def opposite(term: sp.Expr) -> sp.Expr:
    """Change the sign of a term without multiplying its number into a sum."""
    if not term.is_Mul:
        return -term
    factors = list(term.args)
    place = next(i for i, f in enumerate(factors) if f.is_Number and f.is_negative)
    factors[place] = -factors[place]
    rest = [f for f in factors if f != 1]
    return sp.Mul(*rest, evaluate=False) if len(rest) > 1 else sp.Mul(*rest)


@lru_cache(maxsize=1 << 16)
def is_negative(term: sp.Expr) -> bool:
    """Whether a term is written with a minus sign in front."""
    numbers = [f for f in sp.Mul.make_args(term) if f.is_Number]
    return bool(sum(1 for f in numbers if f.is_negative) % 2)


def element(name: str, ref: Ref) -> str:
    """Write an element of an array, ``j`` being the loop's station, or the scalar itself."""
    if ref.variable.length is None:
        return name
    if ref.offset is None:
        return f"{name}[{ref.entry}]"
    if ref.offset == 0:
        return f"{name}[j]"
    return f"{name}[j {'+' if ref.offset > 0 else '-'} {abs(ref.offset)}]"
