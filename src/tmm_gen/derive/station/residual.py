"""What the equations leave over at given motion: a walk inward with exact forces, that solves for nothing."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import sympy as sp

from tmm_gen.derive.elements.declaration import Element
from tmm_gen.derive.station.frame import RESIDUAL, Frame, force
from tmm_gen.derive.station.giving_way import TORQUE
from tmm_gen.derive.station.law import KINDS
from tmm_gen.derive.station.lets import Let, Line, Update
from tmm_gen.derive.station.motion import Outward, Passed
from tmm_gen.derive.station.shaft import TORQUES, gap
from tmm_gen.derive.station.written import grouped


@dataclass(frozen=True)
class Residual:
    """What a station, or what stands at an end of the row, makes of the forces beyond it.

    Parameters
    ----------
    known : tuple of Let
        Own force of the element that gives way.
    on_shaft : tuple of Let
        Where there is a shaft, what is over of the torques on it.
    lines : tuple of Line
        Forces at the inner side, and what is left over.
    """

    known: tuple[Let, ...]
    on_shaft: tuple[Let, ...]
    lines: tuple[Line, ...]


@cache
def residual(elements: tuple[Element, ...], frame: Frame, *, moved: bool = False) -> Residual:
    """Derive it for some elements.

    Parameters
    ----------
    elements : tuple of Element
        Inner to outer.
    frame : Frame
        Whose gains do not matter.
    moved : bool
        Whether they stand at an end of the row, where nothing gives way.
    """
    out = Outward(elements, frame, moved=moved)
    known: list[Let] = []
    on_shaft: list[Let] = []
    lines: list[Line] = []
    forces = [force(c) for c in frame.coordinates]
    own = sp.Integer(0)
    for passed in reversed(out.passed):
        if passed is out.turning:
            # inward goes the torque of its gear, and what is over on the shaft is told apart
            turns = _named(on_shaft, _own(passed, frame), TORQUES[0], "torque on each shaft at a stage")
            on_shaft.append(gap((turns, own)))
            continue
        outside = dict(zip(passed.element.outboard.forces, forces, strict=True))
        if passed.law.free is not None:
            named = TORQUES[1] if out.turning else TORQUE
            own = _named(known, _own(passed, frame), named, "torque of each joint at a stage")
            doc = "torque that the equations leave over at each joint"
            lines.append(Let(RESIDUAL, own - forces[frame.own], doc, "N m"))
        update: dict[sp.Symbol, sp.Expr] = {}
        for i, symbol in enumerate(forces):
            value = frame.settled(passed.at_point(passed.law.inner[i]))
            value = out.values.written(value).xreplace(outside)
            if passed.law.free == i:
                value += passed.law.ratio * own
            if value != symbol:
                update[symbol] = value
        if update:
            lines.append(Update(update))
    return Residual(tuple(known), tuple(on_shaft), tuple(lines))


def _named(lets: list[Let], value: sp.Expr, symbol: sp.Symbol, doc: str) -> sp.Expr:
    """Return what stands for a torque, and name it where it takes arithmetic."""
    if value.is_Atom:
        return value
    lets.append(Let(symbol, value, doc, "N m"))
    return symbol


def _own(passed: Passed, frame: Frame) -> sp.Expr:
    """Return the own force of an element that gives way, by differences of motion where it is a law of these."""
    value = frame.settled(passed.at_point(passed.law.own))
    ports = (port.motions[frame.own] for port in (passed.element.inboard, passed.element.outboard))
    inner, outer = ports
    return grouped(
        value, {k: (passed.point[getattr(inner, k)], passed.point[getattr(outer, k)]) for k in KINDS}
    )
