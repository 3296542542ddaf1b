"""docs/architecture.md: files it names are there, and a test runs each of its recipes."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "architecture.md").read_text()
RECIPES = {part.partition("\n")[0]: part for part in PAGE.split("\n## ") if part.startswith("How to add")}


def test_there_is_a_recipe_for_what_one_may_want_to_add() -> None:
    assert set(RECIPES) == {
        f"How to add {what}"
        for what in ("an integrator", "an element", "an output", "a backend", "a command")
    }


@pytest.mark.parametrize("recipe", RECIPES)
def test_each_recipe_is_run_by_a_test(recipe: str) -> None:
    named = re.findall(r"`(tests/[\w/]+\.py)`", RECIPES[recipe])
    assert named
    for name in named:
        assert "def test_" in (ROOT / name).read_text()


def test_folders_in_its_table_are_there() -> None:
    package = ROOT / "src" / "tmm_gen"
    cells = re.findall(r"^\| (`.*?) \|", PAGE, flags=re.M)
    assert len(cells) > 15
    for cell in cells:
        first, *others = re.findall(r"`([\w/.]+)`", cell)
        folder = package / first if first.endswith("/") else (package / first).parent
        for name in (first, *others):
            assert (package / name).exists() or (folder / name).exists(), name


def test_no_folder_is_left_out() -> None:
    folders = {path.name for path in (ROOT / "src" / "tmm_gen").iterdir() if (path / "__init__.py").exists()}
    assert {name for name in folders if f"`{name}/" not in PAGE} == set()
