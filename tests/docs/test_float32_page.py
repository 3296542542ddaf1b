"""The page on single precision speaks of every committed scene, and so does the benchmark behind it."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest

from tmm_gen.cli import main

ROOT = Path(__file__).resolve().parents[2]
SCENES = {path.stem for path in (ROOT / "scenes").glob("*.toml")}


def test_every_scene_has_a_row() -> None:
    page = (ROOT / "docs" / "float32.md").read_text()
    assert set(re.findall(r"^\| `(\w+)`,", page, re.M)) == SCENES


def test_every_scene_is_measured() -> None:
    text = (ROOT / "benchmarks" / "float32_scenes.py").read_text()
    assert set(re.findall(r'^    "(\w+)": \(', text, re.M)) == SCENES


def test_the_command_works(need_tool: Callable[[str, str], str], monkeypatch: pytest.MonkeyPatch) -> None:
    need_tool("arm-none-eabi-gcc", "gcc-arm-none-eabi")
    need_tool("qemu-system-arm", "qemu-system-arm")
    page = (ROOT / "docs" / "float32.md").read_text()
    (command,) = re.findall(r"^\$ tmm-gen (.*)$", page, re.M)
    monkeypatch.chdir(ROOT)
    assert main(command.split()) == 0
