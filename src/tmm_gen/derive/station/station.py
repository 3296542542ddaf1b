"""A row's recursions by phase, each derived once for all stations that are alike."""

from __future__ import annotations

from functools import cache

import sympy as sp

from tmm_gen.derive.elements.declaration import Element
from tmm_gen.derive.station.frame import Frame, force, impedance
from tmm_gen.derive.station.inward import Inward
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
    return frozenset([*(impedance(a, b) for a in c for b in c), *(force(a) for a in c)])


@cache
def recurring(elements: tuple[Element, ...], frame: Frame, zero: frozenset[sp.Symbol], stations: int) -> Inward:
    """Derive the way in over a run of like stations: zero is what stays zero from each to the next."""
    found = inward(elements, frame, zero)
    while stations > 1 and not zero <= found.zero:
        zero = zero & found.zero
        found = inward(elements, frame, zero)
    return found
