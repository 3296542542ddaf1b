"""Beams of many cells are loops: neither the program nor its text grows with them."""

from __future__ import annotations

from functools import cache

import pytest
from support.spatial.beams import Beam, add_beam
from support.spatial.kernels import HEADED, program_of

from tmm_gen.emit.numpy import emit_numpy
from tmm_gen.program.space.assemble import SpaceChoices
from tmm_gen.program.statements import Loop, Program
from tmm_gen.scene.spatial.arm import Revolute, SpatialArm

FEW, MANY = 6, 60
BEAM = Beam(1.0, (2.0, 5.0), 0.8, 1.0, 2e-4, decay=1e-3)


@cache
def built(cells: int, twists: bool, exact: bool) -> Program:
    """Return the program of a beam under gravity."""
    joints: list[Revolute] = []
    add_beam(joints, BEAM, cells, twists=twists)
    return program_of(
        SpatialArm(tuple(joints), gravity=(0.0, 0.0, -9.81)),
        choices=SpaceChoices(1e-3, iterations=2 - exact, exact=exact),
    )


def statements(program: Program) -> int:
    """Return how many assignments all routines hold, those of a loop counted once."""
    routines = (program.prepare, program.initialise, program.main, program.output)
    return sum(
        len(statement.body) if isinstance(statement, Loop) else 1
        for routine in routines
        for statement in routine.statements()
    )


@pytest.mark.parametrize("exact", [False, True], ids=["inertial", "exact"])
@pytest.mark.parametrize("twists", [False, True], ids=["bends", "twists"])
def test_text_is_that_of_a_short_beam(twists: bool, exact: bool) -> None:
    few, many = (built(cells, twists, exact) for cells in (FEW, MANY))
    assert many.stations == MANY * (3 if twists else 2)
    assert statements(many) == statements(few)
    # numbers of stations, and values one a station, are longer
    assert lines(many) == lines(few)


def lines(program: Program) -> int:
    """Return how many lines of its NumPy text compute something."""
    text = "\n".join(emit_numpy(program, HEADED).values())
    return sum(" = " in line for line in text.splitlines())
