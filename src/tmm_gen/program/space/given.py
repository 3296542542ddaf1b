"""What moves as inputs say, at the stages of a step and at its end: joints on the base, and the base itself."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import sympy as sp

from tmm_gen.derive.integrators.declaration import KINDS, Kind, Past, Scheme
from tmm_gen.derive.space.declaration import BASE_ACCEL
from tmm_gen.program.space.layout import SpaceLayout, instants, kernel_columns
from tmm_gen.program.statements import Assign
from tmm_gen.program.variables import Variable
from tmm_gen.scene.signal import ACCELERATION


def given_motion(
    layout: SpaceLayout, motion: Mapping[Kind, Variable], value: Callable[[str], sp.Expr]
) -> list[Assign]:
    """Set the motion of joints where it is given.

    Parameters
    ----------
    motion : mapping from "q", "v", "a" to Variable
        Arrays over the joints, of what is set.
    value : callable
        Returns an input by its column.
    """
    return [
        Assign(motion[kind].entry(item.joint - 1), value(name))
        for item in layout.arm.inputs
        if item.acts == "angle"
        for kind, name in zip(KINDS, kernel_columns(item), strict=True)
        if kind in motion
    ]


def given_end(layout: SpaceLayout, scheme: Scheme) -> list[Assign]:
    """Set the motion of joints at the end of the step, where it is given."""
    last = len(instants(scheme, given=True)) - 1
    newest = {kind: layout.state[Past(kind, 0)] for kind in KINDS}
    return given_motion(layout, newest, lambda name: layout.input(name, last))


def base_moved(layout: SpaceLayout, value: Callable[[str], sp.Expr]) -> dict[sp.Symbol, sp.Expr]:
    """Return how a base is accelerated, where that is given.

    Parameters
    ----------
    value : callable
        Returns an input by its column.
    """
    return {
        symbol: value(item.name + ACCELERATION)
        for symbol, item in zip(BASE_ACCEL, layout.arm.along, strict=True)
        if item
    }
