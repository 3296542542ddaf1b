"""A fingerprint of what a scene says, whatever its spelling."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict, is_dataclass

from pydantic import BaseModel

FORMAT = "tmm-gen scene 1"
"""Changes whenever the same content must no longer have the same digest."""


def content_digest(content: Mapping[str, object]) -> str:
    """Return the SHA-256 digest of validated content.

    Parameters
    ----------
    content : mapping from str to object
        Tables, sequences, strings, numbers, booleans and None. The order of sequences counts, that of keys
        does not; minus zero is zero.

    Returns
    -------
    str
        64 hexadecimal digits.

    Raises
    ------
    ValueError
        If a number is not finite.
    """
    text = json.dumps(_plain(content), sort_keys=True, separators=(",", ":"), allow_nan=False)
    return hashlib.sha256(f"{FORMAT}\n{text}".encode()).hexdigest()


def _plain(value: object) -> object:
    """Reduce a value to what JSON has."""
    if isinstance(value, BaseModel):
        return _plain(dict(value))
    if is_dataclass(value) and not isinstance(value, type):
        return _plain(asdict(value))
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, float):
        return value + 0.0
    return value
