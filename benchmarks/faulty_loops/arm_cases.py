"""What can go wrong with an arm of several motors: sensors, and all that its controller is told while it runs."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TypeVar

from hypothesis import strategies as st

from faulty_loops.cases import LONGEST, fault

Angles = tuple[float, ...]
_T = TypeVar("_T")
HEAVIEST = 1.5
"""What the arm really carries at most, of what its scene says."""
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
    reference : tuple of float, optional
        Joint angles that the controller is told to aim at, at once.
    jump : (int, tuple of float), optional
        Sample from which on it is told to follow other joint angles, if the horizon is as long.
    limits : (tuple of float, tuple of float), optional
        Bounds of the torques that it is told, as shares of the scene's.
    carried, told : float, optional
        What the arm carries from then on, and what the controller is told of that, as shares of the scene's payload.
    """

    samples: int
    faults: tuple[tuple[int, float], ...]
    reference: Angles | None
    jump: tuple[int, Angles] | None
    limits: tuple[Angles, Angles] | None
    carried: float | None
    told: float | None


@dataclass(frozen=True)
class ArmCase:
    """An arm at rest at some joint angles, some calm samples, some troubles, calm again."""

    start: Angles
    before: int
    troubles: tuple[Trouble, ...]


def _perhaps(strategy: st.SearchStrategy[_T]) -> st.SearchStrategy[_T | None]:
    return st.none() | strategy


_SHARES = st.sampled_from((*_WRONG, 0.0, 0.3, 1.0, 9.0)) | st.floats(-1.2, 1.2)
_CARRIED = st.floats(0.0, HEAVIEST)
_TOLD_MASSES = _CARRIED | st.sampled_from(_WRONG) | st.floats(0.0, 15.0)


@st.composite
def arm_cases(draw: st.DrawFn, ranges: tuple[tuple[float, float], ...]) -> ArmCase:
    """Draw a case.

    Parameters
    ----------
    ranges : tuple of (float, float)
        Joint angles that the arm is at, of each motor, rad.
    """
    motors = len(ranges)
    angles = st.tuples(*(st.floats(*ends) for ends in ranges))
    told_angles = angles | st.tuples(*[st.sampled_from(_WRONG) | st.floats(-4.0, 4.0)] * motors)
    ends = st.tuples(*[_SHARES] * motors)
    limits = st.tuples(ends, ends) | st.floats(0.0, 0.6).map(
        lambda share: ((-share,) * motors, (share,) * motors)  # too weak to hold the arm, or nearly
    )
    jump = st.tuples(st.integers(0, 29), st.tuples(*[st.floats(-2.0, 2.0)] * motors))
    left, troubles = LONGEST, []
    for _ in range(draw(st.integers(1, 4))):
        if left == 0:
            break
        samples = draw(st.sampled_from([1, left]) | st.integers(1, left))
        left -= samples
        troubles.append(
            Trouble(
                samples,
                tuple(draw(fault(True)) for _ in range(motors)),
                draw(_perhaps(told_angles)),
                draw(_perhaps(jump)),
                draw(_perhaps(limits)),
                draw(_perhaps(_CARRIED)),
                draw(_perhaps(_TOLD_MASSES)),
            )
        )
    return ArmCase(draw(angles), draw(st.integers(0, 40)), tuple(troubles))
