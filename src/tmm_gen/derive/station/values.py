"""Value numbering: a new value that is a multiple of one already there is written by that one.

SymPy's common subexpressions are found by shape. The derivative of a lever arm by its angle is the other lever arm, and
that of a rod's relative acceleration is the same turned by a right angle: equal values of other shapes, found here
by writing everything out in motions, sines and parameters.
"""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.station.lets import Let


class Values:
    """Lets with what they are in full.

    Parameters
    ----------
    squares : dict from sympy.Symbol to sympy.Symbol
        Sine to cosine, of each angle: ``s^2 + c^2 = 1``.
    """

    def __init__(self, squares: dict[sp.Symbol, sp.Symbol]) -> None:
        self.lets: list[Let] = []
        self._full: dict[sp.Symbol, sp.Expr] = {}
        self._squares = squares

    def let(self, name: str, full: sp.Expr, doc: str = "", unit: str = "1") -> sp.Expr:
        """Name a value, unless it is nothing, or known."""
        written = self.written(full)
        if written.is_Atom or (-written).is_Atom:
            return written
        symbol = sp.Symbol(name, real=True)
        self.lets.append(Let(symbol, written, doc, unit))
        self._full[symbol] = self.in_full(full)
        return symbol

    def in_full(self, expression: sp.Expr) -> sp.Expr:
        """Write an expression without lets, squares of sines by those of cosines."""
        full = sp.expand(expression.xreplace(self._full))
        for sine, cosine in self._squares.items():
            if full.has(sine**2):
                full = sp.expand(full.subs(sine**2, 1 - cosine**2))
        return full

    def written(self, expression: sp.Expr) -> sp.Expr:
        """Write an expression by what is known: as a multiple of one value, or term by term."""
        if expression.is_Atom:
            return expression
        full = self.in_full(expression)
        whole = self._multiple(full)
        return whole if whole is not None else self._by_products(sp.expand(expression))

    def _multiple(self, full: sp.Expr) -> sp.Expr | None:
        """Return the cheapest multiple of a known value, by a product of numbers and symbols, that is it."""
        if full.is_Atom:
            return full
        terms = len(sp.Add.make_args(full))
        best: sp.Expr | None = None
        for symbol, known in self._full.items():
            if len(sp.Add.make_args(known)) != terms:
                continue
            ratio = _ratio(full, known)
            if ratio is None:
                continue
            found = ratio * symbol
            if best is None or _price(found) < _price(best):
                best = found
        return best

    def _by_products(self, full: sp.Expr) -> sp.Expr:
        """Put known values in the place of what they are: sums within the sum first, then products."""
        full = self._by_sums(full)
        products = {s: f for s, f in self._full.items() if f.is_Mul or f.is_Pow}
        held = full.free_symbols
        for symbol, product in products.items():
            if product.free_symbols <= held:  # looked at before SymPy looks into every product
                full = full.subs(product, symbol)
                held = full.free_symbols
        return full

    def _by_sums(self, full: sp.Expr) -> sp.Expr:
        """Put multiples of known sums in the place of the terms that make them up."""
        for symbol, known in self._full.items():
            if not known.is_Add or not full.is_Add or len(known.args) >= len(full.args):
                continue
            terms = set(full.args)
            for term in full.args:
                ratio = term / known.args[0]
                if term not in terms or not sp.denom(ratio).is_Number:
                    continue
                parts = {sp.expand(ratio * part) for part in known.args}
                if parts <= terms:
                    terms = (terms - parts) | {ratio * symbol}
            full = sp.Add(*terms)
        return full


def _price(value: sp.Expr) -> int:
    """Count operations; a change of sign is none."""
    return int(sp.count_ops(value)) - bool(value.could_extract_minus_sign())


def _ratio(full: sp.Expr, known: sp.Expr) -> sp.Expr | None:
    """Return ``full / known`` where it is a product of powers that are not negative."""
    if full.is_Add:
        first, *_ = known.args
        for term in full.args:
            ratio = term / first
            if sp.denom(ratio).is_Number and sp.expand(full - ratio * known) == 0:
                return ratio
        return None
    ratio = full / known
    return ratio if sp.denom(ratio).is_Number else None
