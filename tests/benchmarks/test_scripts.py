"""Every script of benchmarks/ starts, and needs no word to: `make bench` runs them one after another."""

from __future__ import annotations

import re
import runpy
import sys
from pathlib import Path

import pytest

SCRIPTS = sorted((Path(__file__).parents[2] / "benchmarks").glob("*.py"))


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda path: path.stem)
def test_says_what_it_takes(
    script: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "argv", [str(script), "--help"])
    with pytest.raises(SystemExit) as ended:
        runpy.run_path(str(script), run_name="__main__")
    assert ended.value.code == 0
    usage = capsys.readouterr().out.partition("\n\n")[0]
    while "[" in usage:
        usage = re.sub(r"\[[^][]*\]", "", usage)
    assert usage.split() == ["usage:", script.name]
