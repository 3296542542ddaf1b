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
    told = ["build", "run", "rest", "modes", "frequency", "stability"]
    assert [command.split()[0] for command in COMMANDS] == told
    for command in COMMANDS:
        assert main(shlex.split(command)) == 0
    shown = capsys.readouterr().out
    for words in (
        "accurate to about",
        "4 equilibria",
        "forearm bends about z",
        "resonance (Hz)",
        "largest stable step",
    ):
        assert words in " ".join(shown.split())
    for picture in ("modes", "frequency"):
        assert (tmp_path / f"yaw3-{picture}.png").stat().st_size > 10_000
    for figure in re.findall(r"\]\((figures/\S+)\)", PAGE):
        assert (ROOT / "docs" / figure).is_file()
    assert list((tmp_path / "out" / "space" / "yaw3" / "c").glob("*.c"))
