"""What can go wrong with sensors, as hypothesis draws it."""

from __future__ import annotations

import math
from dataclasses import dataclass

from hypothesis import strategies as st

LONGEST = 50
"""Samples that may be wrong in a row."""
TRUE, STUCK, VALUE, ADDED, INVALID = range(5)
_ABSURD = (math.nan, math.inf, -math.inf, 0.0, 1e6, -1e6, 1e30, -1e30, 1e300)


@dataclass(frozen=True)
class Spell:
    """What the sensors show for some samples: for each of the three a kind of fault and its value."""

    samples: int
    kinds: tuple[int, int, int]
    values: tuple[float, float, float]


@dataclass(frozen=True)
class Case:
    """An arm at rest, some true samples, and some spells.

    Parameters
    ----------
    start : float
        Angle of the arm, rad.
    before : int
        True samples.
    spells : tuple of Spell
        At most `LONGEST` samples in all.
    """

    start: float
    before: int
    spells: tuple[Spell, ...]

    @property
    def faults(self) -> int:
        """Samples that are wrong."""
        return sum(spell.samples for spell in self.spells)


def fault(turning: bool) -> st.SearchStrategy[tuple[int, float]]:
    """Draw a kind of fault and its value; of an encoder, which turns, also whole turns."""
    added = st.floats(-3.0, 3.0) | st.sampled_from([1e3, -1e3])
    if turning:
        added |= st.integers(-3, 3).map(lambda turns: 2.0 * math.pi * turns)
    return st.one_of(
        st.just((TRUE, 0.0)),
        st.just((STUCK, 0.0)),
        st.tuples(st.just(VALUE), st.sampled_from(_ABSURD) | st.floats(-10.0, 10.0)),
        st.tuples(st.just(ADDED), added),
        st.tuples(st.just(INVALID), st.sampled_from(_ABSURD)),
    )


@st.composite
def cases(draw: st.DrawFn) -> Case:
    """Draw a case."""
    start = draw(st.sampled_from([-1.0, 0.0, 1.0, 1.2, 1.5]) | st.floats(-math.pi, math.pi))
    left, spells = LONGEST, []
    for _ in range(draw(st.integers(0, 4))):
        if left == 0:
            break
        samples = draw(st.sampled_from([1, left]) | st.integers(1, left))
        left -= samples
        faults = [draw(fault(turning)) for turning in (True, False, False)]
        kinds, values = zip(*faults, strict=True)
        spells.append(Spell(samples, kinds, values))
    return Case(start, draw(st.integers(0, 80)), tuple(spells))
