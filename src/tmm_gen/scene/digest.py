"""A fingerprint of what a scene says, whatever its spelling."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import fields, is_dataclass

from pydantic import BaseModel

FORMAT = "tmm-gen scene 1"
"""Changes whenever the same content must no longer have the same digest: a default that becomes another, say."""

UNSAID = {"unsaid": True}
"""Metadata of a dataclass's field that leaves digests alone where it has its default: one added to the format later."""


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
        # what is written as its default says no more than what is absent; so a key added to the format, optional
        # as they all are, leaves the digests of older scenes alone
        declared = type(value).model_fields
        said = {
            k: item for k, item in value if declared[k].is_required() or item != declared[k].get_default()
        }
        return _plain(said)
    if is_dataclass(value) and not isinstance(value, type):
        told = {item.name: (item, getattr(value, item.name)) for item in fields(value)}
        return _plain(
            {k: x for k, (item, x) in told.items() if not (item.metadata == UNSAID and x == item.default)}
        )
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, float):
        return value + 0.0
    return value
