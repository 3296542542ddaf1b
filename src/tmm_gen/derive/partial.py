"""Partial derivatives, as SymPy has them, without what `sympy.diff` does besides.

That asks of every term of every sum whether it is an array or a matrix, and of every derivative whether it is one of
another; a tenth of a derivation goes by that. Equations of arms are sums, products, powers and functions of symbols.
"""

from __future__ import annotations

from functools import lru_cache

import sympy as sp

__all__ = ["partial"]


@lru_cache(maxsize=1 << 14)  # the same terms stand in the laws of many elements
def partial(expression: sp.Expr, symbol: sp.Symbol) -> sp.Expr:
    """Return the derivative of an expression by a symbol, in the shape that `sympy.diff` gives it.

    Parameters
    ----------
    expression : sympy.Expr
        Of numbers and symbols, sums, products, powers and functions.
    symbol : sympy.Symbol
        By which.
    """
    if expression.is_Atom:
        return sp.S.One if expression == symbol else sp.S.Zero
    changing = [(place, partial(each, symbol)) for place, each in enumerate(expression.args)]
    changing = [(place, each) for place, each in changing if each != 0]
    if not changing:
        return sp.S.Zero
    if expression.is_Add:
        return sp.Add(*(each for _, each in changing))
    if expression.is_Mul:
        args = expression.args
        return sp.Add(*(sp.Mul(*args[:place], each, *args[place + 1 :]) for place, each in changing))
    if expression.is_Pow and expression.exp.is_Number:
        ((_, of_base),) = changing
        return expression * (of_base * expression.exp / expression.base)
    if expression.is_Function:
        return sp.Add(*(expression.fdiff(place + 1) * each for place, each in changing))
    return sp.diff(expression, symbol)
