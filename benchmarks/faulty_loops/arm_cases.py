"""What can go wrong with an arm of two motors: sensors, and all that its controller is told while it runs."""

from __future__ import annotations

import math
from dataclasses import dataclass

from hypothesis import strategies as st

from faulty_loops.cases import LONGEST, fault

Pair = tuple[float, float]
HEAVIEST = 0.45
"""What the arm really carries at most, kg."""
_WRONG = (math.nan, math.inf, -math.inf, 1e30, -1e30, -1.0)


@dataclass(frozen=True)
class Trouble:
    """What happens for some samples.

    Parameters
    ----------
    samples : int
        How many.
    faults : tuple of (int, float)
        Kind of each encoder's fault, and its value; see :mod:`faulty_loops.cases`.
    reference : (float, float), optional
        Joint angles that the controller is told to aim at, at once.
    jump : (int, float, float), optional
        Sample of the horizon from which on it is told to follow other joint angles.
    limits : (pair, pair), optional
        Bounds of the torques that it is told, as shares of the scene's.
    carried, told : float, optional
        What the arm carries from then on, and what the controller is told of that, kg.
    """

    samples: int
    faults: tuple[tuple[int, float], tuple[int, float]]
    reference: Pair | None
    jump: tuple[int, float, float] | None
    limits: tuple[Pair, Pair] | None
    carried: float | None
    told: float | None


@dataclass(frozen=True)
class ArmCase:
    """An arm at rest at some joint angles, some calm samples, some troubles, calm again."""

    start: Pair
    before: int
    troubles: tuple[Trouble, ...]


def _perhaps(strategy: st.SearchStrategy[object]) -> st.SearchStrategy[object]:
    return st.none() | strategy


_ANGLES = st.tuples(st.floats(-0.5, 1.2), st.floats(-1.6, 0.5))
_TOLD_ANGLES = _ANGLES | st.tuples(*[st.sampled_from(_WRONG) | st.floats(-4.0, 4.0)] * 2)
_SHARES = st.sampled_from((*_WRONG, 0.0, 0.3, 1.0, 9.0)) | st.floats(-1.2, 1.2)
_LIMITS = st.tuples(st.tuples(_SHARES, _SHARES), st.tuples(_SHARES, _SHARES)) | st.floats(0.0, 0.6).map(
    lambda share: ((-share, -share), (share, share))  # too weak to hold the arm, or nearly
)
_CARRIED = st.floats(0.0, HEAVIEST)
_TOLD_MASSES = _CARRIED | st.sampled_from(_WRONG) | st.floats(0.0, 5.0)


@st.composite
def arm_cases(draw: st.DrawFn) -> ArmCase:
    """Draw a case."""
    left, troubles = LONGEST, []
    for _ in range(draw(st.integers(1, 4))):
        if left == 0:
            break
        samples = draw(st.sampled_from([1, left]) | st.integers(1, left))
        left -= samples
        troubles.append(
            Trouble(
                samples,
                (draw(fault(True)), draw(fault(True))),
                draw(_perhaps(_TOLD_ANGLES)),
                draw(_perhaps(st.tuples(st.integers(0, 29), st.floats(-2.0, 2.0), st.floats(-2.0, 2.0)))),
                draw(_perhaps(_LIMITS)),
                draw(_perhaps(_CARRIED)),
                draw(_perhaps(_TOLD_MASSES)),
            )
        )
    return ArmCase(draw(_ANGLES), draw(st.integers(0, 40)), tuple(troubles))
