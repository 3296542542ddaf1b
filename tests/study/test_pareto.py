"""The front is what a comparison of all with all leaves."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from tmm_gen.study.pareto import pareto_front

numbers = st.sampled_from([0.0, 0.5, 1.0, 2.0, 3.0, float("inf")])


@given(st.lists(st.tuples(numbers, numbers)))
def test_front_is_what_nothing_beats(points: list[tuple[float, float]]) -> None:
    front = pareto_front(points)
    for k, (error, cost) in enumerate(points):
        beaten = any(
            (e <= error and c <= cost) and (e < error or c < cost or j < k)
            for j, (e, c) in enumerate(points)
            if j != k
        )
        assert (k in front) == (not beaten and error < float("inf"))
    assert [points[k][1] for k in front] == sorted(points[k][1] for k in front)
