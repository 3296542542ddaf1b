"""Lines of C that fit."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from tmm_gen.c_language.wrap import WIDTH, comment, statement

names = st.from_regex(r"[a-z]{1,20}(\[j( \+ 1)?\])?", fullmatch=True)
expressions = st.recursive(
    names,
    lambda inner: (
        st.builds(lambda a, op, b: f"{a} {op} {b}", inner, st.sampled_from("+-*"), inner)
        | inner.map(lambda e: f"({e})")
    ),
    max_leaves=30,
)


@given(expressions, st.integers(1, 3))
def test_statements_only_gain_line_breaks(value: str, depth: int) -> None:
    text = f"result = {value};"
    lines = statement(text, depth)
    assert " ".join(line.strip() for line in lines) == text
    assert all(len(line) <= WIDTH for line in lines)
    assert lines[0].startswith(" " * 4 * depth + "result")
    assert all(line.startswith(" " * 4 * (depth + 1)) for line in lines[1:])


def test_statements_break_at_the_loosest_operator() -> None:
    factor = "f" * 30
    lines = statement(f"x = {factor} * (a + b) + {factor} * (c + d) + {factor} * (e + f);", 1)
    assert lines == [
        f"    x = {factor} * (a + b) + {factor} * (c + d)",
        f"        + {factor} * (e + f);",
    ]


def test_signs_are_not_operators() -> None:
    (line,) = statement("x = -a * -b;", 1)
    assert line == "    x = -a * -b;"


@given(st.lists(st.from_regex(r"[a-z]{1,12}", fullmatch=True), min_size=1, max_size=60))
def test_comments(words: list[str]) -> None:
    lines = comment(" ".join(words), 1)
    assert all(len(line) <= WIDTH for line in lines)
    assert lines[0].startswith("    /* ")
    assert lines[-1].endswith(" */")
    assert all(line.startswith("     * ") for line in lines[1:])
