"""Bounds with and without units."""

from __future__ import annotations

import math

import pytest

from tmm_gen.errors import UserError
from tmm_gen.study.bounds import ErrorBound, read_error, read_time


@pytest.mark.parametrize(
    ("text", "value", "unit"),
    [
        ("1e-3", 1e-3, ""),
        ("0.1%", 1e-3, ""),
        ("0.5mm", 5e-4, "m"),
        ("2 mrad", 2e-3, "rad"),
        ("1deg", math.pi / 180, "rad"),
        ("3 N", 3.0, "N"),
    ],
)
def test_errors(text: str, value: float, unit: str) -> None:
    bound = read_error(text)
    assert bound.value == pytest.approx(value, rel=1e-15)
    assert bound.unit == unit


@pytest.mark.parametrize("text", ["", "nought", "-1", "0", "1e400", "1 furlong", "1e-3 2", "nan"])
def test_what_is_no_error_bound(text: str) -> None:
    with pytest.raises(UserError, match=r"--max-error"):
        read_error(text)


def test_relative_to_the_travel() -> None:
    assert read_error("1mm").relative(0.5, "m") == pytest.approx(2e-3)
    assert read_error("1e-3").relative(0.5, "m") == 1e-3
    with pytest.raises(UserError, match="the output is in rad"):
        ErrorBound(1.0, "m").relative(1.0, "rad")


def test_times() -> None:
    micro = ("200us", "200µs", "200\N{GREEK SMALL LETTER MU}s")
    assert [read_time(text) for text in ("2", *micro, "1 ms", "50ns")] == pytest.approx(
        [2.0, 2e-4, 2e-4, 2e-4, 1e-3, 5e-8]
    )
    for text in ("5 min", "-1s", "soon"):
        with pytest.raises(UserError, match=r"--max-time"):
            read_time(text)
    with pytest.raises(UserError, match=r"Use s, ms, µs, ns\."):
        read_time("5 min")
