"""What several slopes have in common, named once: products of a rate with a length or a moment, spreads of inertia."""

from __future__ import annotations

from collections import Counter

import sympy as sp

from tmm_gen.derive.space.declaration import INERTIA
from tmm_gen.derive.space.sheet import Sheet

_CONSTANT = frozenset(INERTIA)


def with_shared(sheet: Sheet, values: sp.Matrix) -> sp.Matrix:
    """Return values in which differences of inertias, and products that occur twice, have names.

    Differences of inertias do not change from step to step, so that they cost a step nothing.
    """
    spreads = {
        part: _spread(sheet, part)
        for value in values
        for part in sp.preorder_traversal(value)
        if part.is_Add and _is_constant(part)
    }
    values = values.xreplace(spreads)
    counted = Counter(_pair(part) for value in values for part in sp.preorder_traversal(value) if part.is_Mul)
    named = {
        pair: sheet.named("_".join(sorted(s.name for s in pair.args)), pair)
        for pair, times in counted.items()
        if pair is not None and times > 1
    }
    return values.applyfunc(
        lambda value: value.replace(
            lambda part: part.is_Mul and _pair(part) in named, lambda m: _over(m, named)
        )
    )


def _spread(sheet: Sheet, part: sp.Expr) -> sp.Expr:
    more, less = (
        next(s for s in part.free_symbols if (part.coeff(s) > 0) == positive) for positive in (True, False)
    )
    return sheet.named(
        f"{more.name}_less_{less.name.removeprefix('inertia_')}", part, "spread of inertia", "kg m^2"
    )


def _is_constant(part: sp.Expr) -> bool:
    """Whether a sum is the difference of two inertias."""
    return (
        len(part.args) == 2 and part.free_symbols <= _CONSTANT and part.subs(dict.fromkeys(_CONSTANT, 1)) == 0
    )


def _pair(product: sp.Expr) -> sp.Expr | None:
    """Return the product of two symbols without its number."""
    _, rest = product.as_coeff_Mul()
    return rest if rest.is_Mul and len(rest.args) == 2 and all(f.is_Symbol for f in rest.args) else None


def _over(product: sp.Expr, named: dict[sp.Expr, sp.Expr]) -> sp.Expr:
    number, rest = product.as_coeff_Mul()
    return number * named[rest]
