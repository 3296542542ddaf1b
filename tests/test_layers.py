"""Data flows one way: a folder of the package imports only from folders below it, and no modules import in a circle."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parents[1] / "src" / "tmm_gen"

LAYERS = (
    {"backends", "csv_text", "errors", "resources", "style", "trusted", "units", "version"},
    {"extras", "reading", "scratch"},
    {"files"},
    {"scene"},
    {"inputs", "urdf"},
    {"reference", "derive"},
    {"row", "thesis"},
    {"digits"},
    {"program"},
    {"c_language"},
    {"emit"},
    {"package"},
    {"native", "target"},
    {"modal"},
    {"simulate", "explain"},
    {"stability", "verify", "study"},
    {"control", "export", "calibration"},
    {"onboard"},
    {"closed_loop"},
    {"report", "playground"},
    {"api"},
    {"cli"},
    {"__main__"},
)
"""From the ground up; what stands in one layer does not import from each other."""

WITHIN = {
    "control": (
        {"arm", "command", "condition"},
        {"task"},
        {"sensors", "goals"},
        {"prediction"},
        {"estimators", "quadratic", "plant"},
        {"bench"},
        {"laws", "predicted_swing", "acados", "acados_code", "do_mpc"},
        {"controllers"},
    )
}
"""The same within a folder; what stands in one layer here may import from each other."""

INDEPENDENT = {"reference": {"derive", "program", "emit", "native"}}
"""What must not be seen from where, directly or by way of others: a reference is a truth of its own."""


def _modules() -> dict[str, Path]:
    found = {}
    for path in PACKAGE.rglob("*.py"):
        parts = path.relative_to(PACKAGE).with_suffix("").parts
        found[".".join(p for p in ("tmm_gen", *parts) if p != "__init__")] = path
    return found


MODULES = _modules()


def _imports(path: Path) -> Iterator[str]:
    """Modules of the package that a file imports, inside of functions too; not those for type checkers alone."""
    open_nodes: list[ast.AST] = [ast.parse(path.read_text())]
    while open_nodes:
        node = open_nodes.pop()
        # an expression holds no import
        open_nodes.extend(n for n in ast.iter_child_nodes(node) if not isinstance(n, ast.expr))
        if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.dump(node.test):
            del open_nodes[-len(node.body) - len(node.orelse) :]
            open_nodes.extend(node.orelse)
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name.startswith("tmm_gen"))
        elif isinstance(node, ast.ImportFrom) and (node.module or "").startswith("tmm_gen"):
            for alias in node.names:
                inner = f"{node.module}.{alias.name}"
                yield inner if inner in MODULES else str(node.module)


@cache
def imports() -> Mapping[str, set[str]]:
    """Return what each module imports."""
    return {name: set(_imports(path)) - {"tmm_gen"} for name, path in MODULES.items() if name != "tmm_gen"}


def _folder(module: str) -> str:
    return module.split(".")[1]


RANK = {folder: rank for rank, layer in enumerate(LAYERS) for folder in layer}


def test_every_folder_has_a_place() -> None:
    assert {_folder(name) for name in imports()} == set(RANK)


@pytest.mark.parametrize("folder", sorted(RANK))
def test_no_arrow_upward(folder: str) -> None:
    upward = {
        f"{name} -> {other}"
        for name, others in imports().items()
        if _folder(name) == folder
        for other in others
        if _folder(other) != folder and RANK[_folder(other)] >= RANK[folder]
    }
    assert not upward


@pytest.mark.parametrize("folder", WITHIN)
def test_no_arrow_upward_within(folder: str) -> None:
    rank = {part: number for number, layer in enumerate(WITHIN[folder]) for part in layer}
    inside = {name: name.split(".")[2] for name in imports() if name.startswith(f"tmm_gen.{folder}.")}
    assert set(inside.values()) == set(rank)
    upward = {
        f"{name} -> {other}"
        for name, part in inside.items()
        for other in imports()[name] & set(inside)
        if rank[inside[other]] > rank[part]
    }
    assert not upward


def test_no_circles() -> None:
    try:
        TopologicalSorter(imports()).prepare()
    except CycleError as error:
        pytest.fail(" -> ".join(error.args[1]))


@pytest.mark.parametrize(("folder", "hidden"), INDEPENDENT.items())
def test_references_are_independent(folder: str, hidden: set[str]) -> None:
    seen: set[str] = set()
    reached = [name for name in imports() if _folder(name) == folder]
    while reached:
        name = reached.pop()
        if name not in seen:
            seen.add(name)
            reached.extend(imports()[name])
    assert not {name for name in seen if _folder(name) in hidden}
