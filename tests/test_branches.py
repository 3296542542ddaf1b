"""Outside of scenes hardly anything asks for the kind of a model or base, or for an output by its name.

What a scene means by its words is said once: `scene/quantity.py` for outputs, `Model` and `Scene` for what follows from
the kinds, `row/` for the elements.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from tmm_gen.scene.quantity import CHAIN, PLANAR, SPATIAL

PACKAGE = Path(__file__).resolve().parents[1] / "src" / "tmm_gen"

WORDS = {"chain", "planar", "spatial", "clamp", "motor", "prescribed", *CHAIN, *PLANAR, *SPATIAL}
ASKED = {"kind", "of"}


def _asks(node: ast.AST) -> bool:
    """Return whether an expression is a model's or base's kind, or an output's name."""
    if isinstance(node, ast.Attribute) and node.attr == "kind":
        return isinstance(node.value, ast.Attribute | ast.Name) and ast.unparse(node.value).split(".")[
            -1
        ] in (*("model", "base", "scene", "arm"),)
    if isinstance(node, ast.Attribute):
        return node.attr == "of" and ast.unparse(node.value) in ("output", "item", "o", "read", "self.read")
    return isinstance(node, ast.Name) and node.id in ASKED


def _named(node: ast.AST) -> bool:
    return any(isinstance(n, ast.Constant) and n.value in WORDS for n in ast.walk(node))


def _branches(tree: ast.AST) -> Iterator[int]:
    """Yield the lines that compare a kind or a name, look it up in a table written there, or match on it."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Compare):
            sides = [node.left, *node.comparators]
            # a plain name may be anything; that it is compared with a word of a scene tells
            told = any(_asks(s) and isinstance(s, ast.Attribute) for s in sides) or any(
                _named(s) for s in sides
            )
            if told and any(_asks(side) for side in sides):
                yield node.lineno
            continue
        looked_up = node.slice if isinstance(node, ast.Subscript) else None
        looked_up = node.subject if isinstance(node, ast.Match) else looked_up
        if looked_up is not None and not isinstance(looked_up, ast.Name) and _asks(looked_up):
            yield node.lineno


@cache
def trees() -> dict[Path, ast.Module]:
    """Return what is outside of scenes, read."""
    return {
        path.relative_to(PACKAGE): ast.parse(path.read_text())
        for path in sorted(PACKAGE.rglob("*.py"))
        if path.relative_to(PACKAGE).parts[0] != "scene"
    }


@cache
def found() -> list[tuple[Path, int]]:
    """Return the places that branch."""
    return [(path, line) for path, tree in trees().items() for line in sorted(set(_branches(tree)))]


def test_few_places_branch_on_a_kind_or_a_name() -> None:
    assert len(found()) < 10, found()


def test_questions_about_the_equations_do_not_multiply() -> None:
    """Whether equations are linear, or an arm has a shape, follows from the kind: it is asked where that is the reason.

    Such are whether errors are known exactly, whether sweeps iterate, whether there is a picture to draw.
    """
    asked = [
        (path, node.lineno)
        for path, tree in trees().items()
        for node in ast.walk(tree)
        if isinstance(node, ast.Attribute) and node.attr in ("linear", "in_plane")
        if ast.unparse(node.value).endswith(".model")
    ]
    assert len(asked) <= 37, asked


def test_each_says_why() -> None:
    for path, line in found():
        lines = (PACKAGE / path).read_text().splitlines()
        assert "#" in lines[line - 1] or lines[line - 2].lstrip().startswith("#"), f"{path}:{line}"


def test_the_search_finds_what_it_is_for() -> None:
    branching = (
        'scene.model.kind == "chain"',
        'scene.base.kind != "motor"',
        'arm.scene.base.kind in ("clamp", "prescribed")',
        'kind == "planar"',
        'output.of == "torque"',
        'o.of in ("torque", "force")',
        'of == "angle"',
        "TABLE[scene.model.kind]",
        "TABLE[output.of]",
    )
    for text in branching:
        assert list(_branches(ast.parse(text))) == [1], text
    assert not list(_branches(ast.parse('p.kind == "q"\nvalue.of(1) == 2\nnode.value.kind in KINDS')))
