"""The tutorial is followed: every command works, and its Python and its C print the same place of the payload."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "tutorial.md"


def blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```$", PAGE.read_text(), re.M | re.S)


def test_following_the_tutorial_gives_one_answer_in_python_and_c(tmp_path: Path) -> None:
    commands = [line[2:] for block in blocks("console") for line in block.splitlines() if line[:2] == "$ "]
    *steps, compiling, last = commands
    assert [shlex.split(step)[1] for step in steps] == ["new", "run", "modes", "check", "build"]
    python = tmp_path / "bin" / "tmm-gen"
    python.parent.mkdir()
    python.write_text(f'#!/bin/sh\nexec {shlex.quote(sys.executable)} -m tmm_gen "$@"\n')
    python.chmod(0o755)
    environment = {**os.environ, "PATH": f"{python.parent}:{os.environ['PATH']}", "PYTHONPATH": str(ROOT / "src")}

    def follow(*words: str) -> str:
        done = subprocess.run(
            words, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, f"{words}: {done.stderr}"
        return done.stdout

    for step in steps:
        follow("sh", "-c", step)
    assert {"crane.png", "crane.csv"} <= {path.name for path in tmp_path.iterdir()}
    (script,) = blocks("python")
    (source,) = blocks("c")
    (tmp_path / "main.c").write_text(source)
    follow("sh", "-c", compiling)
    from_c = [float(number) for number in follow("sh", "-c", last).split()]
    from_python = [float(number) for number in follow(sys.executable, "-c", script).split()]
    assert from_c == pytest.approx(from_python, abs=2e-9)
    # the torque has lifted it
    assert from_c[1] > 0.1
