"""Finite segments are of second order whatever sits on a beam's ends; a spring at the clamp is not."""

from __future__ import annotations

from typing import Any

import pytest
from segment_ends import FREQUENCIES, ROUNDING, cases, rows_of


@pytest.fixture(scope="module")
def rows() -> dict[tuple[str, str], dict[str, Any]]:
    """Return errors and orders by arm and quantity."""
    return {(case.name, str(row["quantity"])): row for case in cases() for row in rows_of(case)}


def test_finite_segments_are_of_second_order(rows: dict[tuple[str, str], dict[str, Any]]) -> None:
    assert len(rows) > 10
    for row in rows.values():
        if row["quantity"] in (*FREQUENCIES, "tip place, y"):
            assert row["finite-segment_order"] == pytest.approx(2.0, abs=0.02)
        else:  # all of the flexibility under a moment is there
            assert row["finite-segment_32"] < ROUNDING


def test_a_spring_at_the_clamp_is_of_first_order_under_a_body_with_inertia(
    rows: dict[tuple[str, str], dict[str, Any]],
) -> None:
    for arm, quantity in (
        ("clamp, tip with inertia", "mode 2"),
        ("two beams, motor between", "mode 3"),
    ):
        assert rows[arm, quantity]["half-clamp_order"] == pytest.approx(1.0, abs=0.1)
    assert rows["clamp", "mode 1"]["half-clamp_order"] == pytest.approx(2.0, abs=0.02)
