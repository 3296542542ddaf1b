"""What tests of emission share: comparison with texts that somebody has read and kept."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest

GOLDEN = Path(__file__).parent / "golden"


@pytest.fixture
def compare_or_update() -> Callable[[str, Mapping[str, str]], None]:
    """Compare texts with those kept under a name; with UPDATE_GOLDEN=1 keep them instead.

    Kept files carry the suffix ``.golden``, so that no tool takes them for code.
    """

    def compare(name: str, texts: Mapping[str, str]) -> None:
        folder = GOLDEN / name
        wanted = {f"{path}.golden": text for path, text in texts.items()}
        held = {path.relative_to(folder).as_posix(): path for path in folder.rglob("*.golden")}
        if os.environ.get("UPDATE_GOLDEN") == "1":
            for path in held.values():
                path.unlink()
            for path, text in wanted.items():
                (folder / path).parent.mkdir(parents=True, exist_ok=True)
                (folder / path).write_text(text, encoding="utf-8")
            return
        remedy = "read the difference; if it is meant, run again with UPDATE_GOLDEN=1"
        assert set(held) == set(wanted), remedy
        for path, text in wanted.items():
            assert held[path].read_text(encoding="utf-8") == text, f"{path}: {remedy}"

    return compare
