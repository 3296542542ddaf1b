"""Where steps have to end, as an input has a kink there, and what they read of it up to there."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.inputs.signals import Constant, Signal
from tmm_gen.simulate.prescribed import Derivative

Array = NDArray[np.float64]

_BEFORE = 4e-9
"""How long before a kink its left side is read, as a share of the shorter way to the kinks beside it."""

_APART = 1e-12
"""Kinks closer together than this share of the run are one: between them is no room for a step."""

_JUMP = 1e-9
"""A change at a kink by more than this share of an input's size is a jump; what is read just before is not quite the
limit."""


@dataclass(frozen=True, eq=False)
class Kinks:
    """The kinks of what drives a kernel.

    Parameters
    ----------
    signals : mapping from str to Signal
        By the names of the kernel's inputs.
    until : float
        End of the run, s.
    """

    signals: Mapping[str, Signal | Derivative]
    until: float

    @cached_property
    def stops(self) -> Array:
        """Instants at which steps end, s: all kinks within the run, and its end."""
        knots = np.concatenate([np.zeros(0), *(s.knots for s in self.signals.values())])
        least = _APART * self.until
        inner = np.unique(knots[(knots > least) & (knots < self.until - least)])
        apart = np.diff(inner, prepend=-np.inf) > least
        return np.append(inner[apart], self.until)

    def next(self, time: float) -> float:
        """Return the first stop behind an instant within the run."""
        place = int(np.searchsorted(self.stops, time, side="right"))
        return float(self.stops[min(place, len(self.stops) - 1)])

    @cached_property
    def steady(self) -> bool:
        """Whether nothing ever changes."""
        return all(isinstance(signal, Constant) for signal in self.signals.values())

    def read(self, times: Array, stop: float) -> dict[str, Array]:
        """Return the inputs at some instants of a step, none of which sees what is behind a stop.

        Parameters
        ----------
        times : array, (k,)
            s; those at the stop or later read its left side.
        stop : float
            The next one, s.
        """
        if self.steady:
            return {name: np.full(times.shape, value) for name, value in self._constants.items()}
        found = {}
        for name, signal in self.signals.items():
            left = self._left(name, stop)
            found[name] = np.asarray(signal.at(np.minimum(times, left)), float)
        return found

    def jumps(self, stop: float) -> bool:
        """Return whether an input jumps at a stop."""
        for name, signal in self.signals.items():
            left = self._left(name, stop)
            if left == np.inf:
                continue
            earlier, before, after = signal.at(np.array([2.0 * left - stop, left, stop]))
            # as it moves, it moves on by no more than this within so short a time
            moves = 2.0 * abs(before - earlier)
            if abs(after - before) > _JUMP * max(abs(after), abs(before)) + moves:
                return True
        return False

    def _left(self, name: str, stop: float) -> float:
        """Return the last instant that is surely on the left of a stop; infinite where the signal has no kink there."""
        knots = self._knots[name]
        place = int(np.searchsorted(knots, stop - _APART * self.until))
        if place == len(knots) or knots[place] > stop + _APART * self.until:
            return np.inf
        beside = np.diff(knots[max(place - 1, 0) : place + 2])
        least = _BEFORE * float(np.min(beside)) if len(beside) else _BEFORE * stop
        return float(min(knots[place], stop) - least)

    @cached_property
    def _constants(self) -> dict[str, float]:
        return {name: float(signal.at(0.0)) for name, signal in self.signals.items()}

    @cached_property
    def _knots(self) -> dict[str, Array]:
        return {name: np.unique(signal.knots) for name, signal in self.signals.items()}
