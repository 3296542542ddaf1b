"""Slopes turned by what a turn leaves alone are those turned row by row and column by column."""

from __future__ import annotations

import pytest
import sympy as sp

from tmm_gen.derive.space.declaration import ANGLE, hinge
from tmm_gen.derive.space.outward import COSINE, SINE
from tmm_gen.derive.space.sheet import Sheet
from tmm_gen.derive.space.turning import HingeTurn


@pytest.mark.parametrize("axis", range(3))
def test_a_block_turns_as_its_rows_and_columns_do(axis: int) -> None:
    block = sp.Matrix(3, 3, sp.symbols("b:9", real=True))
    sheet = Sheet()
    found = HingeTurn(sheet, axis).block("force_by_alpha", block)
    for let in reversed(sheet.lets):
        found = found.xreplace({let.symbol: let.value})
    turn = hinge(axis).turn
    wanted = turn.T * block * turn
    circle = {SINE: sp.sin(ANGLE), COSINE: sp.cos(ANGLE)}
    assert (found.xreplace(circle) - wanted).applyfunc(sp.expand).applyfunc(sp.trigsimp) == sp.zeros(3, 3)
