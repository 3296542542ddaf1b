"""The tutorial is followed: every command works, and its Python and its C print the same place of the payload."""

from __future__ import annotations

import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from tmm_gen.cli import main

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "tutorial.md"


def blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```$", PAGE.read_text(), re.M | re.S)


def test_following_the_tutorial_gives_one_answer_in_python_and_c(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    commands = [line[2:] for block in blocks("console") for line in block.splitlines() if line[:2] == "$ "]
    *steps, compiling, last = map(shlex.split, commands)
    monkeypatch.chdir(tmp_path)
    assert [step[:2] for step in steps] == [["tmm-gen", c] for c in ("new", "run", "modes", "check", "build")]
    for step in steps:
        assert main(step[1:]) == 0
    assert {"crane.png", "crane.csv"} <= {path.name for path in tmp_path.iterdir()}
    (script,), (source,) = blocks("python"), blocks("c")
    (tmp_path / "main.c").write_text(source)
    subprocess.run(compiling, check=True)
    from_c = numbers(last)
    assert from_c == pytest.approx(numbers([sys.executable, "-c", script]), abs=2e-9)
    assert from_c[1] > 0.1, "the torque lifts the payload"


def numbers(command: list[str]) -> list[float]:
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return [float(number) for number in done.stdout.split()]
