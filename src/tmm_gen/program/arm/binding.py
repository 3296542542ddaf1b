"""From the symbols of a derivation to variables at a place of the row."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import lru_cache

import sympy as sp

from tmm_gen.derive.station.lets import Let, Line, Pivot
from tmm_gen.program.motion import in_order
from tmm_gen.program.statements import Assign, Require
from tmm_gen.program.variables import Ref, local


@dataclass
class Scratch:
    """Scratch scalars by name, each with one description.

    Parameters
    ----------
    described : dict from str to (str, str)
        What a name means, and its unit.
    """

    described: dict[str, tuple[str, str]] = field(default_factory=dict)
    lets: set[str] = field(default_factory=set)
    """Names that are set once at a station, which may be kept for a later walk."""

    def describe(self, lets: Iterable[Let]) -> None:
        """Take over the words of lets."""
        for let in lets:
            self.described.setdefault(let.symbol.name, (let.doc, let.unit))
            self.lets.add(let.symbol.name)

    def ref(self, name: str) -> Ref:
        """Return the scratch scalar of a name."""
        doc, unit = self.described.get(name, ("", "1"))
        return local(name, doc, unit)


class Binding:
    """Writes derived lines as statements at one place.

    Parameters
    ----------
    scratch : Scratch
        Names of what is computed on the way.
    values : mapping from sympy.Symbol to sympy.Expr
        What else stands at that place: parameters, motion, loads, gains.
    """

    def __init__(self, scratch: Scratch, values: Mapping[sp.Symbol, sp.Expr]) -> None:
        self._scratch = scratch
        self.values = values

    def value(self, expression: sp.Expr) -> sp.Expr:
        """Write an expression by variables."""
        symbols = _symbols(expression)
        return _with(
            expression,
            tuple(self.values[s] if s in self.values else self._scratch.ref(s.name) for s in symbols),
        )

    def target(self, symbol: sp.Symbol) -> Ref:
        """Return the variable a symbol is assigned to."""
        if isinstance(symbol, Ref):
            return symbol
        found = self.values.get(symbol)
        return found if isinstance(found, Ref) else self._scratch.ref(symbol.name)

    def lines(self, lines: Iterable[Line]) -> list[Assign | Require]:
        """Write lines as statements, in an order in which nothing is overwritten before it is read."""
        found: list[Assign | Require] = []
        for line in lines:
            if isinstance(line, Let):
                self._scratch.describe([line])
                found.append(Assign(self.target(line.symbol), self.value(line.value)))
            elif isinstance(line, Pivot):
                found.append(Require(self.value(line.value)))
            else:
                found += in_order([Assign(self.target(s), self.value(v)) for s, v in line.values.items()])
        return found


@lru_cache(maxsize=1 << 14)
def _symbols(expression: sp.Expr) -> tuple[sp.Symbol, ...]:
    """Return what stands for variables in an expression."""
    return tuple(symbol for symbol in sp.sympify(expression).free_symbols if not isinstance(symbol, Ref))


@lru_cache(maxsize=1 << 15)  # stations that are alike have the same lines at the same variables
def _with(expression: sp.Expr, values: tuple[sp.Expr, ...]) -> sp.Expr:
    """Return an expression with values in place of its symbols, in their order."""
    return sp.sympify(expression).xreplace(dict(zip(_symbols(expression), values, strict=True)))
