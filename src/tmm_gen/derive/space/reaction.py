"""The way in without elimination: what forces a known motion takes, handed from body to body."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.space.inward import BIAS, IMBALANCE, TORQUE, acting_forces, named_forces
from tmm_gen.derive.space.outward import Outward
from tmm_gen.derive.space.sheet import Sheet
from tmm_gen.derive.station.lets import Let, Line, Update


def passed_lines(out: Outward) -> tuple[Line, ...]:
    """Return how the forces pass to a station's inner side."""
    sheet = Sheet()
    return _passed(sheet, out, acting_forces(sheet, out))


def lacking_lines(out: Outward) -> tuple[Line, ...]:
    """Return the torque that a joint lacks at its exact motion, and how the forces pass to the inner side.

    Where the motion is given it lacks none; what such a joint carries passes no forces on.
    """
    if out.pattern.given:
        return (Let(IMBALANCE, sp.Integer(0), "torque that the joint lacks", "N m"),)
    sheet = Sheet()
    forces = acting_forces(sheet, out)
    lacking = Let(IMBALANCE, forces[3 + out.pattern.axis] + TORQUE, "torque that the joint lacks", "N m")
    if out.pattern.unyielding:
        return (*sheet.lets, lacking)
    *lets, passed = _passed(sheet, out, forces)
    return (*lets, lacking, passed)


def _passed(sheet: Sheet, out: Outward, forces: sp.Matrix) -> tuple[Line, ...]:
    *before, first = reversed(out.crossings)
    for crossing in before:
        forces = named_forces(sheet, crossing.equations.forces * forces)
    forces = first.equations.forces * forces
    return (*sheet.lets, Update(dict(zip(BIAS, forces, strict=True))))


def based_lines(out: Outward, totals: sp.Matrix) -> tuple[Line, ...]:
    """Return how the forces pass to a station's inner side; on the base they are added to totals, (3,), N."""
    lines = passed_lines(out)
    if not out.pattern.rooted:
        return lines
    added = {total: total + force for total, force in zip(totals, BIAS[:3], strict=True)}
    return (*lines, Update(added))


def axis_lines(out: Outward, target: sp.Symbol) -> tuple[Line, ...]:
    """Return the moment about a joint's axis, N m: what drives it where its motion is given."""
    sheet = Sheet()
    about = acting_forces(sheet, out)[3 + out.pattern.axis]
    return (*sheet.lets, Update({target: about}))
