"""Printing of expressions, the same operations in the same order in every language.

Backends agree to rounding because they print from here: sums and products are written in one canonical order, small
integer powers as products, quotients as one division, rational factors as exact literals or as one quotient of
literals. A language only says how it writes numbers, references and functions.
"""

from __future__ import annotations

from abc import ABC, abstractmethod

import sympy as sp

from tmm_gen.program.variables import Ref

_SUM, _PRODUCT, _ATOM = 1, 2, 3


class ExpressionPrinter(ABC):
    """Turns SymPy expressions into text of a language."""

    @abstractmethod
    def reference(self, ref: Ref) -> str:
        """Write a scalar or an array element."""

    @abstractmethod
    def literal(self, value: float) -> str:
        """Write a non-negative floating-point number."""

    def function(self, name: str) -> str:
        """Write the name of ``sin``, ``cos`` or ``sqrt``."""
        return name

    def text(self, expression: sp.Expr) -> str:
        """Write an expression."""
        return self._print(sp.sympify(expression))[0]

    def _print(self, e: sp.Expr) -> tuple[str, int]:
        if isinstance(e, Ref):
            return self.reference(e), _ATOM
        if e.is_Number:
            return self._number(e)
        if e.is_Add:
            return self._sum(e), _SUM
        if e.is_Mul:
            return self._product(e)
        if e.is_Pow:
            return self._power(e)
        if isinstance(e, sp.Function):
            return f"{self.function(type(e).__name__)}({', '.join(self.text(a) for a in e.args)})", _ATOM
        raise TypeError(f"no way to write {sp.srepr(e)}")

    def _number(self, e: sp.Expr) -> tuple[str, int]:
        sign = "-" if e.is_negative else ""
        value = abs(e)
        level = _PRODUCT if sign else _ATOM
        if isinstance(value, sp.Rational) and sp.Rational(float(value)) != value:
            return f"{sign}({self.literal(float(value.p))} / {self.literal(float(value.q))})", level
        return sign + self.literal(float(value)), level

    def _sum(self, e: sp.Expr) -> str:
        terms = ordered_terms(e)
        text = self._factor_text(terms[0], _SUM)
        for term in terms[1:]:
            if _is_negative(term):
                text += f" - {self._factor_text(-term, _PRODUCT)}"
            else:
                text += f" + {self._factor_text(term, _PRODUCT)}"
        return text

    def _product(self, e: sp.Expr) -> tuple[str, int]:
        if _is_negative(e):
            return f"-{self._factor_text(-e, _PRODUCT)}", _PRODUCT
        above, below = numerator_and_denominator(e)
        text = "*".join(self._factor_text(f, _PRODUCT if i == 0 else _ATOM) for i, f in enumerate(above))
        text = text or self.literal(1.0)
        if below:
            under = "*".join(self._factor_text(f, _ATOM) for f in below)
            text += f"/{under}" if len(below) == 1 and under.isidentifier() else f"/({under})"
        return text, _PRODUCT

    def _power(self, e: sp.Expr) -> tuple[str, int]:
        base, exponent = e.as_base_exp()
        if exponent.is_Integer and exponent > 0:
            return "*".join([self._factor_text(base, _ATOM)] * int(exponent)), _PRODUCT
        if exponent.is_Integer:
            under = "*".join([self._factor_text(base, _ATOM)] * int(-exponent))
            return f"{self.literal(1.0)}/({under})" if exponent < -1 else f"{self.literal(1.0)}/{under}", _PRODUCT
        if exponent == sp.Rational(1, 2):
            return f"{self.function('sqrt')}({self.text(base)})", _ATOM
        if exponent == sp.Rational(-1, 2):
            return f"{self.literal(1.0)}/{self.function('sqrt')}({self.text(base)})", _PRODUCT
        raise TypeError(f"no way to write the power {e}")

    def _factor_text(self, e: sp.Expr, level: int) -> str:
        text, own = self._print(e)
        return text if own >= level and not (level == _ATOM and text.startswith("-")) else f"({text})"


def ordered_terms(e: sp.Expr) -> list[sp.Expr]:
    """Return the terms of a sum in printing order: a positive one first if there is one."""
    terms = list(sp.Add.make_args(e))
    terms.sort(key=lambda t: sp.default_sort_key(t))
    first = next((i for i, t in enumerate(terms) if not _is_negative(t)), 0)
    return [terms[first], *terms[:first], *terms[first + 1 :]]


def numerator_and_denominator(e: sp.Expr) -> tuple[list[sp.Expr], list[sp.Expr]]:
    """Split a product into factors above and below the line, numbers first."""
    above: list[sp.Expr] = []
    below: list[sp.Expr] = []
    for factor in sp.Mul.make_args(e):
        base, exponent = factor.as_base_exp()
        if exponent.is_Integer and exponent < 0 and not factor.is_Number:
            below.append(base**-exponent)
        elif factor != 1:
            above.append(factor)
    key = lambda f: (not f.is_Number, sp.default_sort_key(f))  # noqa: E731
    return sorted(above, key=key), sorted(below, key=key)


def _is_negative(term: sp.Expr) -> bool:
    coefficient = term.as_coeff_Mul()[0] if term.is_Mul or term.is_Number else sp.Integer(1)
    return bool(coefficient.is_negative)
