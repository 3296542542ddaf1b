from __future__ import annotations

import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from tmm_gen.derive.integrators.declaration import STEP, past, stage
from tmm_gen.derive.integrators.interpolation import (
    TIME,
    Datum,
    backward_difference,
    derivative,
    interpolant,
    known,
    motion_relations,
)

rationals = st.fractions(min_value=-9, max_value=9, max_denominator=9).map(sp.Rational)


@settings(max_examples=30)
@given(st.lists(rationals, min_size=4, max_size=4), st.permutations([0, -1, -2, 1]), st.integers(0, 2))
def test_a_cubic_is_found_again(coefficients: list[sp.Rational], instants: list[int], order: int) -> None:
    """Through three values and one derivative."""
    cubic = sum(c * TIME**k for k, c in enumerate(coefficients))
    data = [Datum(sp.Integer(i), cubic.subs(TIME, i)) for i in instants[:3]]
    last = sp.Integer(instants[3])
    data.append(Datum(last, derivative(cubic, order, last), order))
    if order == 2 and sum(instants[:3]) == 3 * last:
        return  # a cubic may bend there without bending between the points: not determined
    assert sp.expand(interpolant(data) - cubic) == 0


def test_data_that_determine_nothing_are_refused() -> None:
    twice = Datum(sp.Integer(0), sp.Integer(1))
    with pytest.raises(ValueError, match="do not determine"):
        interpolant([twice, Datum(sp.Integer(0), sp.Integer(2))])
    with pytest.raises(ValueError, match="do not determine"):
        interpolant([twice, twice])


@settings(max_examples=8)
@given(st.lists(rationals, min_size=4, max_size=4))
def test_motion_relations_hold_on_a_cubic(coefficients: list[sp.Rational]) -> None:
    time = sp.Symbol("t")
    cubic = sum(c * time**k for k, c in enumerate(coefficients))
    motion = {"q": cubic, "v": sp.diff(cubic, time), "a": sp.diff(cubic, time, 2)}
    at = {stage(kind, 1): motion[kind].subs(time, STEP) for kind in ("q", "v", "a")}
    at |= {
        past(kind, lag): motion[kind].subs(time, -lag * STEP) for kind in ("q", "v", "a") for lag in range(3)
    }
    for data in (
        [known("q", 2), known("q", 1), known("q")],
        [known("q"), known("v"), known("a")],
        [known("a", 1), known("q", 1), known("q")],
    ):
        assert all(sp.expand(relation.subs(at)) == 0 for relation in motion_relations(data))


def test_backward_differences_are_the_textbook_ones() -> None:
    new = stage("q", 1)
    older = [Datum(sp.Integer(-lag), past("q", lag)) for lag in range(3)]
    two = (3 * new - 4 * past("q") + past("q", 1)) / (2 * STEP)
    three = (11 * new - 18 * past("q") + 9 * past("q", 1) - 2 * past("q", 2)) / (6 * STEP)
    assert sp.expand(backward_difference(older[:2], new) - two) == 0
    assert sp.expand(backward_difference(older, new) - three) == 0
