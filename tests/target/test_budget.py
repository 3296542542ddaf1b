"""Figures held against a budget."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tmm_gen.scene.emit import Budget
from tmm_gen.target import Measurement, against_budget
from tmm_gen.target.bits import Difference

FOUND = Measurement(
    target="cortex-m4f",
    title="Cortex-M4F",
    real="float32",
    instructions_per_step=510,
    instructions_least=510,
    step_bytes=300,
    code_bytes=900,
    ram_bytes=272,
    stack_bytes=152,
    stack_proved=True,
    bits_equal=True,
    difference=Difference("", 0.0, 0.0),
    library_functions=(),
    steps=256,
    hardware_reals=("float32",),
)


def test_what_has_no_bound_holds() -> None:
    assert all(row.passed and row.bound is None for row in against_budget(FOUND, None))


@pytest.mark.parametrize(
    ("key", "figure"),
    [
        ("instructions", "instructions_per_step"),
        ("flash", "code_bytes"),
        ("ram", "ram_bytes"),
        ("stack", "stack_bytes"),
    ],
)
def test_each_bound_binds_its_figure(key: str, figure: str) -> None:
    value = getattr(FOUND, figure)
    kept = against_budget(FOUND, Budget(**{key: value}))
    assert all(row.passed for row in kept)
    broken = [row for row in against_budget(FOUND, Budget(**{key: value - 2})) if not row.passed]
    assert [row.figure for row in broken] == [figure]
    assert f"{figure} is {value}, 2 (" in broken[0].excess
    assert f"more than {value - 2}" in broken[0].excess


def test_the_origin_of_the_stack_is_said() -> None:
    assert "proved" in against_budget(FOUND, None)[3].meaning
    assert "run" in against_budget(replace(FOUND, stack_proved=False), None)[3].meaning
