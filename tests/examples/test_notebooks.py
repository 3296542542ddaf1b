"""The notebooks run from top to bottom; they are stored without outputs.

Cells are executed here, in order, and what each ends with is shown as a notebook would: nbclient would do the same by
way of ipykernel and its sockets, a dozen packages that nothing else here needs.
"""

from __future__ import annotations

import ast
import json
from pathlib import Path
from typing import Any

import pytest

FOLDER = Path(__file__).resolve().parents[2] / "examples" / "notebooks"
SAID = {
    "from_scene_to_c": ("accurate to about ", "operations of a step: ", "C and Python differ by "),
    "how_many_links": ("<Modes of ruler: ", "to the power -2.0", "1 % takes ", " 8 links: off by "),
}
"""What is shown of each on the way."""


def cells(name: str) -> list[dict[str, Any]]:
    """Return the cells of a notebook."""
    found: list[dict[str, Any]] = json.loads((FOLDER / f"{name}.ipynb").read_text())["cells"]
    return found


def execute(source: str, names: dict[str, object], where: str) -> None:
    """Execute a cell; show its last line, where that is a value, as text and as a notebook does."""
    tree, last = ast.parse(source), None
    if isinstance(tree.body[-1], ast.Expr):
        last = ast.Expression(tree.body.pop().value)  # type: ignore[attr-defined]
    exec(compile(tree, where, "exec"), names)
    if last is not None and (value := eval(compile(last, where, "eval"), names)) is not None:
        print(repr(value))
        shown = getattr(value, "_repr_html_", None) or getattr(value, "_repr_png_", None)
        assert shown is None or shown()


def test_each_notebook_is_tried() -> None:
    assert {path.stem for path in FOLDER.glob("*.ipynb")} == set(SAID)


@pytest.mark.compiler
@pytest.mark.parametrize("name", SAID)
def test_it_runs(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    for number, cell in enumerate(cells(name), start=1):
        if cell["cell_type"] == "code":
            assert not cell["outputs"]
            assert cell["execution_count"] is None
            execute("".join(cell["source"]), names, f"{name}.ipynb, cell {number}")
    out = capsys.readouterr().out
    for words in SAID[name]:
        assert words in out


@pytest.mark.parametrize("name", SAID)
def test_its_links_lead_somewhere(name: str) -> None:
    text = "".join("".join(cell["source"]) for cell in cells(name) if cell["cell_type"] == "markdown")
    links = [part.partition(")")[0] for part in text.split("](")[1:]]
    assert links
    assert all((FOLDER / link).is_file() for link in links)
