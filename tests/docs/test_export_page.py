"""The pages on exporting and on firmware are run: what they tell a reader to type works as printed."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

pytestmark = pytest.mark.compiler

ROOT = Path(__file__).resolve().parents[2]
EXPORT = ROOT / "docs" / "export.md"
FIRMWARE = ROOT / "examples" / "firmware" / "README.md"


def commands(page: Path) -> list[str]:
    blocks = re.findall(r"```console\n(.*?)```", page.read_text(), re.DOTALL)
    return [line[2:] for block in blocks for line in block.splitlines() if line.startswith("$ ")]


@pytest.fixture(scope="module")
def checkout(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What the pages speak of, beside a folder to write into."""
    copy = tmp_path_factory.mktemp("checkout")
    for folder in ("scenes", "examples", "generated"):
        shutil.copytree(ROOT / folder, copy / folder, ignore=shutil.ignore_patterns("__pycache__"))
    return copy


@pytest.fixture(scope="module")
def run(
    checkout: Path, borrow_environment: Callable[[Path], Path], tmp_path_factory: pytest.TempPathFactory
) -> Callable[[list[str]], str]:
    """Run commands as a reader would, with `tmm-gen` on the path."""
    programs = borrow_environment(tmp_path_factory.mktemp("environment"))
    script = programs / "tmm-gen"
    script.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m tmm_gen "$@"\n')
    script.chmod(0o755)
    path = os.pathsep.join([str(programs), str(Path(sys.executable).parent), os.environ["PATH"]])
    environment = {**os.environ, "PATH": path, "VIRTUAL_ENV": str(Path(sys.executable).parents[1])}

    def call(lines: list[str]) -> str:
        done = subprocess.run(
            ["bash", "-euxo", "pipefail", "-c", "\n".join(lines)],
            cwd=checkout,
            env=environment,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    return call


def test_exports_and_the_python_that_reads_them(checkout: Path, run: Callable[[list[str]], str]) -> None:
    exports = [line for line in commands(EXPORT) if line.startswith("tmm-gen export")]
    assert len(exports) == 4
    assert run(exports).count("wrote ") == 4
    snippets = re.findall(r"```python\n(.*?)```", EXPORT.read_text(), re.DOTALL)
    assert len(snippets) == 2
    for snippet in snippets:
        done = subprocess.run(
            [sys.executable, "-c", snippet], cwd=checkout, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stderr
        numbers = [float(word) for word in re.findall(r"-?\d+\.\d+(?:e-?\d+)?", done.stdout)]
        assert len(numbers) >= 2
        assert 0.9 < (numbers[0] ** 2 + numbers[1] ** 2) ** 0.5 < 1.1  # a slightly bent arm of 1 m


def test_firmware(run: Callable[[list[str]], str], need_tool: Callable[[str, str], str]) -> None:
    need_tool("arm-none-eabi-gcc", "gcc-arm-none-eabi picolibc-arm-none-eabi")
    need_tool("qemu-system-arm", "qemu-system-arm")
    need_tool("cmake", "cmake")
    here = [line for line in commands(FIRMWARE) if not line.startswith("apt-get ")]
    there = [line for line in commands(EXPORT) if line.startswith("cmake ")]
    assert len(there) == 2
    assert there == here[:2]
    shown = run(here)
    assert "300 messages of 3000 samples" in shown
    assert "100% tests passed" in shown
    printed = re.search(r"```\n(300 messages.*?)```", FIRMWARE.read_text(), re.DOTALL)
    assert printed is not None
    assert printed[1] in shown
