"""Finite segments are of second order whatever sits on a beam's ends; a spring at the clamp is not."""

from __future__ import annotations

from typing import Any

import pytest
from segment_ends import FREQUENCIES, ROUNDING, cases, cut, rows_of

from tmm_gen.modal.beam.member import Member
from tmm_gen.scene import parse_scene

BEAM = """
name = "clamped"
[model]
kind = "planar"
[integrator]
name = "newmark"
step = 1e-3
[base]
kind = "clamp"
[[beam]]
name = "beam"
on = "base"
length = 1.0
bending_stiffness = 1.0
mass_per_length = 1.0
links = {links}
[[output]]
name = "end"
at = "beam"
of = "position"
"""


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


def test_clamped_segments_are_too(rows: dict[tuple[str, str], dict[str, Any]]) -> None:
    for row in rows.values():
        if row["quantity"] in (*FREQUENCIES, "tip place, y"):
            assert row["clamped-segment_order"] == pytest.approx(2.08, abs=0.08)
        else:
            assert row["clamped-segment_32"] < ROUNDING


@pytest.mark.parametrize("links", [1, 2, 5])
def test_scenes_cut_clamped_beams_so(links: int) -> None:
    scene = parse_scene(BEAM.format(links=links))
    stations = cut(Member(1.0, 1.0, 1.0), links, "clamped-segment")
    for (joint, link), found, rod in zip(stations, scene.joints, scene.links, strict=True):
        assert found.stiffness == pytest.approx(joint.stiffness, rel=1e-14)
        for key in ("length", "mass", "inertia", "center"):
            assert getattr(rod, key) == pytest.approx(getattr(link, key), rel=1e-14)
    assert sum(link.length for link in scene.links) == pytest.approx(1.0, rel=1e-14)


def test_a_spring_at_the_clamp_is_of_first_order_under_a_body_with_inertia(
    rows: dict[tuple[str, str], dict[str, Any]],
) -> None:
    for arm, quantity in (
        ("clamp, tip with inertia", "mode 2"),
        ("two beams, motor between", "mode 3"),
    ):
        assert rows[arm, quantity]["half-clamp_order"] == pytest.approx(1.0, abs=0.1)
    assert rows["clamp", "mode 1"]["half-clamp_order"] == pytest.approx(2.0, abs=0.02)
