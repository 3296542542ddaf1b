"""Runs until one keeps its tolerance: what is wrong with a run is measured, and the next one's steps follow from that.

Errors of steps do not simply add up: how they do is the motion's affair. So a rough run comes first. Its steps are
taken once more, each whole instead of in halves; what that changes tells the error of the run by the order of the
integrator, and how far the next run's steps may err. The last run is measured in the same way: none is trusted.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import CheckFailed
from tmm_gen.inputs.signals import Signal
from tmm_gen.reference.frequency import fastest_mode
from tmm_gen.scene import Scene
from tmm_gen.scene.integrator import COARSEST
from tmm_gen.simulate.accuracy import HIGHEST, SENSITIVE, Accuracy, judged, order_of
from tmm_gen.simulate.adaptive.chosen import Chosen
from tmm_gen.simulate.adaptive.kernel import AnyLength
from tmm_gen.simulate.adaptive.kinks import Kinks
from tmm_gen.simulate.adaptive.march import Aim, March, StuckError, again, march
from tmm_gen.simulate.displacement import STILL, extent, lengths, placed
from tmm_gen.simulate.disturbance import SIZES, disturbed
from tmm_gen.simulate.prescribed import kernel_signals
from tmm_gen.simulate.stages import stage_polynomial
from tmm_gen.simulate.stepping import EPSILON, Stepper

Array = NDArray[np.float64]

_ROUGH = 1e-4
"""Error of a step in the first run: coarse enough to cost next to nothing, fine enough to show the motion."""

_MOST_RUNS = 6
"""If so many do not keep the tolerance, rounding or the motion itself is in the way."""

_MARGIN, _FIRST_MARGIN = 0.5, 0.3
"""Share of the tolerance that the next run is to keep, since the way from steps to it is not quite known; least of all
behind the rough run."""

_START = 0.1
"""Radians of the fastest vibration that a step may pass which begins with whatever a blow may start."""


_FINEST_TURN = {"float64": 1e-11, "float32": 1e-4, "compensated": 1e-9}
"""rad; less may be rounding, and sweeps would not end."""


class ToleranceError(CheckFailed):
    """No run keeps the tolerance: the message says how near they come, and what to do."""


@dataclass(frozen=True, eq=False)
class Kept:
    """A run that keeps its tolerance.

    Parameters
    ----------
    march : March
        Its steps.
    accuracy : Accuracy
        What is known of its error.
    chosen : Chosen
        What it did.
    kernel : AnyLength
        Took the steps.
    """

    march: March
    accuracy: Accuracy
    chosen: Chosen
    kernel: AnyLength


def kept(
    scene: Scene,
    signals: Mapping[str, Signal],
    until: float,
    stepper: Stepper,
    advance: Callable[[float, int], None],
) -> Kept:
    """Run a scene until its tolerance is kept.

    Parameters
    ----------
    scene : Scene
        With ``integrator.tolerance``.
    signals : mapping from str to Signal
        All its inputs by name.
    until : float
        s.
    stepper : Stepper
        Has its kernel.
    advance : callable
        Told which share of a run was taken, and which run it is, from 1.

    Raises
    ------
    ToleranceError
        If no run keeps it.
    """
    return _Passes(scene, signals, until, stepper, advance).found()


@dataclass(eq=False)
class _Passes:
    """Fields as of :func:`kept`."""

    scene: Scene
    signals: Mapping[str, Signal]
    until: float
    stepper: Stepper
    advance: Callable[[float, int], None]

    def found(self) -> Kept:
        scene, tolerance = self.scene, self.scene.integrator.tolerance
        assert tolerance is not None
        order = order_of(scene)
        self.relied = min(HIGHEST, order)
        self.kinks = Kinks(kernel_signals(scene, self.signals), self.until)
        begin = min(scene.integrator.step, _START / max(fastest_mode(scene).frequency, 1e-300))
        error, way, reached = max(_ROUGH, 0.1 * tolerance), 0.0, math.inf
        stuck: StuckError | None = None
        for number in range(1, _MOST_RUNS + 1):
            kernel = self._kernel(error)
            aim = Aim(error, self.relied, way, begin, EPSILON[self.stepper.real(scene)])
            try:
                run = march(scene, kernel, self.kinks, {}, aim, partial(self._advanced, number))
            except StuckError as failed:
                stuck = failed  # shorter steps are no way out
                break
            accuracy, way = self._judged(kernel, aim, run)
            if accuracy.error <= tolerance:
                accuracy = self._sensitivity(kernel, aim, run, accuracy)
            if accuracy.error <= tolerance:
                return Kept(run, accuracy, self._chosen(run, kernel, number), kernel)
            if math.isfinite(accuracy.error):
                margin = _FIRST_MARGIN if number == 1 else _MARGIN
                fall = (margin * tolerance / accuracy.error) ** ((order + 1.0) / order)
                better, reached = accuracy.error < 0.7 * reached, min(reached, accuracy.error)
                if not better and number > 2:  # shorter steps do not mend it
                    break
                error *= min(0.5, fall)
            else:
                error *= 1e-2
        raise self._refusal(tolerance, reached, stuck)

    def _kernel(self, error: float) -> AnyLength:
        """Return the kernel, whose sweeps leave less than steps may."""
        usual = self.stepper.default("least_turn")
        finest = _FINEST_TURN[self.stepper.real(self.scene)]
        turn = {} if usual is None else {"least_turn": min(usual, max(finest, least_turn(self.scene, error)))}
        kernel = AnyLength(self.stepper, turn)
        state = kernel.start(self.kinks.read(np.zeros(1), self.kinks.next(0.0)), {})
        kernel.stages = stage_polynomial(self.scene, state)
        return kernel

    def _advanced(self, number: int, share: float) -> None:
        self.advance(share, number)

    def _judged(self, kernel: AnyLength, aim: Aim, run: March) -> tuple[Accuracy, float]:
        """Return what taking all steps whole tells of the error, and how far the motion goes."""
        mine = placed(self.scene, np.array(run.angle))
        far = np.max(lengths(mine - mine[:, :1]), axis=1)
        coarse = again(self.scene, kernel, self.kinks, {}, aim, run)
        if coarse is None:
            return Accuracy(math.inf, None, 0.0), float(np.max(far))
        self.coarse = coarse
        off = np.max(lengths(mine - placed(self.scene, coarse)), axis=1)
        self.off, self.far = off, far
        share = 1.0 / (2.0**self.relied - 1.0)
        return judged(share * off, far, np.array(run.times), self._least, None), float(np.max(far))

    def _sensitivity(self, kernel: AnyLength, aim: Aim, run: March, accuracy: Accuracy) -> Accuracy:
        """Return the accuracy with what the motion makes of a small disturbance of its start."""
        if self.scene.model.linear:
            return accuracy
        size = SIZES[self.stepper.real(self.scene)]
        moved = disturbed(self.scene, size, float(np.median(np.diff(run.times))))
        given = {"initial_angle": np.array(self.scene.initial.angles) + moved}
        other = again(self.scene, kernel, self.kinks, given, aim, run)
        if other is None:
            return accuracy
        growth = float(np.max(np.abs(other - self.coarse)) / size)
        # of a sensitive motion what steps change does not fall with their order
        share = 1.0 if growth > SENSITIVE else 1.0 / (2.0**self.relied - 1.0)
        return judged(share * self.off, self.far, np.array(run.times), self._least, growth)

    @property
    def _least(self) -> float:
        return 0.0 if self.scene.model.linear else STILL * extent(self.scene)

    def _chosen(self, run: March, kernel: AnyLength, runs: int) -> Chosen:
        assert self.scene.integrator.tolerance is not None
        halves = 0.5 * np.array(run.came)
        return Chosen(
            tolerance=self.scene.integrator.tolerance,
            steps=2 * len(run.came),
            refused=run.refused,
            smallest=float(np.min(halves)),
            largest=float(np.max(halves)),
            prepared=kernel.lengths,
            runs=runs,
        )

    def _refusal(self, tolerance: float, reached: float, stuck: StuckError | None) -> ToleranceError:
        scene = self.scene
        what = f"scene '{scene.name}': no run by {scene.integrator.name} keeps integrator.tolerance = {tolerance:g}"
        if not math.isfinite(reached):
            why = f": {stuck}" if stuck is not None else ": steps of twice the length fail"
            return ToleranceError(
                f"{what}{why}. Look for numbers that are far too large or small; or end sooner, --until."
            )
        larger = float(f"{3.0 * reached:.1g}")
        remedy = "End sooner, --until."
        if tolerance < larger <= COARSEST:
            remedy = f"Ask for no more, --tolerance {larger:g}; or end sooner, --until."
        return ToleranceError(
            f"{what}: the error stays at {reached:.1g} of the motion, however short steps are.\n{remedy}"
        )


def least_turn(scene: Scene, error: float) -> float:
    """Return what a sweep may turn the links by and be the last, rad.

    Parameters
    ----------
    scene : Scene
        In a plane or in space.
    error : float
        Most that a step may be wrong by, as a share of the motion.
    """
    quadratic = scene.spatial is None and not scene.coupled
    # Newton's iteration squares what is wrong; with slopes of one instant of the step it makes that several times less
    return 0.1 * math.sqrt(error) if quadratic else 0.3 * error
