"""The way in without elimination: what forces a known motion takes, handed from body to body."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.space.declaration import AXES
from tmm_gen.derive.space.inward import BIAS
from tmm_gen.derive.space.outward import OWN_FORCE, OWN_MOMENT, Outward
from tmm_gen.derive.space.sheet import Sheet
from tmm_gen.derive.station.lets import Line, Update

_NAMES = [f"{what}_{axis}" for what in ("force", "moment") for axis in AXES]


def acting(sheet: Sheet, out: Outward) -> sp.Matrix:
    """Return the forces at the outer side of a station's joint, (6,): its body's own, and what hangs on it."""
    own = [*OWN_FORCE, *OWN_MOMENT] if out.pattern.acted else [sp.Integer(0)] * 6
    values = [mine + (0 if out.pattern.tip else carried) for mine, carried in zip(own, BIAS, strict=True)]
    return _named(sheet, "acting", sp.Matrix(values))


def passed_lines(out: Outward) -> tuple[Line, ...]:
    """Return how the forces pass to the station's inner side."""
    sheet = Sheet()
    forces = acting(sheet, out)
    for crossing in reversed(out.crossings):
        forces = _named(sheet, "passed", crossing.equations.forces * forces)
    return (*sheet.lets, Update(dict(zip(BIAS, forces, strict=True))))


def axis_lines(out: Outward, target: sp.Symbol) -> tuple[Line, ...]:
    """Return the moment about the joint's axis, N m: what drives a joint whose motion is given."""
    sheet = Sheet()
    return (*sheet.lets, Update({target: acting(sheet, out)[3 + out.pattern.axis]}))


def _named(sheet: Sheet, stage: str, forces: sp.Matrix) -> sp.Matrix:
    return sp.Matrix([sheet.named(f"{stage}_{name}", f) for name, f in zip(_NAMES, forces, strict=True)])
