"""Rows of a run at instants of their own, between the ends of its steps."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import UserError
from tmm_gen.scene import Scene
from tmm_gen.simulate.dense import Dense, States, dense
from tmm_gen.simulate.trace import MOST

Array = NDArray[np.float64]

_ROUNDED = 1e-12
"""Share of a time by which rounding may put an instant behind it."""


@dataclass(eq=False)
class Rows:
    """States at some instants, found while steps are taken.

    Parameters
    ----------
    scene : Scene
        What moves.
    instants : array, (r,)
        s, increasing.
    """

    scene: Scene
    instants: Array
    _parts: list[dict[str, Array]] = field(default_factory=list, repr=False)
    _found: int = 0
    _between: Dense | None = None

    def extend(self, times: Array, states: States) -> None:
        """Take note of the states at some instants, (k,) and (k, ...), the first of which ended the call before."""
        if self._between is None:
            self._between = dense(self.scene, states)
        reached = times[-1] * (1.0 + _ROUNDED)
        last = int(np.searchsorted(self.instants, reached, side="right"))
        if last > self._found:
            wanted = np.minimum(self.instants[self._found : last], times[-1])
            self._parts.append(self._between.at(wanted, times, states))
            self._found = last

    @property
    def states(self) -> dict[str, Array]:
        """The states at all instants, (r, ...) by name."""
        return {name: np.concatenate([part[name] for part in self._parts]) for name in self._parts[0]}


def row_instants(until: float, every: float) -> Array:
    """Return the instants of rows so far apart, s, the last of which is within the run.

    Raises
    ------
    UserError
        If they are too many to keep, or the first one behind the start is not within the run.
    """
    ratio = until / every
    if not ratio <= MOST:
        raise UserError(
            f"rows {every:g} s apart over {until:g} s are too many to keep. Take fewer, --every {until / MOST:.1g}."
        )
    count = math.floor(ratio * (1.0 + _ROUNDED))
    if count < 1:
        raise UserError(
            f"rows {every:g} s apart leave none within {until:g} s. Take more, --every {until / 100:.1g}."
        )
    return every * np.arange(count + 1, dtype=float)
