"""What is wrong with a scene, where, and what to do about it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from tmm_gen.errors import UserError

Path = tuple[str | int, ...]
"""Where a value stands: table names, keys and positions from 0, such as ``("link", 2, "inertia")``."""


@dataclass(frozen=True)
class Finding:
    """A fault found in the content of a scene, not yet tied to a file.

    Parameters
    ----------
    path : tuple of str and int
        Key at fault, positions counted from 0.
    message : str
        What is wrong, to be read after the key: ``must be greater than 0``.
    remedy : str
        What to do, one or more whole sentences.
    value : object, optional
        The value at fault; None where there is none (TOML has no null).
    """

    path: Path
    message: str
    remedy: str
    value: object = None


@dataclass(frozen=True)
class Problem:
    """A fault of a scene file.

    Parameters
    ----------
    file : str
        File as the user named it.
    line : int
        Line from 1; 0 where the fault is the file itself.
    key : str
        Key at fault, such as ``link[3].inertia``, tables counted from 1 as stations are; may be empty.
    value : object
        The value at fault; None where there is none.
    message : str
        What is wrong.
    remedy : str
        What to do.
    """

    file: str
    line: int
    key: str
    value: object
    message: str
    remedy: str

    def __str__(self) -> str:
        """Return ``file:line: key: problem (got VALUE). Remedy.`` on one line."""
        place = f"{self.file}:{self.line}" if self.line else self.file
        key = f"{self.key}: " if self.key else ""
        got = "" if self.value is None else f" (got {show_value(self.value)})"
        return f"{place}: {key}{self.message}{got}. {self.remedy}"


class SceneError(UserError, ValueError):
    """A scene that cannot be used.

    Parameters
    ----------
    problems : iterable of Problem
        At least one; kept sorted by line in the attribute ``problems``.
    """

    problems: tuple[Problem, ...]

    def __init__(self, problems: Iterable[Problem]) -> None:
        self.problems = tuple(sorted(problems, key=lambda problem: problem.line))
        super().__init__("\n".join(str(problem) for problem in self.problems))

    def __reduce__(self) -> tuple[type[SceneError], tuple[tuple[Problem, ...]]]:
        """Pickle by the problems, so that the error crosses process boundaries."""
        return type(self), (self.problems,)


def show_path(path: Path) -> str:
    """Write a path as a user reads it: ``("link", 2, "inertia")`` becomes ``link[3].inertia``."""
    shown = ""
    for part in path:
        if isinstance(part, int):
            shown += f"[{part + 1}]"
        else:
            shown += f".{part}" if shown else part
    return shown


def show_value(value: object, width: int = 60) -> str:
    """Write a value as TOML would, on one line, shortened to about ``width`` characters."""
    if isinstance(value, bool):
        shown = "true" if value else "false"
    elif isinstance(value, str):
        escaped = value.replace("\\", "\\\\").replace('"', '\\"')
        shown = '"' + "".join(c if c.isprintable() else f"\\u{ord(c):04X}" for c in escaped) + '"'
    elif isinstance(value, dict):
        shown = "{" + ", ".join(f"{key} = {show_value(item, width)}" for key, item in value.items()) + "}"
    elif isinstance(value, list | tuple):
        shown = "[" + ", ".join(show_value(item, width) for item in value) + "]"
    elif isinstance(value, int) and abs(value) >= 10**width:
        # Python itself refuses to print integers of more than 4300 digits.
        shown = "an integer of more than 60 digits"
    else:
        shown = str(value)
    return shown if len(shown) <= width else shown[: width - 3] + "..."
