"""A run of an arm taken again, whole or its beginning: with other steps, from another start."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import UserError
from tmm_gen.scene import Scene
from tmm_gen.simulate.displacement import STILL, extent, lengths, placed
from tmm_gen.simulate.disturbance import SIZES, disturbed
from tmm_gen.simulate.planar_divergence import free_watch
from tmm_gen.simulate.stepping import Course, Stepper
from tmm_gen.simulate.trace import Trace

Array = NDArray[np.float64]

_POINTS = 1000
"""Instants looked at, about."""


@dataclass(frozen=True)
class Again:
    """A motion with other steps.

    Parameters
    ----------
    trace : Trace
        Of the links.
    factor : float
        How many times as long its steps are as those of the run.
    """

    trace: Trace
    factor: float

    @property
    def every(self) -> int:
        """How many steps of the run lie between two of its instants."""
        return round(self.trace.every * self.factor)


@dataclass(frozen=True)
class Repetition:
    """Takes the steps of a run again, longer or shorter ones.

    Parameters
    ----------
    course : Course
        The run, with a trace of its motion.
    stepper : Stepper
        That has run it.
    """

    course: Course
    stepper: Stepper
    _beside: dict[Again, tuple[Array, Array]] = field(default_factory=dict, compare=False, repr=False)

    @property
    def scene(self) -> Scene:
        """What moves."""
        return self.course.scene

    @property
    def trace(self) -> Trace:
        """Of the run."""
        assert self.course.trace is not None
        return self.course.trace

    @property
    def least(self) -> float:
        """A way that is none, m."""
        return STILL * extent(self.scene)

    @cached_property
    def way(self) -> float:
        """How far the run goes, m."""
        places = placed(self.scene, self.trace.angle)
        return max(float(np.max(lengths(places - places[:, :1]))), self.least)

    def __call__(
        self, factor: float, moved: Array | None = None, every: int | None = None, steps: int | None = None
    ) -> Again | None:
        """Return the motion with steps so many times as long; None if that fails.

        Parameters
        ----------
        factor : float
            A power of two.
        moved : array, (n,), optional
            Added to the initial angles, rad.
        every : int, optional
            How many steps of the run lie between two instants.
        steps : int, optional
            How many steps of the run are taken again; all by default.
        """
        steps = steps or self.course.steps
        count = round(steps / factor) if factor < 1.0 else int(steps / factor)
        every = every or self._stride(factor)
        trace = Trace.empty(self.scene, count + 1, round(every / factor))
        step = self.scene.integrator.step * factor
        course = replace(
            self.course,
            steps=count,
            step=step,
            guard=free_watch(self.scene, step),
            trace=trace,
            checked=None,
            rows=None,
            moved=moved,
        )
        try:
            for _ in self.stepper.take(course):
                pass
        except (UserError, ArithmeticError):
            return None
        return Again(trace, factor)

    def _stride(self, factor: float) -> int:
        """How many of the run's steps lie between two instants that are compared."""
        least = max(1, math.ceil(self.course.steps / _POINTS))
        together = math.lcm(self.trace.every, max(1, round(factor)))
        return math.ceil(least / together) * together

    def beside(self, other: Again) -> tuple[Array, Array]:
        """Return where the run and a repetition are at the instants of the latter, (d, k, p) each, m."""
        if other not in self._beside:
            mine = self.trace.angle[:: round(other.every / self.trace.every)]
            count = min(len(mine), len(other.trace.angle))
            first, second = (placed(self.scene, angle[:count]) for angle in (mine, other.trace.angle))
            self._beside[other] = first, second
        return self._beside[other]

    def changed(self, one: Again, other: Again) -> float:
        """Return by how much two repetitions differ at most, m, where they have instants in common."""
        every = math.lcm(one.every, other.every)
        angles = [each.trace.angle[:: every // each.every] for each in (one, other)]
        count = min(map(len, angles))
        first, second = (placed(self.scene, angle[:count]) for angle in angles)
        return float(np.max(lengths(first - second)))

    def sensitivity(self, undisturbed: Again) -> float | None:
        """Return how many times larger a small disturbance of the start becomes; None if that fails."""
        size, factor = SIZES[self.stepper.real(self.scene)], undisturbed.factor
        moved = disturbed(self.scene, size, factor * self.scene.integrator.step)
        other = self(factor, moved, undisturbed.every)
        if other is None:
            return None
        return float(np.max(np.abs(other.trace.angle - undisturbed.trace.angle)) / size)
