"""Keys of a scene as a program gives them: dotted, or with two underscores for each dot."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from tmm_gen.errors import UserError

__all__ = ["keys_of"]


def keys_of(changes: object, more: Mapping[str, Any]) -> dict[str, Any]:
    """Return values by dotted key.

    Raises
    ------
    UserError
        If keys are none, or given twice.
    """
    if changes is None:
        changes = {}
    if not isinstance(changes, Mapping):
        raise UserError(
            f"changes: must be a mapping from dotted keys to values, not {type(changes).__name__}."
        )
    found: dict[str, Any] = {}
    for key, value in [
        *(changes or {}).items(),
        *((key.replace("__", "."), value) for key, value in more.items()),
    ]:
        if not isinstance(key, str) or not key:
            raise UserError(f"changes: {key!r} is no key. Write for example {{'beam.links': 20}}.")
        if key in found:
            raise UserError(f"{key}: is given twice. Give it once.")
        found[key] = value
    return found
