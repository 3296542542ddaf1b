"""Long lines of C: statements broken before operators, comments filled."""

from __future__ import annotations

import textwrap

WIDTH = 110
INDENT = "    "
_LOOSENESS = {"||": 0, "+": 1, "-": 1, "*": 2, "/": 2}


def statement(text: str, depth: int) -> list[str]:
    """Write a statement at an indentation depth, in as many lines as it needs."""
    lines: list[str] = []
    head = INDENT * depth
    while len(head) + len(text) > WIDTH and (place := _break(text, WIDTH - len(head))) is not None:
        lines.append(head + text[:place].rstrip())
        text = text[place:]
        head = INDENT * (depth + 1)
    return [*lines, head + text]


def comment(text: str, depth: int, opening: str = "/*") -> list[str]:
    """Write a comment that stands on lines of its own; ``/**`` opens one for doxygen."""
    head = INDENT * depth
    return textwrap.wrap(
        f"{opening} {text} */",
        WIDTH,
        initial_indent=head,
        subsequent_indent=f"{head} * ",
        break_long_words=False,
        break_on_hyphens=False,
    )


def _break(text: str, width: int) -> int | None:
    """Return where to break: before the last of the loosest operators within the width, or behind a comma."""
    best: tuple[int, int] | None = None
    depth = 0
    for place, character in enumerate(text[: width + 1]):
        depth += (character in "([") - (character in ")]")
        operator = text[place : text.find(" ", place)]
        behind = text[place - 1 : place] == " " and (operator in _LOOSENESS or text[place - 2] == ",")
        if behind:
            looseness = len(_LOOSENESS) * depth + _LOOSENESS.get(operator, 0)
            if best is None or looseness <= best[0]:
                best = (looseness, place)
    return best[1] if best else None
