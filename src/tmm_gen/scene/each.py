"""One value for all motors, or one by each name."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeAlias, TypeVar, get_args

from pydantic import TypeAdapter

from tmm_gen.scene.table import fault

Value = TypeVar("Value")
Each: TypeAlias = Value | dict[str, Value]
"""What is the same for all, or told of each by its name."""


@dataclass(frozen=True)
class OneOrEach:
    """Validates a kind's value, or a table of such values.

    Parameters
    ----------
    kind : type
        Of one value, annotated.
    """

    kind: Any

    @cached_property
    def _one(self) -> TypeAdapter[Any]:
        return TypeAdapter(self.kind)

    def __call__(self, value: object) -> Any:
        """Return the value, each number in its range."""
        if isinstance(value, list) and get_args(self.kind)[0] in (float, int):
            raise fault(
                "must be a number, or of several motors one by each name",
                "Write for example `{ shoulder = 2.5, elbow = 1.5 }`, with the names that your motors have.",
            )
        if not isinstance(value, Mapping):
            return self._one.validate_python(value)
        if not value:
            raise fault("names no motor", "Write one value for all, or one by each name.")
        return {str(name): self._one.validate_python(item) for name, item in value.items()}


def by_names(value: Each[Value], names: Sequence[str]) -> tuple[Value, ...]:
    """Return a value for each name, in their order; every name must be told."""
    return tuple(value[name] if isinstance(value, dict) else value for name in names)


def some_by_names(value: Each[float] | None, names: Sequence[str]) -> tuple[float, ...]:
    """Return a number for each name, in their order; NaN for those that none is told of."""
    if not isinstance(value, dict):
        return (math.nan if value is None else value,) * len(names)
    return tuple(value.get(name, math.nan) for name in names)
