"""What an element is: textbook equations between the state at its inboard and at its outboard side.

A state is made of motions (displacement ``q``, velocity ``v``, acceleration ``a`` of one coordinate each) and of the
forces conjugate to them, Gholampour (2018), sec. 2-1. Equations are written once, in these symbols; transfer matrices
(:mod:`tmm_gen.derive.transfer`) and sweeps (:mod:`tmm_gen.derive.station`) are derived from them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache

import sympy as sp


@dataclass(frozen=True)
class Motion:
    """One coordinate of a station with its time derivatives."""

    q: sp.Symbol
    v: sp.Symbol
    a: sp.Symbol


@dataclass(frozen=True)
class Port:
    """The state at one side of an element: motions and conjugate forces, in the same order."""

    motions: tuple[Motion, ...]
    forces: tuple[sp.Symbol, ...]


@dataclass(frozen=True)
class Element:
    """A physical element.

    Parameters
    ----------
    name : str
        Identifier.
    source : str
        Equation numbers.
    inboard, outboard : Port
        States the equations relate.
    equations : tuple of sympy.Expr
        Each vanishes. As many as the outboard state has entries.
    parameters : tuple of sympy.Symbol
        Physical parameters.
    inputs : tuple of sympy.Symbol
        External loads or prescribed values.
    energies : mapping from str to sympy.Expr
        What it holds, J ("kinetic", "elastic", "gravitational"), and the power it turns to heat, W ("heat"), by the
        motions of its ports.
    """

    name: str
    source: str
    inboard: Port
    outboard: Port
    equations: tuple[sp.Expr, ...]
    parameters: tuple[sp.Symbol, ...] = ()
    inputs: tuple[sp.Symbol, ...] = ()
    energies: Mapping[str, sp.Expr] = field(default_factory=dict, compare=False)

    def with_values(self, values: Mapping[sp.Symbol, sp.Expr]) -> Element:
        """Return the element with its parameters and inputs written by other symbols, or by zero."""

        def written(symbols: tuple[sp.Symbol, ...]) -> tuple[sp.Symbol, ...]:
            found = (sp.sympify(values.get(symbol, symbol)) for symbol in symbols)
            return tuple(dict.fromkeys(s for value in found for s in sorted(value.free_symbols, key=str)))

        others = tuple((symbol, sp.sympify(value)) for symbol, value in values.items())
        return replace(
            self,
            parameters=written(self.parameters),
            inputs=written(self.inputs),
            equations=_replaced(self.equations, others),
            energies=dict(zip(self.energies, _replaced(tuple(self.energies.values()), others), strict=True)),
        )


@lru_cache(maxsize=1 << 12)  # arms that differ in one thing have the same elements besides
def _replaced(
    expressions: tuple[sp.Expr, ...], values: tuple[tuple[sp.Symbol, sp.Expr], ...]
) -> tuple[sp.Expr, ...]:
    """Write symbols of expressions by others."""
    by_symbol = dict(values)
    return tuple(each.xreplace(by_symbol) for each in expressions)


def motion(name: str, side: str) -> Motion:
    """Return the symbols of one coordinate at a side ("in" or "out")."""
    return Motion(*(sp.Symbol(f"{prefix}{name}_{side}", real=True) for prefix in ("", "d", "dd")))


def torsion_port(side: str) -> Port:
    """Return the state ``[theta, tau]`` of the torsional chain."""
    return Port((motion("theta", side),), (sp.Symbol(f"tau_{side}", real=True),))
