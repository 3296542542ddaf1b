"""Kernels whose numbers are sums of two, on boards and under analysers."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from tmm_gen.emit.c import emit_c
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene
from tmm_gen.target import Measurement, prove
from tmm_gen.target.lint import CHECKS

SUMS = {"real": "float32", "compensated": True, "trigonometry": "own"}

Emitting = Callable[..., Scene]
Measured = Callable[..., Measurement]


@pytest.mark.xdist_group("boards")
@pytest.mark.parametrize(
    ("target", "name"),
    [("cortex-m4f", "drivetrain"), ("cortex-m4f", "swing"), ("rv32imafdc", "thesis10")],
)
def test_the_same_bits_in_constant_time(measured: Measured, target: str, name: str) -> None:
    found = measured(target, name, **SUMS)
    assert found.bits_equal
    assert found.instructions_per_step == found.instructions_least
    assert found.library_functions == ()  # the fused multiply-add is an instruction


@pytest.mark.xdist_group("boards")
def test_what_it_costs(measured: Measured) -> None:
    plain = measured("cortex-m4f", "drivetrain", real="float32")
    sums = measured("cortex-m4f", "drivetrain", **SUMS)
    double = measured("cortex-m4f", "drivetrain", real="float64")
    assert sums.instructions_per_step < 8 * plain.instructions_per_step
    assert 4 * sums.instructions_per_step < double.instructions_per_step


@pytest.mark.parametrize("check", ["misra", "single_precision"])
def test_analysers_have_nothing_to_say(
    emitting: Emitting, need_tool: Callable[[str, str], str], check: str
) -> None:
    need_tool("cppcheck", "cppcheck")
    need_tool("arm-none-eabi-gcc", "gcc-arm-none-eabi")
    scene = emitting("thesis10", **SUMS)
    row = CHECKS[check](emit_c(build_program(scene), scene))
    assert row.passed, row.said


def test_a_chain_is_proved(emitting: Emitting, need_tool: Callable[[str, str], str]) -> None:
    need_tool("frama-c", "frama-c-base")
    found = prove(emitting("thesis10", **SUMS))
    assert found.proved, found.alarms
