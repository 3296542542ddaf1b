"""Explaining where a text is not TOML."""

from __future__ import annotations

import re

from tmm_gen.scene.problem import Problem

_AT = re.compile(r" \(at (?:line (\d+), column (\d+)|end of document)\)$")
_ENDLESS = re.compile(r"\d{4300,}")
_KEY = re.compile(r"\s*([^=\s\[\]#][^=#]*?)\s*=\s*(.*?)\s*$")
_HEADER = re.compile(r"\s*\[\[?\s*([^\]]*?)\s*\]")

_FORM = (
    "Write one `key = value` per line: a number, text in double quotes, true, false or a list in brackets."
)
_REMEDIES = (
    ("Cannot overwrite", "Give each key once in its table."),
    ("Cannot declare", "Write each [table] once, or [[table]] for several of one kind."),
    ("Cannot mutate", "Write each table once, in one place."),
    ("Duplicate inline table key", "Give each key once in its table."),
    ("Illegal character", "Close the quotes on the same line, or escape the character."),
    ("Unterminated string", "Close the quotes."),
    ("Unclosed array", "Close the bracket, and separate items by commas."),
    ("Unclosed inline table", "Close the brace, and separate keys by commas."),
    ("Unescaped '\\'", "Double the backslash, or use single quotes."),
    ("Expected '='", "Write `key = value`."),
    ("Expected ']", "Close the table's brackets: [table] or [[table]]."),
    ("Invalid statement", "Write `key = value` or a [table]; comments start with #."),
    ("Invalid initial character for a key part", "Write `key = value`; keys are letters and digits."),
    ("number of", "Write a shorter number."),
)


def syntax_problem(text: str, origin: str, error: ValueError) -> Problem:
    """Turn an error of ``tomllib`` into a located problem.

    Parameters
    ----------
    text : str
        The text which was refused.
    origin : str
        Name of the file.
    error : ValueError
        What ``tomllib.loads`` raised, usually ``tomllib.TOMLDecodeError``.

    Returns
    -------
    Problem
        With the key and value of the line, where the line has them.
    """
    message = str(error)
    rows = text.split("\n")
    line, column = len(text.rstrip().split("\n")), 0
    if match := _AT.search(message):
        message = message[: match.start()]
        line, column = (int(match[1]), int(match[2])) if match[1] else (line, column)
    elif digits := _ENDLESS.search(text):
        message = "number of thousands of digits"
        line = text.count("\n", 0, digits.start()) + 1
    row = rows[line - 1] if line <= len(rows) else ""
    if _inside_brackets(message, row, column):
        line = _opening_line(rows, line)
        row = rows[line - 1]
        message = "Unclosed array" if "[" in row else "Unclosed inline table"
    key, value = "", row.strip()
    if pair := _KEY.match(row):
        key, value = pair[1], pair[2]
    elif header := _HEADER.match(row):
        key = header[1]
    if message.startswith("Cannot overwrite") and row.lstrip().startswith("[[") and key:
        line, value, remedy = _written_once(rows, line, key, value)
    elif message == "Invalid value" or message.startswith("Expected newline"):
        remedy = _value_remedy(value)
    else:
        remedy = next((advice for start, advice in _REMEDIES if message.startswith(start)), _FORM)
    shown = _Verbatim(value) if value else None
    return Problem(origin, line, key, shown, f"not valid TOML: {message}", remedy)


def _inside_brackets(message: str, row: str, column: int) -> bool:
    """Return whether the parser stumbled over a row because a bracket above it is still open."""
    if message == "Invalid value":
        return 0 < column <= row.find("=")
    return message.startswith("Unclosed") and not 0 <= row.find("=") < column - 1


def _written_once(rows: list[str], line: int, key: str, value: str) -> tuple[int, str, str]:
    """Return the line, text and remedy of a [[table]] that is written as a [table], or as a key, above."""
    for number, row in enumerate(rows[: line - 1], start=1):
        if (header := _HEADER.match(row)) and header[1] == key and not row.lstrip().startswith("[["):
            return number, row.strip(), f"Write [[{key}]], with double brackets, as in line {line}."
    return line, value, "Give each key once in its table."


def _opening_line(rows: list[str], line: int) -> int:
    """Return the nearest line above at which a list or inline table opens, or the line itself."""
    for number in range(line - 1, 0, -1):
        if (pair := _KEY.match(rows[number - 1])) and pair[2].startswith(("[", "{")):
            return number
    return line


class _Verbatim:
    """Text shown as it stands in the file, without quotes around it."""

    def __init__(self, text: str) -> None:
        self.text = text

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return repr(self.text)

    def __eq__(self, other: object) -> bool:
        return other == self.text

    def __hash__(self) -> int:
        return hash(self.text)


def _value_remedy(value: str) -> str:
    """Return a remedy for what is no TOML value."""
    if not value:
        return "Write a value after the equals sign."
    if re.match(r"[A-Za-z]", value):
        if value.split("#")[0].strip() in ("True", "False"):
            return "Write true or false in small letters."
        return "Put text in double quotes."
    if re.match(r"[+-]?(\.\d|\d+\.(?!\d))", value):
        return "Write digits before and after the decimal point: 0.5, 1.0."
    if re.match(r"[+-]?\d+,\d", value):
        return "Write a decimal point, not a comma."
    if re.match(r"[+-]?[\d.]+(e[+-]?\d+)?\s*[A-Za-z]", value):
        return "Write the number alone; units are SI and are not written."
    return _FORM
