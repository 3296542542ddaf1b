"""Kinds of values under ``[control]``: intervals, gains, counts, and numbers that motors may have one each of."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, PlainValidator

from tmm_gen.scene.each import Each, OneOrEach
from tmm_gen.scene.table import Count, Finite, NonNegative, Positive, fault, is_finite_number


def _range(value: object) -> tuple[float, float]:
    """Return ``[low, high]``, or one positive number for both sides, as a pair."""
    if is_finite_number(value) and float(value) > 0.0:
        return -float(value), float(value)
    if isinstance(value, list | tuple) and len(value) == 2 and all(is_finite_number(end) for end in value):
        low, high = float(value[0]), float(value[1])
        if low < high:
            return low, high
        raise fault("must be increasing", "Write the lower bound first.")
    raise fault(
        "must be a positive number or two increasing numbers", "Write for example `3.0` or `[-3.0, 3.0]`."
    )


Range = Annotated[tuple[float, float], PlainValidator(_range)]
EachRange = Annotated[Each[tuple[float, float]], PlainValidator(OneOrEach(Range))]
EachFinite = Annotated[Each[float], PlainValidator(OneOrEach(Finite))]
EachPositive = Annotated[Each[float], PlainValidator(OneOrEach(Positive))]
EachNonNegative = Annotated[Each[float], PlainValidator(OneOrEach(NonNegative))]
EachCount = Annotated[Each[int], PlainValidator(OneOrEach(Count))]
Horizon = Annotated[int, Field(strict=True, ge=2, le=500)]
Substeps = Annotated[int, Field(strict=True, ge=1, le=100)]
Modes = Annotated[int, Field(strict=True, ge=2, le=50)]


def _gains(value: object) -> tuple[float, float]:
    """Return ``[proportional, derivative]`` as a pair."""
    numbers = value if isinstance(value, list | tuple) else ()
    if len(numbers) == 2 and all(is_finite_number(gain) and gain >= 0.0 for gain in numbers):
        return float(numbers[0]), float(numbers[1])
    raise fault("must be two numbers, none negative", "Write for example `[2.0, 0.8]`: N m/rad, N m s/rad.")


Gains = Annotated[tuple[float, float], PlainValidator(_gains)]
EachGains = Annotated[Each[tuple[float, float]], PlainValidator(OneOrEach(Gains))]
