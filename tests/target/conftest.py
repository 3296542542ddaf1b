"""Scenes on boards, measured once for all tests of a session, and the tools they need."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest

from tmm_gen.scene import Scene, load_scene
from tmm_gen.target import BOARDS, Measurement, measure

SCENES = Path(__file__).resolve().parents[2] / "scenes"
TOOLS = {
    "cortex-m4f": (("arm-none-eabi-gcc", "gcc-arm-none-eabi"), ("qemu-system-arm", "qemu-system-arm")),
    "cortex-m7": (("arm-none-eabi-gcc", "gcc-arm-none-eabi"), ("qemu-system-arm", "qemu-system-arm")),
    "rv32imafdc": (
        ("riscv64-unknown-elf-gcc", "gcc-riscv64-unknown-elf"),
        ("qemu-system-riscv32", "qemu-system-misc"),
    ),
}


@cache
def scene_with(name: str, **changes: object) -> Scene:
    """Return a scene with keys of ``[emit]`` changed."""
    return load_scene(SCENES / f"{name}.toml").replace(
        **{f"emit.{key}": value for key, value in changes.items()}
    )


@cache
def _measured(target: str, name: str, **changes: object) -> Measurement:
    return measure(scene_with(name, **changes), target)


@pytest.fixture(scope="session")
def emitting() -> Callable[..., Scene]:
    """Make a scene: ``emitting("arm10", real="float32")``."""
    return scene_with


@pytest.fixture(scope="session")
def measured(need_tool: Callable[[str, str], str]) -> Callable[..., Measurement]:
    """Measure a scene on a board: ``measured("cortex-m4f", "arm10", real="float32")``."""

    def call(target: str, name: str, **changes: object) -> Measurement:
        assert target in BOARDS
        for program, package in TOOLS[target]:
            need_tool(program, package)
        return _measured(target, name, **changes)

    return call
