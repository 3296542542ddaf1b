"""Finite segments are of second order whatever sits on a beam's ends; a spring at the clamp is not."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from segment_ends import (
    FREQUENCIES,
    HUB,
    MODES,
    ROUNDING,
    RULES,
    TIP,
    Rule,
    cases,
    clamped,
    cut,
    rows_of,
    turned,
)

from tmm_gen.modal.beam.member import Member
from tmm_gen.modal.discretised import straight_frequencies
from tmm_gen.scene import Scene, parse_scene

BEAM = """
name = "clamped"
[model]
kind = "planar"
[integrator]
name = "newmark"
step = 1e-3
[base]
kind = "{base}"
{beam}
length = 1.0
bending_stiffness = 1.0
mass_per_length = 1.0
links = {links}
{springs}
{tip}
[[output]]
name = "end"
at = "tip"
of = "position"
"""
NAMED, SHORT = '[[beam]]\nname = "beam"\non = "base"', "[beam]"
ON_HUB = f'motor"\ninertia = {HUB}\n#"'
"""A hub in place of the clamp."""


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
            assert row["clamped-segment_order"] == pytest.approx(2.075, abs=0.08)
        else:
            assert row["clamped-segment_32"] < ROUNDING


@pytest.mark.parametrize("links", [1, 2, 5])
@pytest.mark.parametrize("beam", [NAMED, SHORT])
def test_scenes_cut_clamped_beams_so(beam: str, links: int) -> None:
    scene = parse_scene(BEAM.format(base="clamp", beam=beam, links=links, springs="", tip=""))
    stations = cut(Member(1.0, 1.0, 1.0), links, "clamped-segment")
    for (joint, link), found, rod in zip(stations, scene.joints, scene.links, strict=True):
        assert found.stiffness == pytest.approx(joint.stiffness, rel=1e-14)
        for key in ("length", "mass", "inertia", "center"):
            assert getattr(rod, key) == pytest.approx(getattr(link, key), rel=1e-14)
    assert sum(link.length for link in scene.links) == pytest.approx(1.0, rel=1e-14)


def short(base: str, rule: Rule, links: int) -> Scene:
    tip = f"[tip]\nmass = {TIP.mass}\ninertia = {TIP.inertia}"
    return parse_scene(
        BEAM.format(base=base, beam=SHORT, links=links, springs=f'springs = "{rule}"', tip=tip)
    )


@pytest.mark.parametrize("links", [4, 9])
@pytest.mark.parametrize("rule", [rule for rule in RULES if rule != "finite-segment"])
def test_frequencies_are_those_of_scenes(rule: Rule, links: int) -> None:
    """Of the short form, on a clamp and on a hub, by its own sweep for modes."""
    held = straight_frequencies(short("clamp", rule, links))[:MODES]
    np.testing.assert_allclose(held, clamped(links, rule, TIP), rtol=1e-10)
    on_hub = straight_frequencies(short(ON_HUB, rule, links))[1 : MODES + 1]
    np.testing.assert_allclose(on_hub, turned(links, rule, TIP), rtol=1e-10)


def test_what_clamped_segments_cost_where_nothing_turns_with_the_tip(
    rows: dict[tuple[str, str], dict[str, Any]],
) -> None:
    """There half-clamp is of second order too and always a little better; finite segments are better than both."""
    plain = [row for row in rows.values() if row["ends"] == "nothing"]
    assert len(plain) == 4 * MODES
    for row in plain:
        worse = [row[f"clamped-segment_{n}"] / row[f"half-clamp_{n}"] for n in (4, 8, 16, 32)]
        assert 1.0 < min(worse) <= max(worse) < 1.4
        assert worse[-1] < 1.05
        assert all(row[f"finite-segment_{n}"] < row[f"half-clamp_{n}"] for n in (4, 8, 16, 32))


def test_a_spring_at_the_clamp_is_of_first_order_under_a_body_with_inertia(
    rows: dict[tuple[str, str], dict[str, Any]],
) -> None:
    for arm, quantity in (
        ("clamp, tip with inertia", "mode 2"),
        ("hub, tip with inertia", "mode 1"),
        ("two beams, motor between", "mode 3"),
    ):
        assert rows[arm, quantity]["half-clamp_order"] == pytest.approx(1.0, abs=0.1)
    assert rows["clamp", "mode 1"]["half-clamp_order"] == pytest.approx(2.0, abs=0.02)
