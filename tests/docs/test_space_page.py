"""The page on arms in space: its commands run as printed."""

from __future__ import annotations

import re
import shlex
import shutil
from pathlib import Path

import pytest

from tmm_gen.cli import main

pytestmark = pytest.mark.compiler

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "space.md").read_text()
COMMANDS = re.findall(r"^\$ tmm-gen (.*)$", PAGE, re.MULTILINE)


def test_commands(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    shutil.copytree(ROOT / "examples" / "space", tmp_path / "examples" / "space")
    monkeypatch.chdir(tmp_path)
    assert [command.split()[0] for command in COMMANDS] == ["build", "run"]
    for command in COMMANDS:
        assert main(shlex.split(command)) == 0
    assert "accurate to about" in capsys.readouterr().out
    assert list((tmp_path / "out" / "space" / "yaw3" / "c").glob("*.c"))
