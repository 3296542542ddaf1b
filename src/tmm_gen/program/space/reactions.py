"""The forces that a known motion takes, handed in from the tips to the base: no joint gives way."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from tmm_gen.derive.space.declaration import ACCEL, ALPHA, OMEGA
from tmm_gen.derive.space.inward import BIAS
from tmm_gen.derive.space.pattern import Pattern
from tmm_gen.derive.station.lets import Line
from tmm_gen.program.space.layout import SpaceLayout
from tmm_gen.program.space.loads import loads_on_frames
from tmm_gen.program.space.walks import SpaceWalks, outward
from tmm_gen.program.statements import Order, Statement


def handed_in(
    layout: SpaceLayout, walks: SpaceWalks, inward: Callable[[Pattern], Sequence[Line]]
) -> list[Statement]:
    """Return a walk out by the motion that the state has, and one in with all forces, loads included.

    Parameters
    ----------
    walks : SpaceWalks
        At that motion.
    inward : callable
        Lines of a station on the way in, by its pattern.
    """
    loads = loads_on_frames(layout, walks, lambda column: layout.held[column].ref, whole=True)
    motion = (*OMEGA, *ALPHA, *ACCEL)
    return [
        *walks.walk(Order.OUTWARD, lambda p: outward(p.freed, False).lines, motion, whole=True),
        *(statement for section in loads for statement in section.statements),
        *walks.walk(Order.INWARD, inward, tuple(BIAS), whole=True),
    ]
