"""Words of C: heads of files, titles of sections, when inputs act, what functions may return."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterator, Sequence

from tmm_gen.c_language.wrap import INDENT, WIDTH, comment
from tmm_gen.program.statements import Assign, Loop, Mark, Require, Routine


def head(lines: Sequence[str], lead: str, paragraphs: Sequence[str]) -> str:
    """Return the head of a file and paragraphs behind it, every line with a lead."""
    width = WIDTH - len(lead) - 1
    wrapped: list[str] = []
    for line in lines:
        wrapped += textwrap.wrap(line, width, subsequent_indent=INDENT) or [""]
    for paragraph in paragraphs:
        wrapped += ["", *textwrap.wrap(paragraph, width)]
    return "\n".join(f"{lead} {line}".rstrip() for line in wrapped)


def instants(at: Sequence[float]) -> str:
    """Return instants of a step in words.

    Parameters
    ----------
    at : sequence of float
        In steps, from its beginning.
    """
    named = [_instant(x) for x in at]
    return named[0] if len(named) == 1 else f"{', '.join(named[:-1])} and {named[-1]}"


def statuses(*routines: Routine, ranged: bool) -> str:
    """Return what a function that runs some routines may return, in words.

    Parameters
    ----------
    *routines : Routine
        Of which it runs one.
    ranged : bool
        Whether something in them has to stay within bounds.
    """
    required = any(isinstance(s, Require) for r in routines for s in _flat(r))
    names = [
        "OK",
        "NON_FINITE_INPUT",
        "NULL_POINTER",
        *(["VANISHING_PIVOT"] if required else []),
        "NON_FINITE_STATE",
    ]
    names += ["OUT_OF_RANGE"] if ranged else []
    return f"{', '.join(names[:-1])} or {names[-1]}"


def out_of_range(largest: str | None, *, fenced: bool) -> str:
    """Return the comment on the status OUT_OF_RANGE.

    Parameters
    ----------
    largest : str or None
        Macro of the largest angle, where the kernel has sine and cosine of its own.
    fenced : bool
        Whether some intermediate result has bounds.
    """
    what = []
    if largest is not None:
        what.append(f"an angle is beyond {largest}")
    if fenced:
        what.append("an intermediate result is beyond what the box of the scene can lead to")
    text = f"{', or '.join(what)}; nothing was changed."
    return "\n".join(comment(_capital(text), 1, "/**"))


def sentence(title: str) -> str:
    """Write the titles of a section as sentences, one for each stage they belong to."""
    stages: dict[str, list[str]] = {}
    for part in title.split("; "):
        found = re.fullmatch(r"(Stage \d+ of \d+: )?(.*)", part)
        assert found is not None
        stages.setdefault(found[1] or "", []).append(found[2])
    return " ".join(_capital(f"{stage}{'; '.join(parts)}.") for stage, parts in stages.items())


def _flat(routine: Routine) -> Iterator[Assign | Require | Mark]:
    for top in routine.statements():
        yield from top.body if isinstance(top, Loop) else (top,)


def _instant(at: float) -> str:
    if at == 1:
        return "the end of the step"
    return "its beginning" if at == 0 else f"{at:.6g} of the step"


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]
