"""Kernels called with anything never say OK to what is not finite, a sample of `benchmarks/fuzz_kernels.py`."""

from __future__ import annotations

import importlib.util
import re
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from tmm_gen.scene import load_scene

pytestmark = pytest.mark.compiler


@pytest.fixture(scope="module")
def fuzzer(repository: Path) -> ModuleType:
    path = repository / "benchmarks" / "fuzz_kernels.py"
    spec = importlib.util.spec_from_file_location("fuzz_kernels", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["fuzz_kernels"] = module
    spec.loader.exec_module(module)
    return module


KINDS: list[tuple[str, dict[str, Any]]] = [
    ("drivetrain", {"integrator": {"name": "houbolt", "step": 0.001}, "emit.real": "float32"}),
    ("arm2", {"emit.real": "float32", "emit.compensated": True, "emit.trigonometry": "own"}),
    ("thesis10", {"emit.parameters": "bound"}),
    ("arm2", {"integrator": {"name": "sdirk4", "step": 0.001}}),
]


@pytest.mark.parametrize(("stem", "changes"), KINDS)
def test_ok_means_finite(stem: str, changes: dict[str, Any], fuzzer: ModuleType, repository: Path) -> None:
    found = fuzzer.fuzz(load_scene(repository / "scenes" / f"{stem}.toml").replace(**changes), 4000)
    assert found.faults == 0
    assert found.fine > 800  # most of what was tried is a motion


def test_the_fuzzer_sees_what_a_kernel_without_checks_lets_through(
    fuzzer: ModuleType, repository: Path
) -> None:
    def unchecked(text: str) -> str:
        return re.sub(r"if \(!isfinite\([^;{]*total[^;{]*\)\) \{", "if (0) {", text)

    found = fuzzer.fuzz(load_scene(repository / "scenes" / "drivetrain.toml"), 4000, edit=unchecked)
    assert found.step > 0
    assert found.initialise > 0
