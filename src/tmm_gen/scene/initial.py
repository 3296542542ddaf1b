"""Where the links stand and how fast they turn at time zero."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated

from pydantic import Field, PlainValidator

from tmm_gen.scene.table import Table, fault, is_finite_number


def _numbers(value: object) -> Values:
    """Accept one number, a list of numbers, or a number for each name."""
    if isinstance(value, list | tuple):
        if all(is_finite_number(item) for item in value):
            return tuple(float(item) for item in value)
    elif isinstance(value, Mapping):
        if all(is_finite_number(item) for item in value.values()):
            return {str(name): float(item) for name, item in value.items()}
    elif is_finite_number(value):
        return float(value)
    raise fault(
        "must be one finite number a list of them, or one by each name",
        "Write for example `0.1` for all links, or one number per link: `[0.1, 0.2]`.",
    )


Values = float | tuple[float, ...] | dict[str, float]
"""One number for all, one each in order, or one each by name."""

Numbers = Annotated[Values, PlainValidator(_numbers)]


class InitialTable(Table):
    """``[initial]`` as written: one number for all links, or one per link; of parts by name also one by each name."""

    angles: Numbers = Field(default=0.0, description="angles in rad", examples=["0.1"])
    rates: Numbers = Field(default=0.0, description="angular rates in rad/s", examples=["0.0"])


@dataclass(frozen=True)
class Initial:
    """Motion at time zero; the hub starts at angle 0, at rest.

    Parameters
    ----------
    angles : tuple of float, length n
        Absolute angles of the links, rad.
    rates : tuple of float, length n
        rad/s.
    """

    angles: tuple[float, ...]
    rates: tuple[float, ...]


def in_order(values: Values, names: Sequence[str]) -> float | tuple[float, ...]:
    """Return numbers by name as a list in the order of the names; those without one are missing."""
    if isinstance(values, dict):
        return tuple(values[name] for name in names if name in values)
    return values


def broadcast(value: Values, stations: int) -> tuple[float, ...]:
    """Return one number per link."""
    assert not isinstance(value, dict), "names are for parts"
    return value if isinstance(value, tuple) else (value,) * stations
