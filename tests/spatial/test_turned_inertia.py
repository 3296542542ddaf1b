"""Turning an inertia by what goes from one end of each diagonal to the other: the products of matrices, exactly."""

from __future__ import annotations

import pytest
import sympy as sp

from tmm_gen.derive.space.congruence import congruent, turned
from tmm_gen.derive.space.inward import ARTICULATED, through_accelerations
from tmm_gen.derive.space.outward import COSINE, SINE, passages
from tmm_gen.derive.space.pattern import Pattern
from tmm_gen.derive.space.sheet import Sheet

NONE = (False, False, False)
UPRIGHT = ((1, 0, 0), (0, 1, 0), (0, 0, 1))


@pytest.mark.parametrize("axis", range(3))
def test_it_is_the_congruence_on_the_circle(axis: int) -> None:
    (hinge,) = passages(Pattern(axis, NONE, UPRIGHT, True, NONE, (False,) * 6))
    at = {SINE: sp.Rational(5, 13), COSINE: sp.Rational(-12, 13)}
    at |= {ARTICULATED[i, j]: sp.Integer((i + 2) ** (j % 3 + 1) + j) for i in range(6) for j in range(i, 6)}

    def values(sheet: Sheet, found: sp.Matrix) -> sp.Matrix:
        known = dict(at)
        for let in sheet.lets:
            known[let.symbol] = let.value.xreplace(known)
        return found.xreplace(known)

    one, other = Sheet(), Sheet()
    short = values(one, turned(one, ARTICULATED, hinge.turn, axis))
    assert short == values(other, congruent(other, ARTICULATED, through_accelerations(hinge)))
    operations = [sum(int(sp.count_ops(let.value)) for let in sheet.lets) for sheet in (one, other)]
    assert operations[0] < operations[1]
