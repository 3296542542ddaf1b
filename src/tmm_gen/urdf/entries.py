"""Tables of a scene as text: keys, and above them in comments what was decided."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

_WIDTH = 110


@dataclass
class Entry:
    """A table.

    Parameters
    ----------
    header : str
        With its brackets; empty for what stands above all tables.
    keys : dict of str to str
        Values as TOML has them.
    decisions : list of str
        What a reader has to know, one line or more each.
    """

    header: str
    keys: dict[str, str] = field(default_factory=dict)
    decisions: list[str] = field(default_factory=list)

    def put(self, key: str, value: float | str | Sequence[float]) -> None:
        """Set a key to a number, a text or a list of numbers."""
        self.keys[key] = value_text(value)

    def text(self) -> str:
        """Return it as it stands in the file."""
        lines = [line for decision in self.decisions for line in comment(decision)]
        return "\n".join(
            [
                *lines,
                *([self.header] if self.header else []),
                *(f"{key} = {value}" for key, value in self.keys.items()),
            ]
        )


def value_text(value: float | str | Sequence[float]) -> str:
    """Write a value as TOML; numbers as they read back, and zero as 0."""
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    if isinstance(value, int | float):
        return "0" if value == 0.0 else repr(value)
    return "[" + ", ".join(value_text(float(part)) for part in value) + "]"


def comment(words: str) -> list[str]:
    """Return words as lines of a comment, without what would end a comment or cannot be shown."""
    plain = "".join(c if c.isprintable() else "?" for c in words)
    return textwrap.wrap(
        plain, _WIDTH, initial_indent="# ", subsequent_indent="#   ", break_long_words=False
    ) or ["#"]


def document(entries: Iterable[Entry]) -> str:
    """Return tables with an empty line between them."""
    return "\n\n".join(entry.text() for entry in entries) + "\n"
