"""A sheet on which a derivation names its values, each once."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.space.declaration import AXES
from tmm_gen.derive.station.lets import Let


class Sheet:
    """Named values in order, and what is known by which name.

    Attributes
    ----------
    lets : list of Let
        In the order in which they were named.
    """

    def __init__(self) -> None:
        self.lets: list[Let] = []
        self._known: dict[sp.Expr, sp.Expr] = {}
        self._names: set[str] = set()

    def named(self, name: str, value: sp.Expr, doc: str = "", unit: str = "1") -> sp.Expr:
        """Return a name for a value; the value itself where it takes no arithmetic, or its name where it has one."""
        if _bare(value):
            return value
        if (known := self.known(value)) is not None:
            return known
        unique, number = name, 2
        while unique in self._names:
            unique, number = f"{name}_{number}", number + 1
        self._names.add(unique)
        symbol = sp.Symbol(unique, real=True)
        self.lets.append(Let(symbol, value, doc, unit))
        self.learn(value, symbol)
        return symbol

    def learn(self, value: sp.Expr, symbol: sp.Expr) -> None:
        """Remember under which name a value is known."""
        self._known.setdefault(value, symbol)
        self._known.setdefault(sp.expand(-value), -symbol)

    def known(self, value: sp.Expr) -> sp.Expr | None:
        """Return the name of a value, if it has one."""
        return self._known.get(value)

    def vector(self, name: str, values: sp.Matrix, doc: str = "", unit: str = "1") -> sp.Matrix:
        """Return names for the components of a vector."""
        return sp.Matrix(
            [
                self.named(f"{name}_{axis}", value, f"{doc} along {axis}" if doc else "", unit)
                for axis, value in zip(AXES, values, strict=True)
            ]
        )


def _bare(value: sp.Expr) -> bool:
    return bool(value.is_Atom or (-value).is_Atom)
