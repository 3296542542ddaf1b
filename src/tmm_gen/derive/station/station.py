"""A row's recursions by phase, each derived once for all stations that are alike."""

from __future__ import annotations

from collections.abc import Collection
from functools import cache

import sympy as sp

from tmm_gen.derive.elements.declaration import Element
from tmm_gen.derive.station.frame import Frame, force, impedance, predicted_force
from tmm_gen.derive.station.inward import Inward
from tmm_gen.derive.station.lets import Line, Update
from tmm_gen.derive.station.motion import Outward


@cache
def outward(elements: tuple[Element, ...], frame: Frame, *, moved: bool = False) -> Outward:
    """Derive the way out over some elements."""
    return Outward(elements, frame, moved=moved)


@cache
def inward(
    elements: tuple[Element, ...], frame: Frame, zero: frozenset[sp.Symbol], *, moved: bool = False
) -> Inward:
    """Derive the way in over some elements, with some of what arrives known to be zero."""
    return Inward(outward(elements, frame, moved=moved), zero)


def everything(frame: Frame) -> frozenset[sp.Symbol]:
    """Return all entries that a sweep carries inward: at a free end they are zero."""
    c = frame.coordinates
    forces = (*map(force, c), *map(predicted_force, c))
    return frozenset([*(impedance(a, b) for a in c for b in c), *forces])


@cache
def recurring(
    elements: tuple[Element, ...], frame: Frame, zero: frozenset[sp.Symbol], stations: int
) -> Inward:
    """Derive the way in over a run of like stations: zero is what stays zero from each to the next."""
    found = inward(elements, frame, zero)
    while stations > 1 and not zero <= found.zero:
        zero = zero & found.zero
        found = inward(elements, frame, zero)
    return found


def ceasing(found: Inward, stations: int, carried: Collection[sp.Symbol]) -> tuple[Line, ...]:
    """Return what must be set to zero between stations of a run: it arrives at the outermost and at no other.

    Parameters
    ----------
    carried : collection of sympy.Symbol
        What is carried at all.
    """
    gone = sorted((found.zero - found.arriving) & set(carried), key=str) if stations > 1 else []
    if not found.frame.predicted:
        gone = [s for s in gone if s not in set(map(predicted_force, found.frame.coordinates))]
    return (Update(dict.fromkeys(gone, sp.Integer(0))),) if gone else ()
