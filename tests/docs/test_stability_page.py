"""The commands of the pages on stability and on what a scene requires work and say what the pages say."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest

from tmm_gen.cli import main

ROOT = Path(__file__).resolve().parents[2]


def commands(page: str) -> list[list[str]]:
    """Return the words behind ``$ tmm-gen`` in a page's console blocks."""
    text = (ROOT / "docs" / page).read_text()
    blocks = re.findall(r"```console\n(.*?)```", text, re.DOTALL)
    return [shlex.split(line)[2:] for block in blocks for line in block.splitlines() if line.startswith("$ ")]


def test_stability(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    plain, frozen = commands("stability.md")
    assert main(plain) == 0
    out = capsys.readouterr().out
    assert "4.88 x" in out
    assert "21.5 x" in out
    assert "the newmark kernel grows as derived" in out
    assert main(frozen) == 1
    assert "DIFFERS from the derived growth" in capsys.readouterr().out


def test_explain(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    plain, in_space = commands("explain.md")
    assert main(plain) == 0
    out = capsys.readouterr().out
    for figure in ("220 operations a step", "+144", "+69", "-256", "366 operations a step"):
        assert figure in out
    assert in_space == [
        "explain",
        "examples/space/yaw3.toml",
    ]  # tests/explain/test_space.py adds all of it up


def test_scripts_that_pages_name_exist() -> None:
    for page in ("stability.md", "explain.md", "headline.md"):
        for script in re.findall(r"python (benchmarks/\w+\.py)", (ROOT / "docs" / page).read_text()):
            assert (ROOT / script).is_file()
