"""Where the links stand and how fast they turn at time zero."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from pydantic import Field, PlainValidator

from tmm_gen.scene.table import Table, fault, is_finite_number


def _numbers(value: object) -> float | tuple[float, ...]:
    """Accept one number or a list of numbers."""
    if isinstance(value, list | tuple):
        if all(is_finite_number(item) for item in value):
            return tuple(float(item) for item in value)
    elif is_finite_number(value):
        return float(value)
    raise fault(
        "must be one finite number or a list of them",
        "Write for example `0.1` for all links, or one number per link: `[0.1, 0.2]`.",
    )


Numbers = Annotated[float | tuple[float, ...], PlainValidator(_numbers)]


class InitialTable(Table):
    """``[initial]`` as written: one number for all links, or one per link."""

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


def broadcast(value: float | tuple[float, ...], stations: int) -> tuple[float, ...]:
    """Return one number per link."""
    return value if isinstance(value, tuple) else (value,) * stations
