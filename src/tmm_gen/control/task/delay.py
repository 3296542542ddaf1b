"""When a torque begins to act, in samples and in parts of one."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.task.problem import ControlProblem

Array = NDArray[np.float64]
Pair = tuple[Array, Array]
"""Torques of the motors, (m,) each."""

_NOTHING = 1e-9
"""Parts of a sample so short are rounding."""


@dataclass(frozen=True)
class Delay:
    """In sample ``k`` torque ``u[k - whole - 1]`` acts for a ``part`` of it, then ``u[k - whole]``.

    Parameters
    ----------
    whole : int
        Samples, not negative.
    part : float
        Of a sample, below 1; negative, by half a step at most, where a model answers later than the arm does.
    acting : int
        At the end of sample k, ``u[k - acting]`` is what acts on the arm.
    """

    whole: int
    part: float
    acting: int

    @property
    def memory(self) -> int:
        """Number of past torques that count."""
        return max(self.whole + 1, self.acting)

    def pair(self, past: Array) -> Pair:
        """Return what acts before and what acts then in the sample that starts, from torques chosen so far, (k, m)."""
        return past[-2 - self.whole], past[-1 - self.whole]

    def end(self, past: Array) -> Array:
        """Return what acts on the arm at the end of the sample that starts, from torques chosen so far."""
        return np.asarray(past[-1 - self.acting])

    def known(self, past: Array) -> list[Pair]:
        """Return the pairs of the samples before a torque chosen now begins to act, from torques chosen so far."""
        ends = range(len(past) - self.whole + 1, len(past) + 1)
        return [(past[k - 2], past[k - 1]) for k in ends]

    def shares(self, steps: int) -> Array:
        """Return the share of the earlier torque in each step of a sample, (steps,).

        A share of -1/2 in the first step, and so 3/2 of the new torque, makes up for a model that averages the
        accelerations at both ends of a step.
        """
        found: Array = np.clip(self.part * steps - np.arange(steps, dtype=float), 0.0, 1.0)
        found[0] = min(self.part * steps, 1.0)
        return found


def delay_of(problem: ControlProblem, lag: float) -> Delay:
    """Split delay less lag into whole samples and the rest.

    Parameters
    ----------
    problem : ControlProblem
        Gives the delay.
    lag : float
        By how much the model itself is late, samples.
    """
    samples = problem.delay / problem.sample_time - lag
    whole = max(0, math.floor(samples + _NOTHING))
    acting = math.floor(problem.delay / problem.sample_time + _NOTHING)
    part = samples - whole
    return Delay(whole, part if abs(part) > _NOTHING else 0.0, acting)
