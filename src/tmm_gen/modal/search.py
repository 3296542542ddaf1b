"""The search for all static equilibria, those on which an arm would fall over among them, whatever kind it is."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import UserError
from tmm_gen.modal.held import Held

Array = NDArray[np.float64]
Rest = TypeVar("Rest")
Each = TypeVar("Each", bound=Held)

SAME = 1e-6
"""rad, or share of an arm's reach; equilibria no further apart are one."""
NEWTON_STEPS = 60
"""Most from one start."""
_STARTS = 64
"""Most starts; each more joint that turns freely would make four times as many."""
_NUDGE = 0.05
"""rad that an arm is moved off an equilibrium to see where it falls."""
_FALLS = 16
"""Most unstable equilibria whose fall is followed."""


@dataclass(frozen=True, eq=False)
class Found(Generic[Each]):
    """What was found from how many starts.

    Parameters
    ----------
    found : tuple of Held
        That which is reached from the start first, then stable ones, then by the ways to fall.
    starts : int
        From how many configurations they were looked for.
    """

    found: tuple[Each, ...]
    starts: int


def shared_ways(ways: tuple[float, ...], pivots: int) -> tuple[tuple[float, ...], int]:
    """Return in which ways free joints are set, and how many of them: all, as long as starts are few.

    Parameters
    ----------
    ways : tuple of float
        All ways, rad, the first two of them enough where joints are many.
    pivots : int
        How many joints turn freely.
    """
    chosen = ways if len(ways) ** pivots <= _STARTS else ways[:2]
    turned = 0
    while turned < pivots and len(chosen) ** (turned + 1) <= _STARTS:
        turned += 1
    return chosen, turned


@dataclass(frozen=True, kw_only=True)
class Search(Generic[Rest, Each]):
    """How equilibria of a kind of arm are looked for.

    Parameters
    ----------
    descended : callable
        Descends from angles, or from the scene's start where they are None, to a stable equilibrium.
    starts : iterable of array
        Angles from which Newton's iteration begins, which unlike a descent stops on saddles too.
    stationary : callable
        Newton's iteration: to an equilibrium of whatever kind, or None where it ends nowhere.
    judged : callable
        Tells how an arm is held there, and takes whether it is reached from where one looks first.
    same : callable
        Whether two equilibria are one.
    fall : callable
        Angles of an unstable equilibrium, and the shape of its fastest fall.
    near : callable, optional
        Finds one that comes first, in place of that which is reached from the scene's start.
    """

    descended: Callable[[Array | None], Rest]
    starts: Iterable[Array]
    stationary: Callable[[Array], Rest | None]
    judged: Callable[[Rest, bool], Each]
    same: Callable[[Each, Each], bool]
    fall: Callable[[Each], tuple[Array, Array]]
    near: Callable[[], Rest] | None = None

    def run(self, advance: Callable[[], None] = lambda: None) -> Found[Each]:
        """Look from all starts, then descend on both sides of each unstable equilibrium along its fall.

        Parameters
        ----------
        advance : callable, optional
            Called at each start.

        Raises
        ------
        UserError
            If there is none, as a torque turns the arm forever; or `near` finds none.
        """
        found: list[Each] = []

        def keep(rest: Rest | None, *, reached: bool = False) -> None:
            if rest is not None:
                each = self.judged(rest, reached)
                if not any(self.same(each, other) for other in found):
                    found.append(each)

        if self.near is not None:
            keep(self.near(), reached=True)
        failure: UserError | None = None
        try:
            keep(self.descended(None), reached=self.near is None)
        except UserError as error:
            failure = error
        count = 0
        for start in self.starts:
            keep(self.stationary(start))
            count += 1
            advance()
        for each in [e for e in found if e.falls][:_FALLS]:
            angles, shape = self.fall(each)
            nudge = _NUDGE * shape / np.max(np.abs(shape))
            for side in (angles + nudge, angles - nudge):
                try:
                    keep(self.descended(side))
                except UserError:  # it falls and falls: a torque turns it on and on
                    continue
        if not found and failure is not None:
            raise failure
        return Found(tuple(sorted(found, key=lambda e: (not e.reached, e.falls))), count)
