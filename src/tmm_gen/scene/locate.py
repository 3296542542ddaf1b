"""Lines of the keys and values of a TOML document.

The parser of the standard library reports no positions (CPython issue 115516), nor does tomlkit (its issue
55). This scanner walks a text which ``tomllib`` has already accepted and only notes where things stand; it
judges nothing.
"""

from __future__ import annotations

import re
import tomllib
from bisect import bisect_right

from tmm_gen.scene.problem import Path

_BLANK = re.compile(r"(?:[ \t\n]|#[^\n]*)*")
_SPACE = re.compile(r"[ \t]*")
_BARE_KEY = re.compile(r"[A-Za-z0-9_-]+")
_BARE_VALUE = re.compile(r"[^,\]}#\n]+")
_STRING = re.compile(
    r'"""(?:[^"\\]|\\[\s\S]|"{1,2}(?!"))*"{3,5}'
    r"|'''(?:[^']|'{1,2}(?!'))*'{3,5}"
    r'|"(?:[^"\\\n]|\\.)*"'
    r"|'[^'\n]*'"
)


def locate(text: str) -> dict[Path, int]:
    """Map every table, key and value of a valid TOML document to its line.

    Parameters
    ----------
    text : str
        A document which ``tomllib.loads`` accepts.

    Returns
    -------
    dict from path to int
        Lines from 1. Positions in arrays, arrays of tables included, count from 0. A table made only by the
        dotted keys below it has the line of the first of them. The document itself, ``()``, is on line 1.
    """
    return _Scanner(text.replace("\r\n", "\n")).scan()


def nearest_line(lines: dict[Path, int], path: Path) -> int:
    """Return the line of a path, or of the innermost table around it that stands in the file.

    Parameters
    ----------
    lines : dict from path to int
        As :func:`locate` returns them.
    path : tuple of str and int
        A path that need not exist, such as that of a missing key.

    Returns
    -------
    int
        Line from 1.
    """
    while path and path not in lines:
        path = path[:-1]
    return lines.get(path, 1)


class _Scanner:
    """One pass over one document."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.position = 0
        self.starts = [0, *(match.end() for match in re.finditer("\n", text))]
        self.lines: dict[Path, int] = {(): 1}
        self.counts: dict[Path, int] = {}

    def scan(self) -> dict[Path, int]:
        table: Path = ()
        while self._skip(_BLANK):
            if self.text.startswith("[", self.position):
                table = self._header()
            else:
                self._pair(table)
        return self.lines

    def _header(self) -> Path:
        """Read ``[a.b]`` or ``[[a.b]]`` and return the path of the table it opens."""
        line = self._line()
        brackets = 2 if self.text.startswith("[[", self.position) else 1
        self.position += brackets
        keys = self._keys()
        self.position += brackets
        parent: Path = ()
        for key in keys[:-1]:
            parent = self._newest((*parent, key))
            self.lines.setdefault(parent, line)
        path = (*parent, keys[-1])
        if brackets == 1:
            path = self._newest(path)
            self.lines[path] = line
            return path
        self.lines.setdefault(path, line)
        count = self.counts.get(path, 0)
        self.counts[path] = count + 1
        self.lines[(*path, count)] = line
        return (*path, count)

    def _newest(self, path: Path) -> Path:
        """Step into the last element where a path names an array of tables."""
        return (*path, self.counts[path] - 1) if path in self.counts else path

    def _pair(self, table: Path) -> None:
        """Read ``key = value``."""
        line = self._line()
        path = table
        for key in self._keys():
            path = (*path, key)
            self.lines.setdefault(path, line)
        self.position += 1  # the equals sign
        self._value(path)

    def _keys(self) -> list[str]:
        """Read a key, dotted or not, and the spaces after it."""
        keys: list[str] = []
        while True:
            self._skip(_SPACE)
            if quoted := _STRING.match(self.text, self.position):
                keys.append(tomllib.loads(f"key = {quoted[0]}")["key"])
                self.position = quoted.end()
            else:
                keys.append(self._take(_BARE_KEY))
            self._skip(_SPACE)
            if not self.text.startswith(".", self.position):
                return keys
            self.position += 1

    def _value(self, path: Path) -> None:
        """Read a value of any type, noting what is inside it."""
        self._skip(_BLANK)
        first = self.text[self.position]
        if first == "[":
            self._array(path)
        elif first == "{":
            self._inline_table(path)
        elif first in "\"'":
            self._take(_STRING)
        else:
            self._take(_BARE_VALUE)

    def _array(self, path: Path) -> None:
        self.position += 1
        index = 0
        while self._next_item("]"):
            self.lines[(*path, index)] = self._line()
            self._value((*path, index))
            index += 1

    def _inline_table(self, path: Path) -> None:
        self.position += 1
        while self._next_item("}"):
            self._pair(path)

    def _next_item(self, closing: str) -> bool:
        """Go to the next item of an array or inline table, or past its closing bracket and return False."""
        self._skip(_BLANK)
        if self.text.startswith(",", self.position):
            self.position += 1
            self._skip(_BLANK)
        if self.text.startswith(closing, self.position):
            self.position += 1
            return False
        return True

    def _line(self) -> int:
        return bisect_right(self.starts, self.position)

    def _skip(self, pattern: re.Pattern[str]) -> bool:
        """Pass what a pattern matches; return whether any text is left."""
        if match := pattern.match(self.text, self.position):
            self.position = match.end()
        return self.position < len(self.text)

    def _take(self, pattern: re.Pattern[str]) -> str:
        match = pattern.match(self.text, self.position)
        if match is None:
            raise ValueError(f"line {self._line()} is not valid TOML")
        self.position = match.end()
        return match[0]
