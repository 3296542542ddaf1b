"""What all tables of a scene file share: no unknown keys, no later change, numbers that are numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from difflib import get_close_matches
from typing import Annotated, TypeGuard

from pydantic import BaseModel, ConfigDict, Field
from pydantic.fields import FieldInfo
from pydantic_core import PydanticCustomError

# Strict: TOML's true is not the number 1, nor "1"; a TOML integer is accepted where a float is expected.
Finite = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Positive = Annotated[float, Field(strict=True, allow_inf_nan=False, gt=0.0)]
NonNegative = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0.0)]
Fraction = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0.0, le=1.0)]
Count = Annotated[int, Field(strict=True, ge=1)]

STATION_LIMIT = 100_000
"""Most links of a scene; more is a slip of the keyboard, to be told before it fills the memory."""


class Table(BaseModel):
    """A table of the scene file: frozen, and every key is a declared one.

    What checks it is built when it is first asked for: a scene has few of all tables.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", defer_build=True)


def hidden(field: FieldInfo) -> bool:
    """Return whether a key is declared only to be refused in words of its own."""
    return isinstance(field.json_schema_extra, dict) and bool(field.json_schema_extra.get("hidden"))


def file_keys(table: type[BaseModel]) -> dict[str, FieldInfo]:
    """Return the fields of a table by the keys that a file has for them; those may be words that Python keeps."""
    return {field.alias or name: field for name, field in table.model_fields.items()}


def is_finite_number(value: object) -> TypeGuard[int | float]:
    """Return whether a value is a number (true and false are not) that a float can hold."""
    if not isinstance(value, int | float) or isinstance(value, bool):
        return False
    try:
        return math.isfinite(value)
    except OverflowError:  # an integer beyond the largest float
        return False


def fault(problem: str, remedy: str) -> PydanticCustomError:
    """Return the error by which a validator rejects a value and says what to do."""
    return PydanticCustomError("scene", "{problem}", {"problem": problem, "remedy": remedy})


def closest(word: object, choices: Sequence[str]) -> str:
    """Return a remedy: the choice a misspelt word probably means, or all choices."""
    near = get_close_matches(str(word).replace("-", "_"), choices, n=1, cutoff=0.6)
    if near:
        return f"Did you mean '{near[0]}'?"
    return f"Choose one of {', '.join(choices)}."
