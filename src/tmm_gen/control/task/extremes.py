"""Numbers of ``[control]`` with which nothing can be solved: the one that is least ordinary is named."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, nullcontext

import numpy as np

from tmm_gen.control.task.where import where
from tmm_gen.errors import UserError, of_numbers
from tmm_gen.scene import Scene
from tmm_gen.scene.table import Table

_ORDINARY = 8.0
"""Decades from what a number is if nobody says it, or from 1, within which it is none to speak of."""


class UnsolvableError(UserError):
    """Numbers of ``[control]`` for which there is no controller, though the scene is a good one."""


@contextmanager
def naming_extremes(scene: Scene) -> Iterator[None]:
    """Say which number of ``[control]`` is extreme where numbers leave the range of floating point.

    Raises
    ------
    UnsolvableError
        In place of an error of numbers, with file, line, key and value. Where none is extreme the error stays.
    """
    extreme = _most_extreme(scene)
    try:
        # what overflows is told in words
        with nullcontext() if extreme is None else np.errstate(all="ignore"):
            yield
    except UserError:
        raise
    except Exception as error:
        if not of_numbers(error) or extreme is None:
            raise
        key, value, usual = extreme
        raise UnsolvableError(
            f"{where(scene, key)}: with this the numbers of the controller leave the range of floating point (got "
            f"{value:g}). Write one nearer to {usual:g}."
        ) from error


def _most_extreme(scene: Scene) -> tuple[str, float, float] | None:
    """Return key, value, and what would be usual, of the number that is furthest from that; None of ordinary ones."""
    if scene.control is None:
        return None
    key, value, usual = max(_numbers(scene.control), key=_decades)
    return (key, value, usual) if _decades((key, value, usual)) > _ORDINARY else None


def _decades(number: tuple[str, float, float]) -> float:
    """Return how far one is from what is usual."""
    return abs(math.log10(number[1]) - math.log10(number[2]))


def _numbers(table: Table, path: str = "control") -> Iterator[tuple[str, float, float]]:
    """Yield the magnitudes of all numbers that are written, by key, with that of each if it were not."""
    for name in table.model_fields_set:
        default = type(table).model_fields[name].default
        usual = abs(default) if isinstance(default, int | float) and default else 1.0
        yield from _of_value(getattr(table, name), f"{path}.{name}", usual)


def _of_value(value: object, key: str, usual: float) -> Iterator[tuple[str, float, float]]:
    if isinstance(value, Table):
        yield from _numbers(value, key)
    elif isinstance(value, Mapping):
        for name, each in value.items():
            yield from _of_value(each, f"{key}.{name}", usual)
    elif isinstance(value, tuple):
        for number, each in enumerate(value, 1):
            yield from _of_value(each, f"{key}[{number}]" if isinstance(each, Table) else key, usual)
    elif isinstance(value, int | float) and not isinstance(value, bool) and value and math.isfinite(value):
        yield key, abs(float(value)), usual
