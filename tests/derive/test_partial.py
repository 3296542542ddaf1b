"""Partial derivatives have the very shape that SymPy gives them: generated texts depend on it."""

from __future__ import annotations

import pytest
import sympy as sp

from tmm_gen.derive.elements import nodes, planar, torsion
from tmm_gen.derive.elements.declaration import Element
from tmm_gen.derive.partial import partial

ELEMENTS = {
    f"{module.__name__.rpartition('.')[2]}.{name}": item
    for module in (torsion, planar, nodes)
    for name, item in vars(module).items()
    if isinstance(item, Element)
}
X, Y, Z = sp.symbols("x y z", real=True)
OTHERS = (
    2 * (X + Y) * Z,
    3 * X * (Y + sp.sin(X)) * (X - 1),
    (X * Y + 1) ** 3 / (X - Y) ** 2,
    sp.sqrt(1 + X**2) * sp.atan2(X * Y, Z),
    X ** (Y + 1) * sp.exp(X),
    sp.cos(sp.sin(X * Y)) * sp.Rational(2, 3),
    sp.Max(X, Y) * Z,
)


@pytest.mark.parametrize("name", ELEMENTS)
def test_of_all_that_elements_say(name: str) -> None:
    element = ELEMENTS[name]
    for said in (*element.equations, *element.energies.values()):
        for symbol in said.free_symbols:
            assert partial(said, symbol) == sp.diff(said, symbol)


@pytest.mark.parametrize("expression", OTHERS, ids=str)
def test_of_all_sorts_of_expressions(expression: sp.Expr) -> None:
    for symbol in (X, Y, Z, sp.Symbol("w")):
        assert partial(expression, symbol) == sp.diff(expression, symbol)
