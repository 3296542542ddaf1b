"""Simulating a scene with its generated kernel, in NumPy or in C."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import UserError
from tmm_gen.inputs.signals import Constant, Signal
from tmm_gen.scene import Scene
from tmm_gen.simulate.adaptive.kernel import AnyLength
from tmm_gen.simulate.divergence import BrokenOffError, DivergedError, Watch, watch
from tmm_gen.simulate.imbalance import imbalance_of
from tmm_gen.simulate.planar_divergence import PlanarWatch, more_sweeps, planar_watch
from tmm_gen.simulate.prescribed import followed, prescribed
from tmm_gen.simulate.rows import Rows, row_instants
from tmm_gen.simulate.settled import outputs_at_rest
from tmm_gen.simulate.simulation import Simulation
from tmm_gen.simulate.stepping import Backend, Course, Stepper
from tmm_gen.simulate.substeps import Progress, Substeps, divided
from tmm_gen.simulate.tolerance import refuse_inaccurate, refuse_unsolved, tolerance
from tmm_gen.simulate.trace import MOST, Trace, room_for

if TYPE_CHECKING:
    from tmm_gen.simulate.accuracy import Accuracy
    from tmm_gen.simulate.unsolved import Unsolved

Array = NDArray[np.float64]

_LEAST_TURN = 1e-8
"""rad; what a sweep may turn the links by and be the last, where the usual does not do."""

_SMALL_SHARE, _SMALLEST = 0.2, 1e-9
"""Share of the error that sweeps may have, and an error that is none."""


def number_of_steps(until: float, step: float) -> int:
    """Return how many steps it takes to reach a time; the last one may end behind it.

    Raises
    ------
    UserError
        If they are too many to keep.
    """
    ratio = until / step
    if not ratio <= MOST:
        count = f"{ratio:.0f}" if ratio < 1e15 else "far too many"
        raise UserError(
            f"simulating {until:g} s at a step of {step:g} s takes {count} steps, more than {MOST:.0f}. "
            "Simulate a shorter time (--until) or take larger steps (--step)."
        )
    return max(1, math.ceil(ratio * (1.0 - 1e-12)))


def simulate(
    scene: Scene,
    signals: Mapping[str, Signal],
    until: float,
    backend: Backend = "numpy",
    advance: Progress | None = None,
    kernel: Any = None,
    *,
    trace: bool = False,
    refuse: bool = True,
    judge: bool = True,
    substeps: bool = False,
    every: float | None = None,
    fixed: bool = False,
) -> Simulation:
    """Simulate a scene at its own step, or by steps that its tolerance chooses.

    Where it leaves open how often to sweep, as often as it takes.

    Parameters
    ----------
    scene : Scene
        What to simulate.
    signals : mapping from str to Signal
        Inputs by name; those not given are zero.
    until : float
        s; the last step ends there or just behind.
    backend : {"numpy", "c"}
        Which generated kernel.
    advance : callable, optional
        Called with the number of steps taken since the last call; below zero where they are taken again.
    kernel : module or NativeKernel, optional
        The scene's generated NumPy package, or its compiled C, if it is there already.
    trace : bool
        Keep angles and rates of all links too.
    refuse : bool
        Raise where the error is too large or sweeps leave too much of a planar arm's equations unsolved; what is known
        of both is in the result either way.
    judge : bool
        Find out about the error at all, which takes about as long as the simulation.
    substeps : bool
        Divide the steps of a planar arm that are too long for its motion (:mod:`tmm_gen.simulate.substeps`), instead of
        refusing it. Only where it sweeps as often as it takes.
    every : float, optional
        How far rows are apart, s, whatever the steps; by default they are the ends of the scene's steps.
    fixed : bool
        Take the scene's step even where it has a tolerance.

    Raises
    ------
    DivergedError
        If the motion leaves all bounds.
    InaccurateError
        If the error is more of the motion than the scene's ``model.accuracy``.
    UnsolvedError
        If sweeps leave more unsolved than the step does, or than the scene's ``model.unsolved``.
    ToleranceError
        If no steps keep the scene's tolerance.
    UserError
        If the kernel cannot be made, the steps are too many, a prescribed angle jumps, or a pivot vanishes.
    """
    steps = number_of_steps(until, scene.integrator.step)
    signals = prescribed(scene, signals, until)
    inputs = {item.name: signals.get(item.name, Constant(0.0)) for item in scene.inputs}
    time: Array = scene.integrator.step * np.arange(steps + 1, dtype=float)
    if every is not None:
        time = row_instants(until, every)
    advance = advance or _unseen
    if scene.integrator.tolerance is not None and not fixed:
        from tmm_gen.simulate.adaptive.simulation import simulate_to_tolerance

        stepper = Stepper.of(scene, backend, kernel)
        return simulate_to_tolerance(scene, inputs, time, backend, advance, stepper, trace=trace)
    rows = None if every is None else time
    task = _Task(scene, inputs, until, steps, backend, kernel, advance, trace, refuse, judge, rows)
    if substeps and scene.model.auto:
        found, shared = divided(scene, steps, backend, task.attempt, task.again)
    else:
        found, shared = task.attempt(scene, 1), Substeps()
    used, count = found.course.scene, shared.count
    fine: Array = used.integrator.step * np.arange(steps * count + 1, dtype=float)
    kept = found.course.trace
    whole = kept if kept is not None and kept.every == 1 else None
    outputs = {name: found.outputs[:, k] for k, name in enumerate(found.course.names)}
    shown = None if whole is None else whole.thinned(count)
    if found.course.rows is not None:
        outputs, shown = _between(found.course, task.stepper)
    return Simulation(
        scene=scene,
        backend=backend,
        time=time,
        outputs=outputs,
        inputs={name: signal.at(time) for name, signal in inputs.items()},
        rest=outputs_at_rest(scene, inputs, float(time[-1])),
        trace=shown,
        imbalance=imbalance_of(used, inputs, fine, whole),
        unsolved=found.unsolved,
        step_error=found.step_error,
        accuracy=found.accuracy,
        sweeps_per_step=found.sweeps,
        substeps=shared,
        taken=None if every is None else steps,
        notes=tuple(followed(scene, inputs, float(time[-1]))),
    )


def _unseen(count: float, doing: str | None = None) -> None:
    """Show no progress."""


@dataclass(frozen=True, eq=False)
class _Task:
    """What is to be simulated; fields as parameters of :func:`simulate`."""

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

    def attempt(self, used: Scene, count: int) -> _Run:
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
    ) -> _Run:
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
        return _Run.of(course, self.stepper, count, advance, judge=self.judge)


@dataclass(frozen=True, eq=False)
class _Run:
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
    ) -> _Run:
        """Take them, and keep the outputs of every so manieth."""
        outputs = _outputs(course, stepper, every, advance)
        sweeps = None if stepper.sweeps is None else stepper.sweeps / course.steps
        checked = course.checked
        left, own = (None, None) if checked is None else (checked.share(), checked.step_error())
        accuracy = None
        if judge and course.trace is not None:
            from tmm_gen.simulate.accuracy import chain_accuracy, planar_accuracy

            if course.scene.model.linear:
                accuracy = chain_accuracy(course.scene, course.signals, course.trace)
            else:
                accuracy = planar_accuracy(course, stepper, left or 0.0)
        return cls(course, outputs, accuracy, left, own, sweeps)

    @property
    def unfinished(self) -> bool:
        """Whether steps that sweep as often as it takes had better sweep more."""
        if self.sweeps is None or self.accuracy is None or self.unsolved is None or self.step_error is None:
            return False
        if self.unsolved > tolerance(self.course.scene, self.step_error):
            return True
        return self.accuracy.from_sweeps > max(_SMALL_SHARE * self.accuracy.error, _SMALLEST)


def _between(course: Course, stepper: Stepper) -> tuple[dict[str, Array], Trace]:
    """Return outputs and motion at the instants of rows."""
    assert course.rows is not None
    states = course.rows.states
    outputs = AnyLength(stepper, course.parameters).prepared(course.step).outputs(states)
    motion = Trace.empty(course.scene, len(course.rows.instants))
    motion.extend(states)
    return outputs, motion


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
