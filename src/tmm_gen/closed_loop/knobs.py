"""Numbers of a scene that a search turns: where they are in their ranges, and the scene with others."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from tmm_gen.scene import Scene

Array = NDArray[np.float64]
Number: TypeAlias = float | tuple[float, ...]
"""One, or a list of them."""
_DIGITS = 3


@dataclass(frozen=True)
class Knob:
    """A number to be tuned.

    Parameters
    ----------
    key : str
        In the scene, dotted; the same key twice, of the same motors, makes a list.
    low, high : float
        Decimal logarithms of its range.
    grid : float, optional
        What its values are multiples of; by default they have three digits.
    units : tuple of (str, float)
        Names of the motors it is told for, and what it counts in for each: what the bounds of their torques are. None
        where it is told without names.
    """

    key: str
    low: float
    high: float
    grid: float | None = None
    units: tuple[tuple[str, float], ...] = ()

    def place(self, value: float) -> float:
        """Return where a value is in its range, 0 to 1; the nearer end for what is out of it."""
        logarithm = math.log10(value) if value > 0.0 else -math.inf
        return min(max((logarithm - self.low) / (self.high - self.low), 0.0), 1.0)

    def value(self, place: float, unit: float = 1.0) -> float:
        """Return what it is turned to at a place in its range, 0 to 1."""
        value = 10.0 ** (self.low + (self.high - self.low) * place) * unit
        if self.grid is not None:
            value = self.grid * round(value / self.grid)
        return float(f"{value:.{_DIGITS}g}")


@dataclass(frozen=True)
class Tunable:
    """What is tuned together.

    Parameters
    ----------
    name : str
        As on the command line.
    title : str
        A few words.
    controllers : tuple of str
        Whose objectives count, all with one tuning.
    knobs : tuple of Knob
        What may be turned.
    first : Tunable, optional
        What is tuned before, and where the search then begins.
    """

    name: str
    title: str
    controllers: tuple[str, ...]
    knobs: tuple[Knob, ...]
    first: Tunable | None = None

    @property
    def keys(self) -> tuple[str, ...]:
        """What is turned, each once."""
        return tuple(dict.fromkeys(knob.key for knob in self.knobs))


def turned(scene: Scene, tunable: Tunable, places: Array) -> Scene:
    """Return a scene with its knobs turned, numbers rounded to three digits.

    Parameters
    ----------
    scene : Scene
        Any.
    tunable : Tunable
        Whose knobs.
    places : array, (knobs,)
        In the ranges, 0 to 1.
    """
    values: dict[str, dict[str, list[float]]] = {}
    for knob, place in zip(tunable.knobs, places, strict=True):
        for name, unit in knob.units or (("", 1.0),):
            values.setdefault(knob.key, {}).setdefault(name, []).append(knob.value(float(place), unit))
    changes: dict[str, object] = {}
    for key, told in values.items():
        each = {name: found if len(found) > 1 else found[0] for name, found in told.items()}
        changes[key] = each.get("", each)
    return scene.replace(**changes)


def told(scene: Scene, key: str) -> Number | dict[str, Number] | None:
    """Return a number of a scene, or a list of them, by its dotted key, or those by names; None where it has none."""
    value: Any = scene
    for part in key.split("."):
        value = getattr(value, part)
    found: Number | dict[str, Number] | None = value
    return found


def number(scene: Scene, key: str) -> Number | dict[str, Number]:
    """Return the same; zeros where the scene has none."""
    value = told(scene, key)
    return (0.0, 0.0) if value is None else value


def places_of(scene: Scene, tunable: Tunable) -> Array:
    """Return where a scene's numbers are in the ranges of the knobs, (knobs,), 0 to 1.

    Of a knob that turns numbers of several motors the mean, if they are not alike.
    """
    taken: dict[tuple[str, str], int] = {}
    found = []
    for knob in tunable.knobs:
        value, logarithms = number(scene, knob.key), []
        for name, unit in knob.units or (("", 1.0),):
            own = value[name] if isinstance(value, Mapping) else value
            listed = own if isinstance(own, tuple) else (own,)
            which = taken.get((knob.key, name), 0)
            taken[knob.key, name] = which + 1
            logarithms.append(knob.place(float(listed[which]) / unit))
        found.append(float(np.mean(logarithms)))
    return np.array(found)
