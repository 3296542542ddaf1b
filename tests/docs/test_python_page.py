"""The page on Python runs from top to bottom, and prints what it says."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import tmm_gen as tg

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "python.md").read_text()
SNIPPETS = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
PRINTED = re.findall(r"```text\n(.*?)```", PAGE, re.DOTALL)


def test_it_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "scenes").symlink_to(ROOT / "scenes")
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    for snippet in SNIPPETS:
        exec(snippet, names)
    out = capsys.readouterr().out
    assert len(PRINTED) == 2
    for text in PRINTED:
        assert text in out
    assert "(101,) (101, 2) (101,)" in out
    assert (tmp_path / "swing.png").read_bytes().startswith(b"\x89PNG")
    assert tg.load("crane.toml") == names["crane"]
    assert (tmp_path / "generated" / "crane" / "c" / "crane.c").is_file()


def test_its_table_names_what_is_there() -> None:
    for call in re.findall(r"`arm\.(\w+)\(", PAGE):
        assert callable(getattr(tg.Arm, call))
    for name in re.findall(r"\btg\.(\w+)", PAGE):
        assert name in tg.__all__
