"""The way in without elimination: what forces a known motion takes, handed from body to body."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.space.inward import BIAS, acting_forces, named_forces
from tmm_gen.derive.space.outward import Outward
from tmm_gen.derive.space.sheet import Sheet
from tmm_gen.derive.station.lets import Line, Update


def passed_lines(out: Outward) -> tuple[Line, ...]:
    """Return how the forces pass to a station's inner side."""
    sheet = Sheet()
    forces = acting_forces(sheet, out)
    *before, first = reversed(out.crossings)
    for crossing in before:
        forces = named_forces(sheet, crossing.equations.forces * forces)
    forces = first.equations.forces * forces
    return (*sheet.lets, Update(dict(zip(BIAS, forces, strict=True))))


def axis_lines(out: Outward, target: sp.Symbol) -> tuple[Line, ...]:
    """Return the moment about a joint's axis, N m: what drives it where its motion is given."""
    sheet = Sheet()
    about = acting_forces(sheet, out)[3 + out.pattern.axis]
    return (*sheet.lets, Update({target: about}))
