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
from tmm_gen.derive.station.written import grouped
from tmm_gen.errors import UserError


@dataclass(frozen=True)
class Residual:
    """What a station, or what stands at an end of the row, makes of the forces beyond it.

    Parameters
    ----------
    known : tuple of Let
        Own force of the element that gives way.
    lines : tuple of Line
        Forces at the inner side, and what is left over.
    """

    known: tuple[Let, ...]
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

    Raises
    ------
    UserError
        If two elements of a station give way: the motion of what lies between them is not carried.
    """
    out = Outward(elements, frame, moved=moved)
    if out.turning is not None:
        raise UserError(
            f"element '{out.turning.element.name}': what the equations of a shaft without inertia leave over is not "
            "derived yet. Use an integrator whose stages are solved one after another, such as 'sdirk4'."
        )
    known: list[Let] = []
    lines: list[Line] = []
    forces = [force(c) for c in frame.coordinates]
    for passed in reversed(out.passed):
        outside = dict(zip(passed.element.outboard.forces, forces, strict=True))
        own = sp.Integer(0)
        if passed.law.free is not None:
            own = _own(passed, frame)
            if not own.is_Atom:
                doc = "torque of each joint at a stage"
                known.append(Let(TORQUE, own, doc, "N m"))
                own = TORQUE
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
    return Residual(tuple(known), tuple(lines))


def _own(passed: Passed, frame: Frame) -> sp.Expr:
    """Return the own force of an element that gives way, by differences of motion where it is a law of these."""
    value = frame.settled(passed.at_point(passed.law.own))
    ports = (port.motions[frame.own] for port in (passed.element.inboard, passed.element.outboard))
    inner, outer = ports
    return grouped(
        value, {k: (passed.point[getattr(inner, k)], passed.point[getattr(outer, k)]) for k in KINDS}
    )
