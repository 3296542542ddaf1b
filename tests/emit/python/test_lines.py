"""Lines of Python: short enough, and broken just where formatters break them."""

from __future__ import annotations

import ast
import random
import subprocess
import sys
from pathlib import Path

import pytest
import sympy as sp

from tmm_gen.emit.expressions import element
from tmm_gen.emit.python.lines import WIDTH, assignment, call, comments, listing, prose, text
from tmm_gen.emit.python.printer import PythonPrinter
from tmm_gen.program.variables import Ref, Role, Variable

NAMES = [
    "x",
    "angle",
    "hub_acceleration",
    "step2_25_over_54",
    "an_input_whose_name_has_the_most_characters_allow",
]


def leaf(draw: random.Random) -> sp.Expr:
    if draw.random() < 0.2:
        return sp.Rational(draw.randint(1, 9), draw.randint(1, 9))
    name = draw.choice(NAMES)
    if draw.random() < 0.5:
        return Variable(name, Role.WORK, 9).at(draw.choice([0, 1, -1]))
    return Variable(f"{name}_", Role.LOCAL).ref


def expression(draw: random.Random, depth: int) -> sp.Expr:
    if depth == 0:
        return leaf(draw)
    kind = draw.random()
    if kind < 0.45:
        parts = [draw.choice([1, -1]) * expression(draw, depth - 1) for _ in range(draw.randint(2, 4))]
        return sp.Add(*parts)
    if kind < 0.85:
        return sp.Mul(*[expression(draw, depth - 1) for _ in range(draw.randint(2, 3))])
    return sp.sin(expression(draw, depth - 1)) if kind < 0.92 else 1 / expression(draw, depth - 1)


def refer(ref: Ref) -> str:
    return element(ref.variable.name, ref)


def ruff(*words: str | Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "ruff", *map(str, words), "--line-length", str(WIDTH), "--isolated"]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.mark.style
def test_assignments_are_broken_where_a_formatter_breaks_them(tmp_path: Path) -> None:
    draw = random.Random(7)
    printer = PythonPrinter(refer, "np")
    blocks, broken = ["import numpy as np"], 0
    for index in range(400):
        value = printer.text(expression(draw, draw.randint(1, 4)))
        target = draw.choice(["y", "correction[j]", "known_angle[1:]"])
        lines = assignment(target, value, "    ")
        (made,) = ast.parse(text(["if True:", *lines])).body[0].body  # type: ignore[attr-defined]
        assert ast.dump(made.value) == ast.dump(ast.parse(value, mode="eval").body)
        broken += len(lines) > 1
        blocks.append(text([f"def f{index}():", *lines]))
    assert broken > 100
    path = tmp_path / "lines.py"
    path.write_text("\n\n\n".join(blocks) + "\n")
    done = ruff("format", "--diff", path)
    assert done.returncode == 0, done.stdout


@pytest.mark.style
def test_calls_and_tuples_are_broken_where_a_formatter_breaks_them(tmp_path: Path) -> None:
    lines = []
    for count in range(1, 26):
        items = [f"item_{k}=value_{k}" for k in range(count)]
        lines += [
            *call("made = Model", items),
            *listing("values = ", [item.partition("=")[2] for item in items]),
        ]
    path = tmp_path / "lines.py"
    path.write_text(text(lines) + "\n")
    done = ruff("format", "--diff", path)
    assert done.returncode == 0, done.stdout
    assert max(map(len, lines)) <= WIDTH


def test_a_tuple_of_one_keeps_its_comma() -> None:
    assert listing("x = ", ["a"]) == ["x = (a,)"]
    assert listing("x = ", []) == ["x = ()"]
    assert call("f", ["a"]) == ["f(a)"]


def test_outer_brackets_are_dropped() -> None:
    assert assignment("x", "(1.0 / 3.0)") == ["x = 1.0 / 3.0"]
    assert assignment("x", "(a + b) * (c + d)") == ["x = (a + b) * (c + d)"]


@pytest.mark.parametrize("words", [3, 40])
def test_texts_are_filled(words: int) -> None:
    told = " ".join(["word"] * words)
    first, *others = comments([told, told])[: len(comments([told]))]
    assert first.startswith("# word")
    assert all(line.startswith("#     word") for line in others)
    assert all(len(line) <= WIDTH for line in (first, *others))
    assert " ".join(line.strip() for line in prose(told, "    ")) == told
    assert comments(["", "a"]) == ["#", "# a"]
