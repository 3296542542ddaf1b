"""How large the error of an arm's run probably is: by longer steps, and by much shorter ones at its start.

What steps of twice the length change tells by the order of the integrator what is left, where steps of four times the
length show that errors fall as that order says. What does not fall so counts in full: it may come from modes that none
of these steps follow. Where that cannot be seen, or the run would be refused, half the step is taken as well, and the
larger figure counts. Much shorter steps at the beginning show what fast modes leave for good
(:mod:`tmm_gen.simulate.beginning`), and a repetition from a start that is a hair off how much the motion makes of small
disturbances.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from tmm_gen.scene import Scene
from tmm_gen.simulate.accuracy import HIGHEST, MOST, SENSITIVE, Accuracy, judged, order_of
from tmm_gen.simulate.beginning import begun, lasting
from tmm_gen.simulate.displacement import STILL, extent, lengths, placed
from tmm_gen.simulate.repetition import Again, Repetition
from tmm_gen.simulate.stepping import Backend, Course, Stepper
from tmm_gen.simulate.trace import Trace

Array = NDArray[np.float64]

_FEW = 40
"""A run of fewer steps is repeated with half of them: twice their length may be no motion any more."""

_AFFORDED: dict[Backend, int] = {"numpy": 20_000, "c": 1_000_000}
"""Steps times links of runs that are taken with half the step too, where longer ones leave the order open: a second or
two."""

_NOTHING = 1e-6
"""An error not worth a run with half the step: it may be rounding."""

_LEAP = 0.5
"""A step that covers more than this of all motion shows nothing of it; a tenth of a period covers a third."""

_SHORTEST = 4
"""Runs of fewer steps may be evenly accelerated, and cover as much in their last one."""


def arm_accuracy(course: Course, stepper: Stepper, unsolved: float) -> Accuracy:
    """Repeat a run of an arm, in a plane or in space, with other steps, and with another start.

    Parameters
    ----------
    course : Course
        The run, with a trace of its motion.
    stepper : Stepper
        That has run it.
    unsolved : float
        Work of what its sweeps have left unsolved, as a share of the energy that moves. A false energy is a false
        speed, and that leaves a false angle for every radian turned.
    """
    assert course.trace is not None
    leapt = _leapt(course.scene, course.trace)
    if leapt > _LEAP:
        return Accuracy(leapt, None, 0.0)
    again = Repetition(course, stepper)
    found = _ByOrder(again, min(HIGHEST, order_of(course.scene))).found()
    found = replace(found, error=max(found.error, begun(again)))
    path = float(np.max(np.sum(np.abs(np.diff(course.trace.angle, axis=0)), axis=0)))
    swept = 0.5 * unsolved * max(1.0, path)
    return replace(found, error=found.error + swept, from_sweeps=swept)


def _leapt(scene: Scene, trace: Trace) -> float:
    """Return how much of all motion lies in a single step.

    Integrators that damp fast motion let it die within a step that is far too long, whether that is halved or doubled:
    repetitions agree on a rest that is none.
    """
    if trace.every > 1 or len(trace.angle) <= _SHORTEST:
        return 0.0
    places = placed(scene, trace.angle)
    way = float(np.max(lengths(places - places[:, :1])))
    if way <= STILL * extent(scene):
        return 0.0
    return float(np.max(lengths(np.diff(places, axis=1)))) / way


@dataclass(frozen=True)
class _ByOrder:
    """What the differences between motions with other steps say of a run's error.

    Parameters
    ----------
    again : Repetition
        Of the run.
    order : float
        By what power of the step the error falls.
    """

    again: Repetition
    order: float

    def found(self) -> Accuracy:
        """Return the error, and the sensitivity."""
        double = self.again(2.0) if self.again.course.steps >= _FEW else None
        other = double or self.again(0.5)
        if other is None:
            return Accuracy(math.inf, None, 0.0)
        found = (
            self._beside_longer(other)
            if double
            else self._judged(other, self._fallen, self.again.sensitivity(other))
        )
        by_order = self._share(other.factor, self._fallen)
        left = lasting(self.again, other, by_order if double else -by_order)
        return replace(found, error=max(found.error, left))

    def _beside_longer(self, double: Again) -> Accuracy:
        changed = self._changed(double)
        four = self.again(4.0) if self.again.course.steps >= 2 * _FEW else None
        fall = 0.0 if four is None else _ratio(self.again.changed(four, double), changed)
        seen = fall >= 1.0
        # where errors fall as they should, the motion is alike with all of these steps
        growth = self.again.sensitivity(four) if four is not None and seen else None
        if growth is None:
            growth = self.again.sensitivity(double)
        found = self._judged(double, fall, growth)
        if found.error <= MOST and (seen or found.error <= _NOTHING or not self._affordable):
            return found
        half = self.again(0.5)
        if half is None:
            return found if found.error <= MOST else Accuracy(math.inf, None, 0.0)
        fall = _ratio(changed, self._changed(half))
        finer = self._judged(half, fall, growth)
        if found.error > MOST:  # long steps may differ by more than their order says: not held against a run
            return finer
        return max(self._judged(double, fall, growth), finer, key=lambda each: each.error)

    @property
    def _fallen(self) -> float:
        """How many times smaller the error is with half the step."""
        return float(2.0**self.order)

    @property
    def _affordable(self) -> bool:
        course = self.again.course
        return course.steps * course.scene.stations <= _AFFORDED[self.again.stepper.backend]

    def _changed(self, other: Again) -> float:
        mine, others = self.again.beside(other)
        return float(np.max(lengths(mine - others)))

    def _judged(self, other: Again, fall: float, growth: float | None) -> Accuracy:
        """Return what the difference from another motion says, by how many times it falls with half the steps."""
        mine, others = self.again.beside(other)
        # of a sensitive motion what steps change does not fall with their order
        weight = 1.0 if growth is not None and growth > SENSITIVE else self._share(other.factor, fall)
        off = weight * np.max(lengths(mine - others), axis=1)
        way = np.max(lengths(others - others[:, :1]), axis=1)
        step = self.again.scene.integrator.step
        times = step * other.every * np.arange(mine.shape[1], dtype=float)
        return judged(off, way, times, self.again.least, growth)

    def _share(self, factor: float, fall: float) -> float:
        """Return how much of the difference from steps of twice or half the length is the run's error.

        The difference is ``c (2^p - 1) + a`` with `c` the error of the shorter steps by their order `p`, and what is
        the same with any of these steps, `a`; that from twice these steps is ``c (2^p - 1) 2^p + a``.
        """
        more = self._fallen - 1.0
        by_order = min(1.0, max(0.0, (fall - 1.0) / more))
        of_order = (1.0 if factor > 1.0 else self._fallen) / more
        return by_order * of_order + 1.0 - by_order


def _ratio(longer: float, shorter: float) -> float:
    """Return how many times a difference falls with half the steps; without any it falls as it should."""
    return longer / shorter if shorter > 0.0 else math.inf
