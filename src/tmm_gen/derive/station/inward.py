"""The way in: how the force beyond a place, affine in the motion there, is carried over each element.

Outboard of an element ``f = S k + e``, with ``k`` the changes of motion a sweep solves for (``carried.py``). An element
with motion through it changes ``S`` by congruence (``through.py``); one that gives way in a coordinate by a rank-one
update (``giving_way.py``). A correction takes ``e`` over the same elements again, at new motion and with the factors
that a sweep has left: pivots, slopes and answers stay.
"""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.station.carried import ZERO, Carried
from tmm_gen.derive.station.frame import Frame, change
from tmm_gen.derive.station.giving_way import GivingWay
from tmm_gen.derive.station.lets import Let, Line, Update
from tmm_gen.derive.station.motion import Outward, Passed
from tmm_gen.derive.station.shaft import Shaft
from tmm_gen.derive.station.through import Through


class Inward:
    """Walks the elements of a station from its outer to its inner side.

    Parameters
    ----------
    out : Outward
        The same elements on the way out.
    zero : frozenset of sympy.Symbol
        Entries of ``S`` and ``e`` that are known to be zero at the outer side.
    """

    def __init__(self, out: Outward, zero: frozenset[sp.Symbol] = frozenset()) -> None:
        self.frame: Frame = out.frame
        self.arriving = zero
        """What was known to be zero at the outer side."""
        self.ahead: list[Line] = []
        """What known forces need besides motion: of parameters and gains alone."""
        self.known: list[Let] = []
        """Forces of elements that give way, at the point of linearisation."""
        self.answers: list[tuple[Passed, dict[str, sp.Expr]]] = []
        self.columns: dict[sp.Symbol, sp.Expr] = {}
        """Forces per unknown in the coordinates that are not integrated, where they are named."""
        self.shaft: Shaft | None = None
        self._carried = Carried(out.frame, zero)
        through = Through(out, self._carried)
        for passed in reversed(out.passed):
            answers: dict[str, sp.Expr] = {}
            if passed.law.free is None:
                through.carry(passed)
            elif passed is not out.turning:
                answers = self._give_way(passed, out.turning)
            self.answers.append((passed, answers))
        self.answers.reverse()

    def _give_way(self, passed: Passed, turning: Passed | None) -> dict[str, sp.Expr]:
        """Go over an element that gives way; return what the way out needs of its unknown."""
        gone = GivingWay(passed, self._carried, turning)
        self.ahead += gone.ahead
        self.known += gone.known
        self.columns, self.shaft = gone.columns, gone.shaft
        return gone.answers

    @property
    def lines(self) -> list[Line]:
        """What a sweep does."""
        return self._carried.lines

    @property
    def again(self) -> list[Line]:
        """What a correction repeats: forces alone, with the factors of the sweep."""
        return self._carried.again

    @property
    def zero(self) -> frozenset[sp.Symbol]:
        """Entries that are zero at the inner side."""
        return self._carried.zero


def back(inward: Inward) -> list[Line]:
    """Return the way out with the answers: the station's unknown, and the changes of its outer node."""
    frame = inward.frame
    unknown, before = sp.symbols("unknown inner_unknown", real=True)
    lines: list[Line] = []
    for passed, answers in inward.answers:
        if answers:
            value = answers["own"] + answers.get("inner", ZERO) * unknown
            for c in frame.coordinates:
                if c.name in answers:
                    value -= answers[c.name] * change(c)
            if inward.shaft is None:
                lines.append(Update({unknown: value}))
            else:
                lines.append(Let(before, unknown, "unknown of what a shaft is mounted on"))
                lines += [Update({unknown: value}), inward.shaft.answer(before, unknown)]
        for i, swing in passed.swings.items():
            moved = change(frame.coordinates[i])
            lines.append(Update({moved: moved + swing * unknown}))
    return lines
