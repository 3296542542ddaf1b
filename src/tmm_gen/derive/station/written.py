"""How a derived value is written: by differences where it is a law of these, and with the fewest operations."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

import sympy as sp


def grouped(value: sp.Expr, differences: Mapping[str, tuple[sp.Symbol, sp.Symbol]]) -> sp.Expr:
    """Write a law by differences of motion, where it is one: ``k (q_o - q_i)`` instead of two products."""
    value = sp.expand(value)
    found: list[sp.Expr] = []
    for inner, outer in differences.values():
        of_inner, of_outer = value.coeff(inner), value.coeff(outer)
        if of_outer != 0 and sp.expand(of_inner + of_outer) == 0:
            back = of_outer.could_extract_minus_sign()
            difference = inner - outer if back else outer - inner
            found.append(sp.Mul(-of_outer if back else of_outer, difference))
            value = sp.expand(value - of_outer * outer - of_inner * inner)
    return sp.Add(value, *found)


@lru_cache(maxsize=1 << 12)  # arms that differ in one thing ask for the rest alike
def cheapest(value: sp.Expr, levers: tuple[sp.Symbol, ...]) -> sp.Expr:
    """Return the way of writing a value that takes the fewest operations."""
    symbols = value.free_symbols
    gains = [s for s in symbols if s.name.startswith("P_")]
    if not gains and len(symbols & set(levers)) < 2:
        return value
    expanded = sp.expand(value)
    written = (
        value,
        expanded,
        sp.factor_terms(value),
        sp.collect(expanded, levers),
        sp.collect(expanded, gains),
        sp.collect(expanded, [*levers, *gains]),
    )
    counts = [operations(e) for e in written]
    fewest = list(dict.fromkeys(e for e, count in zip(written, counts, strict=True) if count == min(counts)))
    return fewest[0] if len(fewest) == 1 else min(fewest, key=lambda e: len(str(e)))


def operations(e: sp.Expr) -> int:
    """Count additions and multiplications as printed; a change of sign is none."""
    if e.is_Atom:
        return 0
    inner = sum(operations(a) for a in e.args)
    if e.is_Mul:
        return inner + len([a for a in e.args if a not in (1, -1)]) - 1
    if e.is_Pow:
        return inner + abs(int(e.exp)) - 1 if e.exp.is_Integer and e.exp > 0 else inner + 1
    return inner + len(e.args) - 1
