"""Forces and moments on frames, in body axes or in those of the world."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import sympy as sp

from tmm_gen.derive.space import base_motion
from tmm_gen.derive.space.base_pose import found_facing_line
from tmm_gen.derive.space.outward import OWN_FORCE, OWN_MOMENT, wanted_forces
from tmm_gen.derive.space.pose import FACING, facing_lines
from tmm_gen.derive.station.lets import Line, Update
from tmm_gen.program.arm.loads import exactly
from tmm_gen.program.space.layout import SpaceLayout
from tmm_gen.program.space.walks import SpaceWalks
from tmm_gen.program.statements import Order, Section
from tmm_gen.scene.spatial.arm import ArmInput


def loads_on_frames(
    layout: SpaceLayout, walks: SpaceWalks, value: Callable[[str], sp.Expr], *, whole: bool = False
) -> list[Section]:
    """Return what forces and moments on frames take off what bodies take.

    Parameters
    ----------
    layout : SpaceLayout
        The arm's variables.
    walks : SpaceWalks
        Of the sweep, whose way out stands before.
    value : callable
        Returns an input by its column.
    whole : bool
        Whether all forces on joints that are given are asked for, not only what others' motion takes of them.
    """
    floats = layout.base is not None
    loads = [i for i in layout.arm.inputs if i.frame is not None and (i.frame.joint or floats)]
    sections = []
    for item in loads:
        assert item.frame is not None
        vector = sp.Matrix([value(column) for column in item.columns])
        station = item.frame.joint - 1
        title = load_title(item)
        turn = sp.Matrix(3, 3, lambda i, j, rows=item.frame.turn: exactly(rows[i][j]))
        if not item.frame.joint:
            acting = (turn if item.axes == "body" else base_motion.FACING) * vector
            names = (base_motion.OWN_FORCE, base_motion.OWN_MOMENT)
            sections.append(Section(title, tuple(walks.base_lines(_taken_off(item, acting, names)))))
            continue
        pattern = layout.tree.pattern(station)
        wanted = wanted_forces(pattern.freed if whole else pattern)
        if not wanted:
            continue
        if item.axes == "body":
            lines = _taken_off(item, turn * vector, wanted=wanted)
            sections.append(Section(title, tuple(walks.at_station(station, lines))))
            continue

        def read(
            at: int,
            station: int = station,
            item: ArmInput = item,
            v: sp.Matrix = vector,
            wanted: frozenset[sp.Symbol] = wanted,
        ) -> Sequence[Line]:
            return _taken_off(item, FACING * v, wanted=wanted) if at == station else ()

        walked = walks.walk(
            Order.OUTWARD,
            facing_lines,
            tuple(FACING),
            read,
            layout.tree.inward_of(station),
            found_facing_line() if floats else (),
        )
        sections.append(Section(title, tuple(walked)))
    return sections


def load_title(item: ArmInput) -> str:
    """Return the title of the section of a force or a moment."""
    assert item.frame is not None
    return f"{item.acts} on '{item.frame.name}'" + (", in world axes" if item.axes == "world" else "")


def _taken_off(
    item: ArmInput,
    acting: sp.Matrix,
    names: tuple[sp.Matrix, sp.Matrix] = (OWN_FORCE, OWN_MOMENT),
    wanted: frozenset[sp.Symbol] | None = None,
) -> tuple[Line, ...]:
    """Return what a load, in the axes of a body, takes off what the body takes.

    Parameters
    ----------
    names : tuple of 2 sympy.Matrix
        Of the body's force and moment.
    wanted : frozenset of sympy.Symbol, optional
        What of them is asked for; all if left out.
    """
    assert item.frame is not None
    place = sp.Matrix([exactly(r) for r in item.frame.at])
    force, moment = (acting, place.cross(acting)) if item.acts == "force" else (sp.zeros(3, 1), acting)
    pairs = zip((*names[0], *names[1]), (*force, *moment), strict=True)
    taken = {s: s - value for s, value in pairs if value != 0 and (wanted is None or s in wanted)}
    return (Update(taken),)
