"""What is meant by names of controllers, conditions and tunables."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from difflib import get_close_matches
from typing import TypeVar

from tmm_gen.errors import UserError

__all__ = ["chosen"]

Item = TypeVar("Item")


def chosen(option: str, names: Sequence[str], known: Mapping[str, Item]) -> list[Item]:
    """Return what is meant by names, in the order there is.

    Raises
    ------
    UserError
        If one is unknown; it lists them.
    """
    for name in names:
        if name not in known:
            near = get_close_matches(name, known, n=1)
            guess = f"Did you mean {near[0]}? " if near else ""
            raise UserError(f"{option} {name}: there is none. {guess}There are {', '.join(known)}.")
    return [item for name, item in known.items() if name in names]
