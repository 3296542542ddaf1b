"""The emitted linear MPC on emulated microcontrollers: the host's bits, within its budget."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from support.mpc_on_board import run_on_board

from tmm_gen.control.bench import Bench
from tmm_gen.onboard.emit import emit_controller

pytestmark = pytest.mark.compiler

INSTRUCTIONS = 200_000
FLASH, RAM = 50_000, 32_000


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
