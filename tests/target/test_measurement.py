"""Kernels on emulated boards: the same bits as here, in constant time, within what the project promises."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from tmm_gen.errors import UserError
from tmm_gen.scene import Scene
from tmm_gen.target import Measurement, measure
from tmm_gen.target.harness import STEPS, swing

pytestmark = pytest.mark.xdist_group("boards")  # one worker measures for all

Measured = Callable[..., Measurement]


@pytest.mark.parametrize(("target", "real"), [("cortex-m4f", "float32"), ("cortex-m7", "float64")])
def test_the_arm_gives_the_bits_it_gives_here(measured: Measured, target: str, real: str) -> None:
    found = measured(target, "arm10", real=real)
    assert found.bits_equal
    assert found.library_functions == ()
    assert found.steps == STEPS


@pytest.mark.parametrize("real", ["float32", "float64"])
@pytest.mark.parametrize("name", ["thesis10", "arm10"])
def test_risc_v_gives_the_same_bits(measured: Measured, name: str, real: str) -> None:
    assert measured("rv32imafdc", name, real=real).bits_equal


@pytest.mark.parametrize("name", ["thesis10", "arm10"])
@pytest.mark.parametrize("parameters", ["free", "bound"])
def test_a_step_takes_constant_time(measured: Measured, name: str, parameters: str) -> None:
    found = measured("cortex-m4f", name, real="float32", parameters=parameters)
    assert found.instructions_per_step == found.instructions_least


def test_the_thesis_chain_is_small_and_fast(measured: Measured) -> None:
    found = measured("cortex-m4f", "thesis10", real="float32")
    assert found.bits_equal
    assert found.instructions_per_step <= 452
    assert found.step_bytes < found.code_bytes <= 1064  # 184 of them refuse NULL and what is not finite


def test_the_arm_is_small_and_fast(measured: Measured) -> None:
    found = measured("cortex-m4f", "arm10", real="float32")
    assert found.bits_equal
    assert found.instructions_per_step <= 2350
    assert found.code_bytes <= 3128


def test_a_fixed_arm_costs_no_memory_for_its_model(measured: Measured) -> None:
    free = measured("cortex-m4f", "arm10", real="float32")
    bound = measured("cortex-m4f", "arm10", real="float32", parameters="bound")
    numbers = 3 * 11 + 2 + 4  # state, inputs, outputs
    assert bound.ram_bytes == 4 * numbers
    assert free.ram_bytes > bound.ram_bytes
    assert bound.code_bytes < free.code_bytes


def test_the_stack_is_known_without_the_c_library(measured: Measured) -> None:
    assert measured("cortex-m4f", "arm10", real="float32").stack_proved
    library = measured("cortex-m4f", "arm10", real="float32", trigonometry="libm")
    assert not library.stack_proved
    assert library.library_functions == ("cosf", "sinf")
    assert library.stack_bytes >= measured("cortex-m4f", "arm10", real="float32").stack_bytes - 64


def test_sines_of_another_c_library_differ(measured: Measured) -> None:
    found = measured("cortex-m4f", "arm10", real="float32", trigonometry="libm")
    assert not found.bits_equal
    assert found.difference.first.startswith("hash")
    assert 0.0 < found.difference.last_step < 0.1


def test_doubles_in_software_are_a_hundred_times_as_many_instructions(measured: Measured) -> None:
    slow = measured("cortex-m4f", "thesis10", real="float64")
    fast = measured("cortex-m4f", "thesis10", real="float32")
    assert slow.bits_equal
    assert slow.instructions_per_step > 10 * fast.instructions_per_step
    assert "__aeabi_dmul" in slow.library_functions
    assert not any(name.startswith("__aeabi_d") for name in fast.library_functions)


def test_start_up_steps_are_not_counted(measured: Measured, emitting: Callable[..., Scene]) -> None:
    measured("cortex-m4f", "thesis10", real="float32")  # the tools are there
    scene = emitting("thesis10", real="float32").replace(**{"integrator.name": "houbolt"})
    found = measure(scene, "cortex-m4f")
    assert found.bits_equal
    assert found.instructions_per_step == found.instructions_least


def test_an_unknown_target_is_named_with_those_that_are(emitting: Callable[..., Scene]) -> None:
    with pytest.raises(UserError, match="cortex-m4f, cortex-m7, rv32imafdc"):
        measure(emitting("thesis10"), "cortex-m0")


@pytest.mark.parametrize(
    ("target", "package"), [("cortex-m4f", "gcc-arm-none-eabi"), ("rv32imafdc", "gcc-riscv64-unknown-elf")]
)
def test_a_missing_compiler_is_named_with_its_package(
    emitting: Callable[..., Scene], monkeypatch: pytest.MonkeyPatch, target: str, package: str
) -> None:
    monkeypatch.setenv("PATH", "/nowhere")
    with pytest.raises(UserError, match=f"apt-get install {package}"):
        measure(emitting("thesis10"), target)


def test_inputs_swing_within_the_box(emitting: Callable[..., Scene]) -> None:
    assert swing(emitting("arm10"), "hub_torque") == (-20.0, 20.0)
    assert swing(emitting("arm10", box=None), "hub_torque") == (-1.0, 1.0)
