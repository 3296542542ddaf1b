"""Names that can stand in Python, in C behind a prefix, in a file name and in a CSV header alike."""

from __future__ import annotations

import keyword
import re
import sys
from collections.abc import Callable
from typing import Annotated

from pydantic import AfterValidator

from tmm_gen.scene.table import fault
from tmm_gen.scene.words import MODULES_AND_HEADERS, TIME

LONGEST = 48
_ENDS_OF_OTHERS = ("_default", "_INVALID")
"""A scene ``arm`` has a function ``arm_default_params``, ``Arm`` a status ``tmm_Arm_INVALID_STEP``."""


def name_fault(name: str) -> tuple[str, str] | None:
    """Say why a name cannot be used in generated code.

    Only what no generated text could hold is refused: C takes every name behind a prefix, and Python every one that
    is no keyword.

    Parameters
    ----------
    name : str
        Proposed name of a scene, an input or an output.

    Returns
    -------
    tuple of two str, or None
        What is wrong and what to do, or None for a good name.
    """
    if not re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", name):
        return "must be an identifier: a letter, then letters, digits and underscores", _suggestion(name)
    if len(name) > LONGEST:
        return f"must have at most {LONGEST} characters", "Choose a shorter name."
    if keyword.iskeyword(name):
        return "is a keyword of Python", f"Choose another, for example '{name}_1'."
    if name == TIME:
        return "is the clock's name, in every CSV file", "Choose another, for example 'time_1'."
    return None


def scene_name_fault(name: str) -> tuple[str, str] | None:
    """Say why a name cannot be that of a scene, whose package and header it names.

    Parameters
    ----------
    name : str
        Proposed name.

    Returns
    -------
    tuple of two str, or None
        What is wrong and what to do, or None for a good name.
    """
    if found := name_fault(name):
        return found
    for end in _ENDS_OF_OTHERS:
        if name.endswith(end) and name != end:
            return (
                f"ends in {end}: names in its C could be those of a scene '{name.removesuffix(end)}'",
                f"Choose another, for example '{name}_1'.",
            )
    lower = name.lower()
    if lower in sys.stdlib_module_names or lower in MODULES_AND_HEADERS:
        return (
            "would hide a Python module or C header of the same name",
            f"Choose another, for example '{name}_arm'.",
        )
    return None


def title_fault(title: str) -> tuple[str, str] | None:
    """Say why a title cannot stand in a comment of every generated language.

    Parameters
    ----------
    title : str
        Proposed title.

    Returns
    -------
    tuple of two str, or None
        What is wrong and what to do, or None for a good title.
    """
    if not title.isprintable():
        return "must be one line of printable text", "Remove line breaks, tabs and control characters."
    for sequence in ("/*", "*/", '"""', "\\"):
        if sequence in title:
            return (
                f"must not contain {sequence}, which ends or breaks comments of generated code",
                "Remove it.",
            )
    return None


def _suggestion(name: str) -> str:
    """Return a remedy which repairs a name where that is possible."""
    stem = name.removesuffix(".toml")
    repaired = re.sub(r"[^A-Za-z0-9_]+", "_", stem).strip("_")
    if re.match(r"[0-9]", repaired):
        repaired = f"arm_{repaired}"
    if repaired and repaired.isascii() and name_fault(repaired) is None:
        return f"Did you mean '{repaired}'?"
    return "Write for example 'arm10'."


def _checked_by(find: Callable[[str], tuple[str, str] | None]) -> AfterValidator:
    """Return a validator which raises what a function above finds."""

    def check(text: str) -> str:
        if found := find(text):
            raise fault(*found)
        return text

    return AfterValidator(check)


Name = Annotated[str, _checked_by(name_fault)]
SceneName = Annotated[str, _checked_by(scene_name_fault)]
Title = Annotated[str, _checked_by(title_fault)]
