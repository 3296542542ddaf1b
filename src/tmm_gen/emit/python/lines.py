"""Python text in lines of at most 110 characters, broken where formatters (Black, Ruff) break it."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterable, Sequence

WIDTH = 110
_INDENT = "    "


def text(lines: Iterable[str]) -> str:
    """Put lines together."""
    return "\n".join(lines)


def assignment(target: str, value: str, indent: str = "") -> list[str]:
    """Write ``target = value``.

    Parameters
    ----------
    target, value : str
        Value is an expression whose binary operators stand between spaces.
    indent : str
        Before every line.
    """
    if value.startswith("(") and _closing(value, 0) == len(value) - 1:
        value = value[1:-1]
    return _bracketed(f"{indent}{target} = ", value, indent)


def call(head: str, arguments: Sequence[str], indent: str = "", tail: str = "") -> list[str]:
    """Write ``head(argument, ...)tail``, one argument a line where they do not fit in one."""
    single = f"{indent}{head}({', '.join(arguments)}){tail}"
    if len(single) <= WIDTH:
        return [single]
    inner = f"{indent}{_INDENT}{', '.join(arguments)}"
    if len(inner) <= WIDTH:
        return [f"{indent}{head}(", inner, f"{indent}){tail}"]
    lines: list[str] = []
    for item in arguments:
        lines += (_literals if item.startswith('"') else _operands)(item, indent + _INDENT)
        if len(arguments) > 1 or not _split(item)[1]:
            lines[-1] += ","
    return [f"{indent}{head}(", *lines, f"{indent}){tail}"]


def listing(head: str, items: Sequence[str], indent: str = "", tail: str = "") -> list[str]:
    """Write a tuple after a head, one item a line where they do not fit in one."""
    single = f"{indent}{head}({', '.join(items)}{',' if len(items) == 1 else ''}){tail}"
    if len(single) <= WIDTH:
        return [single]
    return [f"{indent}{head}(", *(f"{indent}{_INDENT}{item}," for item in items), f"{indent}){tail}"]


def comment(text: str, indent: str = "") -> list[str]:
    """Write a comment."""
    return _filled(text, f"{indent}# ", f"{indent}# ")


def comments(texts: Iterable[str]) -> list[str]:
    """Write a block of comments, one for each text, further lines hanging in; empty where texts are empty."""
    return [line for text in texts for line in (_filled(text, "# ", f"# {_INDENT}") or ["#"])]


def prose(text: str, indent: str = "", hanging: str = "") -> list[str]:
    """Write a paragraph of a docstring; all lines but the first hang in by ``hanging`` more."""
    return _filled(text, indent, indent + hanging)


def _filled(text: str, first: str, others: str) -> list[str]:
    return textwrap.wrap(
        text,
        WIDTH,
        initial_indent=first,
        subsequent_indent=others,
        break_long_words=False,
        break_on_hyphens=False,
    )


def _literals(quoted: str, indent: str) -> list[str]:
    """Write a string as several that stand one below the other, broken at blanks, where it does not fit in a line."""
    words = re.findall(r"[^ ]+ ?", quoted[1:-1])
    lines = [words[0]]
    for word in words[1:]:
        if len(indent) + len(lines[-1]) + len(word) + len('"",') > WIDTH:
            lines.append(word)
        else:
            lines[-1] += word
    return [f'{indent}"{line}"' for line in lines]


def _bracketed(head: str, value: str, indent: str) -> list[str]:
    """Write a value after a head; in brackets if it needs several lines."""
    if len(head) + len(value) <= WIDTH:
        return [head + value]
    _, operators = _split(value)
    if not operators:
        return _broken_at_own_brackets(head, value, indent)
    if len(operators) == 1 and (value.endswith(")") or re.match(r"[A-Za-z_.]*\(", value)):
        lines = _broken_at_own_brackets(head, value, indent)
        if all(len(line) <= WIDTH for line in lines):
            return lines
    return [f"{head}(", *_operands(value, indent + _INDENT), f"{indent})"]


def _broken_at_own_brackets(head: str, value: str, indent: str) -> list[str]:
    """Write an expression that breaks inside those of its own brackets that do not fit."""
    lines: list[str] = []
    line, rest = head, value
    while opening := re.search(r"[(\[]", rest):
        start, stop = opening.end(), _closing(rest, opening.start())
        line += rest[:start]
        following = re.match(r"[^(\[]*[(\[]?", rest[stop:])
        reach = len(line) + stop - start + (len(following[0]) if following else 0)
        if reach <= WIDTH:
            line += rest[start : stop + 1]
        else:
            lines += [line, *_operands(rest[start:stop], indent + _INDENT)]
            line = indent + rest[stop]
        rest = rest[stop + 1 :]
    return [*lines, line + rest]


def _operands(value: str, indent: str) -> list[str]:
    """Write an expression that already stands in brackets."""
    if len(indent) + len(value) <= WIDTH:
        return [indent + value]
    operands, operators = _split(value)
    if not operators:
        return _broken_at_own_brackets(indent, value, indent)
    lines: list[str] = []
    for operator, operand in zip(["", *(f"{o} " for o in operators)], operands, strict=True):
        lines += _operand(operator, operand, indent)
    return lines


def _operand(operator: str, operand: str, indent: str) -> list[str]:
    """Write one operand of a broken expression, itself broken where it is too long."""
    if len(indent) + len(operator) + len(operand) <= WIDTH:
        return [indent + operator + operand]
    if operand.startswith("(") and operand.endswith(")") and not _split(operand)[1]:
        return [f"{indent}{operator}(", *_operands(operand[1:-1], indent + _INDENT), f"{indent})"]
    parts, operators = _split(operand)
    if not operators:
        return _broken_at_own_brackets(indent + operator, operand, indent)
    lines = _operand(operator, parts[0], indent)
    for inner, part in zip(operators, parts[1:], strict=True):
        lines += _operand(f"{inner} ", part, indent)
    return lines


def _split(value: str) -> tuple[list[str], list[str]]:
    """Split an expression at its loosest operators outside brackets."""
    for level in (("+", "-"), ("*", "/")):
        operands, operators, depth, start = [], [], 0, 0
        for place, character in enumerate(value):
            depth += (character in "([") - (character in ")]")
            if depth == 0 and character in level and value[place - 1 : place + 2] == f" {character} ":
                operands.append(value[start : place - 1])
                operators.append(character)
                start = place + 2
        if operators:
            return [*operands, value[start:]], operators
    return [value], []


def _closing(value: str, opening: int) -> int:
    """Return where the bracket closes that opens at a place."""
    depth = 0
    for place in range(opening, len(value)):
        depth += (value[place] in "([") - (value[place] in ")]")
        if depth == 0:
            return place
    raise ValueError(f"brackets do not match: {value}")
