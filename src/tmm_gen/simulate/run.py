"""Simulating a scene with its generated kernel, in NumPy or in C."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import UserError
from tmm_gen.inputs.signals import Constant, Signal
from tmm_gen.scene import Scene
from tmm_gen.simulate.adaptive.kernel import AnyLength
from tmm_gen.simulate.attempt import Task
from tmm_gen.simulate.imbalance import imbalance_of
from tmm_gen.simulate.prescribed import followed, prescribed
from tmm_gen.simulate.rows import row_instants
from tmm_gen.simulate.settled import outputs_at_rest
from tmm_gen.simulate.simulation import Simulation
from tmm_gen.simulate.stepping import Backend, Course, Stepper
from tmm_gen.simulate.substeps import Progress, Substeps, divided
from tmm_gen.simulate.trace import MOST, Trace

Array = NDArray[np.float64]


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
    task = Task(scene, inputs, until, steps, backend, kernel, advance, trace, refuse, judge, rows)
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


def _between(course: Course, stepper: Stepper) -> tuple[dict[str, Array], Trace]:
    """Return outputs and motion at the instants of rows."""
    assert course.rows is not None
    states = course.rows.states
    outputs = AnyLength(stepper, course.parameters).prepared(course.step).outputs(states)
    motion = Trace.empty(course.scene, len(course.rows.instants))
    motion.extend(states)
    return outputs, motion
