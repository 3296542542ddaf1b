"""Emitted controllers on emulated microcontrollers: the host's bits, or nearly, within their budgets."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from support.mpc_on_board import run_on_board

from tmm_gen.control.bench import Bench
from tmm_gen.onboard.emit import emit_controller
from tmm_gen.scene import load_scene

pytestmark = pytest.mark.compiler

INSTRUCTIONS = 200_000
FLASH, RAM = 50_000, 32_000
ELBOW = Path(__file__).resolve().parents[3] / "scenes" / "elbow.toml"


@dataclass(frozen=True)
class Budget:
    """What zero-order iterations of `elbow` may take on a Cortex-M7 in single precision, sensitivities found there."""

    instructions: int = 2_050_000
    reset: int = 6_620_000
    flash: int = 39_500
    ram: int = 112_400
    stack: int = 5_320


@pytest.fixture(scope="module")
def tools(need_tool: Callable[[str, str], str]) -> None:
    need_tool("arm-none-eabi-gcc", "gcc-arm-none-eabi picolibc-arm-none-eabi")
    need_tool("qemu-system-arm", "qemu-system-arm")


@pytest.mark.usefixtures("tools")
@pytest.mark.parametrize(
    ("target", "kind", "real"),
    [
        ("cortex-m7", "mpc-links", "float64"),
        ("cortex-m7", "mpc-modes", "float64"),
        ("cortex-m4f", "mpc-modes", "float32"),
    ],
)
def test_bits_and_budget(
    target: str, kind: str, real: str, bench: Bench, recorded: Callable[..., object]
) -> None:
    loop = recorded(kind, 60)
    name, files = emit_controller(bench, kind, real)
    found = run_on_board(target, name, files, loop.measured[:, :2], real)
    assert found.bits_equal
    assert found.fallbacks == 0
    assert found.samples == 60
    assert found.code_bytes <= FLASH
    assert found.ram_bytes <= RAM
    assert found.stack_bytes < 2048
    if target == "cortex-m7":
        assert found.instructions_per_sample <= INSTRUCTIONS
    assert 0 < found.instructions_median <= found.instructions_per_sample
    assert 0 < found.instructions_feedback < found.instructions_per_sample


@pytest.mark.usefixtures("tools")
def test_two_motors_in_single_precision_are_within_their_budget() -> None:
    """Of an arm that rests where it starts; what sines of another library make of its torques is nothing."""
    bench, budget = Bench.of(load_scene(ELBOW)), Budget()
    name, files = emit_controller(bench, "rti-zero", "float32")
    still = np.tile(bench.problem.start, (4, 1))
    found = run_on_board("cortex-m7", name, files, still, "float32")
    assert found.fallbacks == 0
    assert 0.0 < found.torque_off < 1e-5
    assert 0.6 * budget.instructions < found.instructions_per_sample <= budget.instructions
    assert 0.6 * budget.reset < found.instructions_reset <= budget.reset
    assert found.code_bytes <= budget.flash
    assert found.ram_bytes <= budget.ram
    assert found.stack_bytes <= budget.stack
