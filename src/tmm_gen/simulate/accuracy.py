"""How far a run is from the motion that the scene's own equations have, relative to how far that motion goes.

Of a chain that is known: the motion follows from the matrix exponential. Of a planar arm it is estimated: the run is
repeated with steps twice as long, and what that changes tells by the order of the integrator what is left. A repetition
from a start that is a hair off tells how much the motion makes of small disturbances. Where a run would be refused, it
is repeated with half the step as well, since long steps may differ by more than their order says.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import UserError
from tmm_gen.inputs.signals import Signal
from tmm_gen.reference.chain_motion import exact_angles
from tmm_gen.scene import Scene
from tmm_gen.simulate.displacement import STILL, extent, lengths, placed
from tmm_gen.simulate.disturbance import SIZES, disturbed
from tmm_gen.simulate.planar_divergence import free_watch
from tmm_gen.simulate.step_error import error_per_radian
from tmm_gen.simulate.stepping import Course, Stepper
from tmm_gen.simulate.trace import Trace

Array = NDArray[np.float64]

MOST = 0.05
"""Largest error of a run that is not refused, as a share of the motion."""

SENSITIVE = 1e3
"""A disturbance that grows by more than this makes of the integrator's small errors large ones."""

_POINTS = 1000
"""Instants looked at, about."""

_CHAIN_POINTS = 20_000
"""The same for chains; a blow's largest error may last a step."""

_FEW = 40
"""A run of fewer steps is repeated with half of them: twice their length may be no motion any more."""

_FIRST, _FINER = 20, 16
"""Steps at the start that are taken again, and how many times shorter."""

_LEAP = 0.5
"""A step that covers more than this of all motion shows nothing of it; a tenth of a period covers a third."""

_SHORTEST = 4
"""Runs of fewer steps may be evenly accelerated, and cover as much in their last one."""

HIGHEST = 3
"""Orders above count as this one: stiff arms do not always show more."""


@dataclass(frozen=True)
class Accuracy:
    """What is known about the error of a run.

    Parameters
    ----------
    error : float
        Largest error of the motion, as a share of how far it goes; infinite where nothing can be said.
    sensitivity : float or None
        How many times larger a small disturbance of the start has become at most; None for chains, which are linear.
    good_until : float
        s; until then the error is below half of what is refused.
    from_sweeps : float
        Of the error, what sweeps have left unsolved; at most.
    """

    error: float
    sensitivity: float | None
    good_until: float
    from_sweeps: float = 0.0


def chain_accuracy(scene: Scene, signals: Mapping[str, Signal], trace: Trace) -> Accuracy:
    """Compare a chain's angles with those that it would have."""
    stride = max(1, math.ceil((len(trace.angle) - 1) / _CHAIN_POINTS))
    indices, angle = trace.indices[::stride], trace.angle[::stride]
    exact = exact_angles(scene, signals, scene.integrator.step, indices)
    off = np.max(np.abs(angle - exact), axis=1)
    way = np.max(np.abs(exact - exact[0]), axis=1)
    return judged(off, way, indices * scene.integrator.step, 0.0, None)


def planar_accuracy(course: Course, stepper: Stepper, unsolved: float) -> Accuracy:
    """Repeat a run of a planar arm with another step, and with another start.

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
    found = _repeated(course, stepper)
    begun = _Repetition(course, stepper).begun()
    found = replace(found, error=max(found.error, begun))
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


def _repeated(course: Course, stepper: Stepper) -> Accuracy:
    scene, steps = course.scene, course.steps
    again = _Repetition(course, stepper)
    order = min(HIGHEST, order_of(scene))
    coarse = None if steps < _FEW else again(2.0)
    if coarse is not None:
        growth = again.sensitivity(2.0, coarse)
        found = again.judged(coarse, 2.0, 1.0 / (2.0**order - 1.0), growth)
        if found.error <= MOST:
            return found
    fine = again(0.5)
    if fine is None:
        return Accuracy(math.inf, None, 0.0)
    growth = again.sensitivity(0.5, fine)
    return again.judged(fine, 0.5, 2.0**order / (2.0**order - 1.0), growth)


@dataclass(frozen=True)
class _Repetition:
    """Takes the steps of a run again, longer or shorter ones."""

    course: Course
    stepper: Stepper

    @property
    def scene(self) -> Scene:
        return self.course.scene

    @property
    def trace(self) -> Trace:
        assert self.course.trace is not None
        return self.course.trace

    def __call__(self, factor: float, moved: Array | None = None, every: int | None = None) -> Trace | None:
        """Return the motion with steps so many times as long; None if that fails."""
        count = round(self.course.steps / factor) if factor < 1.0 else int(self.course.steps / factor)
        trace = Trace.empty(self.scene, count + 1, every or self._stride(factor))
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
        return trace

    def _stride(self, factor: float) -> int:
        """How many of the repetition's steps lie between two instants that are compared."""
        least = max(1, math.ceil(self.course.steps / _POINTS))
        together = math.lcm(self.trace.every, 2 if factor > 1.0 else 1)
        return round(math.ceil(least / together) * together / factor)

    def begun(self) -> float:
        """Return the error that grows from what steps make of the start, as a share of the motion.

        A blow at the start may ring in modes so fast that neither these steps nor such of twice the length follow
        them: both then leave the same wrong speed. The first few steps are taken again, much shorter; how fast the two
        motions part is taken to last.
        """
        if self.trace.every > 1 or self.course.steps < 2 * _FIRST:
            return 0.0
        fine = replace(self, course=replace(self.course, steps=_FIRST))(1.0 / _FINER, every=_FINER)
        if fine is None:
            return 0.0
        mine, others = (placed(self.scene, x) for x in (self.trace.angle[1 : _FIRST + 1], fine.angle[1:]))
        apart = mine - others
        half = _FIRST // 2
        drift = (np.mean(apart[:, half:], axis=1) - np.mean(apart[:, :half], axis=1)) / half
        places = placed(self.scene, self.trace.angle)
        way = float(np.max(lengths(places - places[:, :1])))
        least = STILL * extent(self.scene)
        return float(np.max(lengths(drift))) * self.course.steps / max(way, least)

    def judged(self, other: Trace, factor: float, share: float, growth: float | None) -> Accuracy:
        """Return what the difference from another motion says, of which so large a share counts."""
        stride = round(other.every * factor / self.trace.every)
        count = min(len(self.trace.angle[::stride]), len(other.angle))
        mine, others = (
            placed(self.scene, x) for x in (self.trace.angle[::stride][:count], other.angle[:count])
        )
        # of a sensitive motion what steps change does not fall with their order
        weight = 1.0 if growth is not None and growth > SENSITIVE else share
        off = weight * np.max(lengths(mine - others), axis=1)
        way = np.max(lengths(others - others[:, :1]), axis=1)
        times = self.scene.integrator.step * self.trace.every * stride * np.arange(count, dtype=float)
        return judged(off, way, times, STILL * extent(self.scene), growth)

    def sensitivity(self, factor: float, undisturbed: Trace) -> float | None:
        """Return how many times larger a small disturbance of the start becomes."""
        size = SIZES[self.stepper.real(self.scene)]
        other = self(factor, disturbed(self.scene, size, factor * self.scene.integrator.step))
        if other is None:
            return None
        apart = np.max(np.abs(other.angle - undisturbed.angle)) / size
        return float(apart)


def judged(off: Array, way: Array, times: Array, least: float, growth: float | None) -> Accuracy:
    """Return what errors over time, (k,), say of a run, by how far the motion has come then, (k,).

    Parameters
    ----------
    off, way : array, (k,)
        In the same unit.
    times : array, (k,)
        s.
    least : float
        A way that is none.
    growth : float or None
        The sensitivity of the motion.
    """
    whole = max(float(np.max(way)), least)
    error = float(np.max(off)) / whole if whole > 0.0 else float(np.max(off) > 0.0)
    if not math.isfinite(error):
        return Accuracy(math.inf, growth, 0.0)
    # as a run that ends sooner would be judged
    shares = np.maximum.accumulate(off) / np.maximum(np.maximum.accumulate(way), max(least, 1e-300))
    bad = np.flatnonzero(shares > 0.5 * MOST)
    good = times[-1] if len(bad) == 0 else times[bad[0] - 1] if bad[0] > 0 else 0.0
    return Accuracy(error, growth, float(good))


def order_of(scene: Scene) -> float:
    """Return the order of an integrator: by what power of the step its derived error falls."""
    coarse, fine = (error_per_radian(scene.integrator, angle) for angle in (0.04, 0.02))
    return max(1.0, round(math.log2(coarse / fine))) if fine > 0.0 else 1.0
