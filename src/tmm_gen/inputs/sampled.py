"""Inputs that a program gives: a function of time, values at every step, or instants with values."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import SupportsFloat, SupportsIndex

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tmm_gen.errors import UserError
from tmm_gen.inputs.signals import Table

Array = NDArray[np.float64]

_WIDE = 40
"""Characters of a value in messages."""

_SHARE = 1e-5
"""Of a step: how far apart a function is asked for its slope."""


class FunctionError(UserError):
    """A function that was given as an input fails; its own error is the cause."""


@dataclass(frozen=True)
class Function:
    """A function of time in seconds.

    Parameters
    ----------
    name : str
        Of the input, for messages.
    function : callable
        From an instant, s, to a number in the unit of the input.
    step : float
        Of the simulation, s; slopes are differences over a small share of it.
    """

    name: str
    function: Callable[[float], float]
    step: float

    @property
    def knots(self) -> Array:
        """None that are known."""
        return np.zeros(0)

    @property
    def ends(self) -> float:
        """It never does, as far as is known."""
        return np.inf

    def at(self, time: ArrayLike) -> Array:
        """Return the values at instants."""
        instants = np.asarray(time, float)
        values = [self._value(now) for now in instants.ravel().tolist()]
        return np.array(values, float).reshape(instants.shape)

    def slope(self, time: ArrayLike) -> Array:
        """Return the first derivatives at instants, by differences that look at no instant before zero."""
        now, way = np.asarray(time, float), _SHARE * self.step
        before = np.where(now >= 0.0, np.maximum(now - way, 0.0), now - way)
        return np.asarray((self.at(now + way) - self.at(before)) / (now + way - before), float)

    def curvature(self, time: ArrayLike) -> Array:
        """Return the second derivatives at instants, by differences of slopes a step apart."""
        now = np.asarray(time, float)
        before = np.where(now >= 0.0, np.maximum(now - 0.5 * self.step, 0.0), now - 0.5 * self.step)
        after = now + 0.5 * self.step
        return np.asarray((self.slope(after) - self.slope(before)) / (after - before), float)

    def _value(self, now: float) -> float:
        try:
            value = self.function(now)
        except Exception as error:
            said = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
            raise FunctionError(
                f"{self.name}: the function fails at t = {now:g} s ({said}). Give one of the time in seconds, a float."
            ) from error
        number = finite(value)
        if number is None:
            raise UserError(
                f"{self.name}: the function returns {shown(value)} at t = {now:g} s. It must return a finite number."
            )
        return number


def sampled(name: str, values: object, instants: Array) -> Table:
    """Return an input by its values at every instant of a simulation, linear in between.

    Parameters
    ----------
    name : str
        Of the input, for messages.
    values : array_like, (k + 1,)
        In the unit of the input.
    instants : array, (k + 1,)
        Of the simulation, s.

    Raises
    ------
    UserError
        If they are no numbers, or not as many as instants.
    """
    found = _numbers(name, values, "values")
    if len(found) != len(instants):
        raise UserError(
            f"{name}: has {len(found)} values, and the simulation {len(instants)} instants, from 0 to "
            f"{instants[-1]:g} s. Give a value for each, or a pair (times, values)."
        )
    return Table(instants, found, source=name)


def tabled(name: str, times: object, values: object) -> Table:
    """Return an input by instants and values, linear in between; before the first and after the last it stays.

    Parameters
    ----------
    name : str
        Of the input, for messages.
    times : array_like, (k,)
        s, increasing.
    values : array_like, (k,)
        In the unit of the input.

    Raises
    ------
    UserError
        If they are no numbers, not as many of both, or the times do not increase.
    """
    at, found = _numbers(name, times, "times"), _numbers(name, values, "values")
    if len(at) != len(found):
        raise UserError(
            f"{name}: has {len(at)} times and {len(found)} values. Give a value for each of the times."
        )
    late = np.flatnonzero(np.diff(at) <= 0.0)
    if len(late):
        place = int(late[0])
        raise UserError(
            f"{name}: time {at[place + 1]:g} does not follow {at[place]:g}. "
            "Sort the times and leave out repetitions."
        )
    return Table(at, found, source=name)


def _numbers(name: str, values: object, what: str) -> Array:
    try:
        found = np.asarray(values)
        plain = found.astype(float, casting="same_kind") if found.dtype.kind in "iuf" else None
    except (TypeError, ValueError):  # ragged
        plain = None
    if plain is None:
        raise UserError(
            f"{name}: its {what} are {shown(values)}, not numbers. Give a list or an array of numbers."
        )
    if plain.ndim != 1 or not len(plain):
        raise UserError(f"{name}: its {what} have shape {plain.shape}. Give one row of at least one number.")
    bad = np.flatnonzero(~np.isfinite(plain))
    if len(bad):
        raise UserError(f"{name}: {what}[{bad[0]}] is {plain[bad[0]]}. Give finite numbers.")
    return plain


def finite(value: object) -> float | None:
    """Return a value as a finite float; None for what is none."""
    if getattr(value, "ndim", 0) or isinstance(value, bool):
        return None
    if not isinstance(value, SupportsFloat | SupportsIndex):
        return None
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        return None
    return number if math.isfinite(number) else None


def shown(value: object) -> str:
    """Return a value as Python writes it, shortened."""
    try:
        text = repr(value)
    except ValueError:  # an integer of thousands of digits
        return "an integer of thousands of digits"
    return text if len(text) <= _WIDE else f"{text[: _WIDE - 3]}..."
