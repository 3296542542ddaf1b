"""The page on arms by parts: its example builds, its commands draw what it shows, its figures are there."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest

from tmm_gen.cli import main
from tmm_gen.program.build import build_program
from tmm_gen.scene import parse_scene

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "arms.md").read_text()
COMMANDS = [
    line.removeprefix("$ tmm-gen ")
    for block in re.findall(r"```console\n(.*?)```", PAGE, re.DOTALL)
    for line in block.splitlines()
    if line.startswith("$ tmm-gen run")
]


@pytest.mark.parametrize("command", COMMANDS)
def test_commands(
    command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(ROOT)
    words = shlex.split(command)
    picture = words.index("--plot") + 1
    words[picture] = str(tmp_path / words[picture])
    assert main(words) == 0
    assert Path(words[picture]).is_file()
    assert "accurate to about" in capsys.readouterr().out


def test_there_are_commands_and_figures() -> None:
    assert len(COMMANDS) >= 2
    for figure in re.findall(r"\]\((figures/\S+)\)", PAGE):
        assert (ROOT / "docs" / figure).is_file()


def test_the_example_builds() -> None:
    (text,) = re.findall(r"```toml\n(name = .*?)```", PAGE, re.DOTALL)
    assert build_program(parse_scene(text)).stations > 1
