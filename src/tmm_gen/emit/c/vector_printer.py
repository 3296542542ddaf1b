"""Expressions in C whose numbers are vectors: of stages, part by part; of systems, as complex numbers side by side."""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from tmm_gen.emit.c.printer import CPrinter
from tmm_gen.emit.expressions import is_negative, numerator_and_denominator, opposite, ordered_terms
from tmm_gen.program.parts import Part, Vector, is_vector
from tmm_gen.program.variables import Spread

_SUM, _PRODUCT, _ATOM = 1, 2, 3
_GROUP = 3
"""Addends of which each waits for the one before it; longer sums are sums of such, which wait for nothing."""


class VectorPrinter(CPrinter):
    """Writes expressions whose numbers are single ones or vectors, of stages or of systems but not of both.

    A single number times a vector is that of every part. Where systems add one, it is a real number in each.
    """

    _systems = False
    """Whether vectors are those of systems."""

    def written(self, value: sp.Expr, spread: Spread | None) -> str:
        """Write a value for what is spread like that.

        Parameters
        ----------
        value : sympy.Expr
            A single number is the same in all stages, and in all systems.
        spread : Spread or None
            None for a single number.
        """
        self._systems = spread is Spread.SYSTEMS
        text = self.text(value)
        if spread is not None and not is_vector(value):
            text = f"TMM_GEN_REAL({text})" if self._systems else f"TMM_GEN_ALL({text})"
        self._systems = False
        return text

    def call(self, e: sp.Function) -> str:
        """Write a vector of parts, a part of a vector, or the sines or cosines of one."""
        if isinstance(e, Vector):
            return f"(vector){{{', '.join(map(self._entry, e.args))}}}"
        if isinstance(e, Part):
            return f"{self.text(e.args[0])}[{e.args[1]}]"
        if is_vector(e) and e.args[0] not in self.turns:
            return f"{'sines' if isinstance(e, sp.sin) else 'cosines'}_of({self.text(e.args[0])})"
        return super().call(e)

    def _entry(self, value: sp.Expr) -> str:
        if value.free_symbols:
            return self.text(value)
        number = float(sp.N(value, 30))
        return ("-" if number < 0 else "") + self.literal(abs(number))

    def _complex(self, e: sp.Expr) -> bool:
        return self._systems and is_vector(e)

    def _sum(self, e: sp.Expr) -> str:
        if not is_vector(e):
            return super()._sum(e)
        addends: list[tuple[str, str]] = []
        for term in ordered_terms(e):
            sign = "-" if is_negative(term) else "+"
            positive = opposite(term) if sign == "-" else term
            texts = self._addends(positive) if self._systems else [self._factor_text(positive, _PRODUCT)]
            addends += [(sign, text) for text in texts]
        size = len(addends)
        if size < 2 * _GROUP:
            return _added(addends)
        length = -(-size // (size // _GROUP))
        return " + ".join(f"({_added(addends[k : k + length])})" for k in range(0, size, length))

    def _addends(self, term: sp.Expr) -> list[str]:
        """Return what to add for a term: of a product of two complex numbers two products, each fused with its sum."""
        if not is_vector(term):
            return [f"TMM_GEN_REAL({self.text(term)})"]
        above, below = numerator_and_denominator(term)
        complex_ = [f for f in above if is_vector(f)]
        if below or len(complex_) != 2 or any(f.is_Pow for f in complex_):
            return [self._factor_text(term, _PRODUCT)]
        one, other = (self._factor_text(f, _ATOM) for f in complex_)
        head = "".join(f"{self._factor_text(f, _ATOM)} * " for f in above if not is_vector(f))
        return [f"{head}{one} * real_of({other})", f"{head}turned({one}) * imaginary_of({other})"]

    def _product(self, e: sp.Expr) -> tuple[str, int]:
        if not self._complex(e) or is_negative(e):
            return super()._product(e)
        above, below = numerator_and_denominator(e)
        text = ""
        for factor in (f for f in above if is_vector(f)):
            one = self._factor_text(factor, _ATOM)
            text = f"times({text}, {one})" if text else one
        for factor in (f for f in below if is_vector(f)):
            one = f"inverse_of({self.text(factor)})"
            text = f"times({text}, {one})" if text else one
        single = [self._factor_text(f, _ATOM) for f in above if not is_vector(f)]
        text = self.times.join([*single, text])
        return self._quotient(text, [f for f in below if not is_vector(f)]), _PRODUCT

    def _power(self, e: sp.Expr) -> tuple[str, int]:
        if not self._complex(e):
            return super()._power(e)
        base, exponent = e.as_base_exp()
        if not exponent.is_Integer:
            raise TypeError(f"no way to write the power {e} of complex numbers")
        text = one = self._factor_text(base, _ATOM)
        for _ in range(abs(int(exponent)) - 1):
            text = f"times({text}, {one})"
        return (text if exponent > 0 else f"inverse_of({text})"), _ATOM


def _added(addends: Sequence[tuple[str, str]]) -> str:
    """Write a sum of texts with their signs."""
    (sign, text), *others = addends
    return f"{'-' if sign == '-' else ''}{text}" + "".join(f" {sign} {other}" for sign, other in others)
