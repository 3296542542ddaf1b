"""What an arm that is built in code is made of: the tables of a scene file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypedDict

__all__ = ["Entry", "Tables"]

Entry = Mapping[str, object]
"""A table by its keys, as ``tmm-gen keys TABLE`` lists them."""


class Tables(TypedDict, total=False):
    """The tables of a scene file by their names; several of one kind are a list."""

    name: str
    title: str
    model: Entry
    integrator: Entry
    base: Entry
    beam: Entry | Sequence[Entry]
    tip: Entry
    motor: Sequence[Entry]
    joint: Sequence[Entry]
    gear: Sequence[Entry]
    link: Sequence[Entry]
    body: Sequence[Entry]
    input: Sequence[Entry]
    output: Sequence[Entry]
    initial: Entry
    emit: Entry
    control: Entry
