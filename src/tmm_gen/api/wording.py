"""Messages of the command line in the words of Python: ``--step 0.001`` is ``step=0.001`` there."""

from __future__ import annotations

import re
from collections.abc import Callable

__all__ = ["in_python"]

_VALUE = r"([^\s,;]*[^\s,;.:)])"
"""Ends before a mark that belongs to the sentence."""

_ARGUMENTS = {
    "from": "source",
    "to": "target",
    "controller": "controllers",
    "condition": "conditions",
    "map": "maps",
    "max-error": "max_error",
    "max-time": "max_time",
    "max-misfit": "max_misfit",
    "time-unit": "time_unit",
}
"""Options whose arguments have another name in Python: theirs is Python's own, may not be one, or is one of several."""

_VALUED = (
    "step|until|from|to|low|high|backend|cells|controller|condition|integrators|links|linearisations|loss|map|max-error|"
    "max-misfit|max-time|output|scheduler|start|steps|store|target|time-unit|workers"
)
"""Options that a message may name with a value."""

_WORDS = "and|or|is|it|for|must|out|starts|names|counts"
"""What is no value behind an option, but the sentence going on."""


def _value(text: str) -> str:
    """Return a value as Python has it."""
    if text in ("true", "false"):
        return text.capitalize()
    try:
        float(text)
    except ValueError:
        return text if re.fullmatch(r"[A-Z]+", text) or text[:1] in "[{\"'" else f'"{text}"'
    return text


def _given(found: re.Match[str]) -> str:
    return f"{found[1]}={_value(found[2])}"


def _near(found: re.Match[str]) -> str:
    name = found[1] if found[1].isupper() else f'"{found[1]}"'
    return f"near={{{name}: {_value(found[2])}}}"


def _set(found: re.Match[str]) -> str:
    return f"with_({found[1].replace('.', '__')}={_value(found[2])})"


def _option(found: re.Match[str]) -> str:
    return f"{_ARGUMENTS.get(found[1], found[1])}={_value(found[2])}"


def _fits(found: re.Match[str]) -> str:
    keys = re.findall(r"--fit (\S+)", found[0])
    return f"fit=[{', '.join(_value(key) for key in keys)}]"


def _several(found: re.Match[str]) -> str:
    return f"{found[1]}=[{found[2].replace(',', ', ')}]"


def _bare(found: re.Match[str]) -> str:
    return _ARGUMENTS.get(found[1], found[1])


_RULES: tuple[tuple[str, str | Callable[[re.Match[str]], str]], ...] = (
    (rf"--input ([A-Za-z_]\w*)={_VALUE}", _given),
    (r"--input: ", ""),
    (r"--input ", ""),
    (rf"--near ([^=:]+)={_VALUE}", _near),
    (r"write JOINT=ANGLE", "write near={JOINT: ANGLE}"),
    (r"--links-for does", "links_for() does"),
    (rf"--links-for (\S+) --band {_VALUE}", r"links_for(\1, \2)"),
    (r"what `tmm-gen modes` says", "what modes() says"),
    (rf"--set ([\w.]+)={_VALUE}", _set),
    (r"(longer|shorter) --steps", r"\1 steps"),
    (r"--(iterations) (\d+(?:,\d+)+)", _several),
    (r"--fit [\w.]+(?: --fit [\w.]+)+", _fits),
    (rf"--(fit) (?!(?:{_WORDS})\b){_VALUE}", _option),
    (rf"--iterations (?!(?:{_WORDS})\b){_VALUE}", r"with_(model__iterations=\1)"),
    (rf"--tolerance {_VALUE}", r"with_(integrator__tolerance=\1)"),
    (r"`tmm-gen run` shows", "simulate() shows"),
    (r"--force\b", "force=True"),
    (r"what --input gives", "what is given"),
    (rf"--({_VALUED}) (?!(?:{_WORDS})\b){_VALUE}", _option),
    (rf"--({_VALUED}|near|input|fit|iterations|corrections|tolerances)(?![\w-])", _bare),
)


def in_python(message: str) -> str:
    """Return a message with options of the command line as arguments of Python."""
    for pattern, words in _RULES:
        message = re.sub(pattern, words, message)
    return message
