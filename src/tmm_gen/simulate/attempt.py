"""One attempt at a run: all its steps of one length, what is known of their error, and whether that is refused."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.inputs.signals import Signal
from tmm_gen.scene import Scene
from tmm_gen.simulate.divergence import BrokenOffError, DivergedError, Watch, watch
from tmm_gen.simulate.planar_divergence import PlanarWatch, more_sweeps, planar_watch
from tmm_gen.simulate.rows import Rows
from tmm_gen.simulate.stepping import Backend, Course, Stepper
from tmm_gen.simulate.substeps import Progress
from tmm_gen.simulate.tolerance import refuse_inaccurate, refuse_unsolved, tolerance
from tmm_gen.simulate.trace import room_for

if TYPE_CHECKING:
    from tmm_gen.simulate.accuracy import Accuracy
    from tmm_gen.simulate.unsolved import Unsolved

Array = NDArray[np.float64]

_LEAST_TURN = 1e-8
"""rad; what a sweep may turn the links by and be the last, where the usual does not do."""

_SMALL_SHARE, _SMALLEST = 0.2, 1e-9
"""Share of the error that sweeps may have, and an error that is none."""


@dataclass(frozen=True, eq=False)
class Task:
    """What is to be simulated; fields as parameters of :func:`tmm_gen.simulate.run.simulate`."""

    scene: Scene
    inputs: Mapping[str, Signal]
    until: float
    steps: int
    backend: Backend
    kernel: Any
    advance: Progress
    trace: bool
    refuse: bool
    judge: bool
    rows: Array | None = None
    _taken: list[float] = field(default_factory=list)

    @cached_property
    def stepper(self) -> Stepper:
        """Who takes the steps; of any length."""
        return Stepper.of(self.scene, self.backend, self.kernel)

    def attempt(self, used: Scene, count: int) -> Taken:
        """Run in so many substeps per step; `used` is the scene with their length as its step."""
        self._guard(used)  # before a kernel is made: what starts too fast is refused at once
        found = self._run(used, count, {}, self._count)
        if found.unfinished:  # more sweeps than are usually enough
            found = self._run(used, count, {"least_turn": _LEAST_TURN}, None)
        if self.refuse and found.accuracy is not None:
            refuse_inaccurate(used, found.accuracy)
        if self.refuse and found.unsolved is not None and found.step_error is not None:
            refuse_unsolved(used, found.unsolved, found.step_error)
        return found

    def again(self, count: int) -> None:
        """Take back what progress was shown: all steps are taken again, in so many substeps each."""
        self.advance(-sum(self._taken), f"{self.scene.name}: the step is too long, {count} substeps each")
        self._taken.clear()

    def _count(self, taken: float) -> None:
        self._taken.append(taken)
        self.advance(taken)

    def _guard(self, used: Scene) -> Watch | PlanarWatch:
        step = used.integrator.step
        return watch(used, self.inputs, self.until, step) if used.model.linear else planar_watch(used, step)

    def _run(
        self,
        used: Scene,
        count: int,
        parameters: Mapping[str, float],
        advance: Callable[[float], None] | None,
    ) -> Taken:
        steps, step = self.steps * count, used.integrator.step
        course = Course(
            used,
            self.inputs,
            steps,
            step,
            self._guard(used),
            room_for(used, steps, whole=self.trace) if self.trace or self.judge else None,
            _unsolved(used, self.inputs, steps, self.backend),
            parameters=parameters,
            rows=None if self.rows is None else Rows(used, self.rows),
        )
        return Taken.of(course, self.stepper, count, advance, judge=self.judge)


@dataclass(frozen=True, eq=False)
class Taken:
    """All steps taken, and what is known of their error; fields as of :class:`Simulation`."""

    course: Course
    outputs: Array
    accuracy: Accuracy | None
    unsolved: float | None
    step_error: float | None
    sweeps: float | None

    @classmethod
    def of(
        cls,
        course: Course,
        stepper: Stepper,
        every: int,
        advance: Callable[[float], None] | None,
        *,
        judge: bool,
    ) -> Taken:
        """Take them, and keep the outputs of every so manieth."""
        outputs = _outputs(course, stepper, every, advance)
        sweeps = None if stepper.sweeps is None else stepper.sweeps / course.steps
        checked = course.checked
        left, own = (None, None) if checked is None else (checked.share(), checked.step_error())
        accuracy = None
        if judge and course.trace is not None:
            from tmm_gen.simulate.accuracy import chain_accuracy
            from tmm_gen.simulate.arm_accuracy import arm_accuracy

            if course.scene.model.linear:
                accuracy = chain_accuracy(course.scene, course.signals, course.trace)
            else:
                accuracy = arm_accuracy(course, stepper, left or 0.0)
        return cls(course, outputs, accuracy, left, own, sweeps)

    @property
    def unfinished(self) -> bool:
        """Whether steps that sweep as often as it takes had better sweep more."""
        if self.sweeps is None or self.accuracy is None or self.unsolved is None or self.step_error is None:
            return False
        if self.unsolved > tolerance(self.course.scene, self.step_error):
            return True
        return self.accuracy.from_sweeps > max(_SMALL_SHARE * self.accuracy.error, _SMALLEST)


def _outputs(course: Course, stepper: Stepper, every: int, advance: Callable[[float], None] | None) -> Array:
    """Take all steps and return the outputs at the start and after every so manieth, (rows, columns)."""
    scene, step, guard = course.scene, course.step, course.guard
    outputs = np.empty((course.steps // every + 1, len(course.names)))
    row = 0
    try:
        for block in stepper.take(course):
            shown = block[-row % every :: every]
            outputs[math.ceil(row / every) :][: len(shown)] = shown
            row += len(block)
            if advance is not None:
                advance(len(block) / every)
    except ArithmeticError as error:  # what generated kernels raise
        if isinstance(guard, PlanarWatch) and not scene.model.iterates:
            raise DivergedError(
                f"scene '{scene.name}': the simulation has diverged: {error}.\n{guard.cause()}",
                reason="it would diverge",
            ) from error
        why, smaller = f"{error}", "Look"
        if scene.model.iterates:
            why = f"the step is too long for this motion ({error})"
            smaller = f"Try a smaller step, --step {step / 10:g}{more_sweeps(scene)}; or look"
        raise BrokenOffError(
            f"scene '{scene.name}' cannot be solved: {why}.",
            f"{smaller} for numbers that are far too large or small.",
        ) from error
    return outputs


def _unsolved(scene: Scene, signals: Mapping[str, Signal], steps: int, backend: Backend) -> Unsolved | None:
    """Return who looks at what sweeps leave unsolved; None where nothing is solved by iteration."""
    if not scene.model.iterates or scene.spatial is not None:
        return None
    from tmm_gen.simulate.unsolved import Unsolved  # SymPy comes with it

    return Unsolved(scene, signals, steps, Stepper(backend, None).real(scene))
