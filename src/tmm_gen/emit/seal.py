"""The line by which a generated file proves that nobody edited it: the hash of all its other lines."""

from __future__ import annotations

import hashlib
import re

LABEL = "sha256 of the rest of this file: "
PLACEHOLDER = LABEL + "0" * 64
"""What an emitter writes, in a comment on a line of its own, for :func:`sealed` to fill in."""

_LINE = re.compile(rf"^.*{LABEL}([0-9a-f]{{64}}).*\n", re.MULTILINE)

WITHOUT_MOTION = "no motion to compare with: from no start can steps be taken within the range of the numbers"
"""What a generated test says that has no motion in it."""


def sealed(text: str) -> str:
    """Fill in the hash of a generated text.

    Raises
    ------
    ValueError
        If it has no line for it.
    """
    if not (found := _LINE.search(text)):
        raise ValueError("the text has no line for its hash")
    start, end = found.span(1)
    return text[:start] + _hash(text, found) + text[end:]


def is_written_by_tmm_gen(text: str) -> bool:
    """Return whether a file says that tmm-gen wrote it, edited since or not."""
    return _LINE.search(text) is not None


def is_intact(text: str) -> bool:
    """Return whether a file is as tmm-gen wrote it, in whatever version."""
    found = _LINE.search(text)
    return found is not None and found[1] == _hash(text, found)


def _hash(text: str, line: re.Match[str]) -> str:
    return hashlib.sha256((text[: line.start()] + text[line.end() :]).encode()).hexdigest()
