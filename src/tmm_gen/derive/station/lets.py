"""What a derivation consists of: named values in order, updates of what a sweep carries, pivots it relies on."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import sympy as sp


@dataclass(frozen=True)
class Let:
    """A named value."""

    symbol: sp.Symbol
    value: sp.Expr
    doc: str = ""
    unit: str = "1"


@dataclass(frozen=True)
class Update:
    """New values of what a sweep carries, all at once: each is written by the old ones."""

    values: Mapping[sp.Symbol, sp.Expr]


@dataclass(frozen=True)
class Pivot:
    """A value that must be positive."""

    value: sp.Expr


Line = Let | Update | Pivot


@dataclass(frozen=True)
class Coordinate:
    """One coordinate of a row's stations.

    Parameters
    ----------
    name : str
        In names of what belongs to it: "x", "y", "u" (the unknown of an integrated coordinate).
    force : str
        Name of the force conjugate to it.
    integrated : bool
        Whether time integration knows its motion. Of any other only accelerations are carried from station to
        station; what a sweep solves for in it is the change of the acceleration.
    unit, force_unit : str
        Of its acceleration and of its force.
    """

    name: str
    force: str
    integrated: bool
    unit: str
    force_unit: str


def composed(lines: Iterable[Line]) -> dict[sp.Symbol, sp.Expr]:
    """Return what a straight sequence of lines leaves of what it carries, by what was there before."""
    found: dict[sp.Symbol, sp.Expr] = {}
    for line in lines:
        if isinstance(line, Let):
            found[line.symbol] = line.value.xreplace(found)
        elif isinstance(line, Update):
            found |= {s: sp.sympify(v).xreplace(found) for s, v in line.values.items()}
    return found


def needed(lines: Sequence[Line], wanted: frozenset[sp.Symbol]) -> tuple[Line, ...]:
    """Return lines without the named values that neither they nor anybody else reads.

    Parameters
    ----------
    wanted : frozenset of sympy.Symbol
        What is read afterwards.
    """
    read = set(wanted)
    found: list[Line] = []
    for line in reversed(lines):
        if isinstance(line, Let):
            if line.symbol not in read:
                continue
            read |= line.value.free_symbols
        elif isinstance(line, Update):
            read |= {s for value in line.values.values() for s in sp.sympify(value).free_symbols}
        else:
            read |= line.value.free_symbols
        found.insert(0, line)
    return tuple(found)
