"""Taking the steps of a run: by a generated NumPy module, or by compiled C."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.measure.columns import output_columns
from tmm_gen.measure.divergence import Watch
from tmm_gen.measure.module import numpy_module
from tmm_gen.measure.planar_divergence import PlanarWatch
from tmm_gen.measure.prescribed import Derivative
from tmm_gen.measure.signals import Constant, Signal
from tmm_gen.measure.trace import Trace
from tmm_gen.scene import Scene

if TYPE_CHECKING:
    from tmm_gen.measure.unsolved import Unsolved

Array = NDArray[np.float64]
Guard = Watch | PlanarWatch
Sampled = Signal | Derivative

_CHUNK = 1000
"""Steps between two looks at the motion and the progress bar."""


def numpy_steps(
    scene: Scene,
    signals: Mapping[str, Sampled],
    steps: int,
    guard: Guard,
    kernel: Any,
    trace: Trace | None,
    checked: Unsolved | None,
) -> Iterator[Array]:
    """Take all steps in NumPy.

    Parameters
    ----------
    scene : Scene
        What moves.
    signals : mapping from str to Signal or Derivative
        All that its kernel takes, by name (:func:`tmm_gen.measure.prescribed.kernel_signals`).
    steps : int
        How many.
    guard : Watch or PlanarWatch
        Looks at the angles after each step.
    kernel : module, optional
        The generated package, if it is there already.
    trace : Trace, optional
        Keeps the motion of all links.
    checked : Unsolved, optional
        Looks at some of the steps.

    Yields
    ------
    array, (rows, outputs)
        The first one begins with the start.

    Raises
    ------
    DivergedError
        As the guard does.
    ArithmeticError
        As the kernel does, with the time.
    """
    module = kernel or numpy_module(scene)
    h = scene.integrator.step

    def read(time: float) -> Any:
        return module.Input(**{name: float(signal.at(time)) for name, signal in signals.items()})

    names = [column.name for column in output_columns(scene)]

    def row() -> list[float]:
        if trace is not None:
            trace.add(state)
        found = module.output(model, state)
        return [float(getattr(found, name)) for name in names]

    instants = module.STAGE_INSTANTS
    held = all(isinstance(signal, Constant) for signal in signals.values())
    constant = read(0.0)
    looks = set(checked.instants()) if checked is not None else set()
    with np.errstate(all="ignore"):  # kernel and guard tell what becomes of it
        model = module.prepare()
        state = module.initialise(module.Params(), constant)
        rows = [row()]
        for index in range(steps):
            given = constant
            if not held:
                now = index * h
                stages = [read(now + at * h) for at in instants[min(index, len(instants) - 1)]]
                given = stages if len(stages) > 1 else stages[0]
            with _located((index + 1) * h):
                before, state = state, module.step(model, state, given)
            guard.look((index + 1) * h, state.angle)
            if checked is not None and index + 1 in looks:
                checked.look(index + 1, vars(before), vars(state))
            rows.append(row())
            if len(rows) >= _CHUNK or index + 1 == steps:
                yield np.array(rows)
                rows = []


def native_steps(
    scene: Scene,
    signals: Mapping[str, Sampled],
    steps: int,
    guard: Guard,
    kernel: Any,
    trace: Trace | None,
    checked: Unsolved | None,
) -> Iterator[Array]:
    """Take all steps in compiled C; as :func:`numpy_steps`, but yields once, at the end.

    Without a trace the guard looks at the end alone; where that has diverged it is run again, step by step, to find
    out when.
    """
    from tmm_gen.native import NonFiniteStateError, compile_kernel
    from tmm_gen.program.build import build_program
    from tmm_gen.program.evaluate import VanishingPivotError

    kernel = kernel or compile_kernel(build_program(scene), scene)
    h = scene.integrator.step
    given = {
        name: signal.value if isinstance(signal, Constant) else _number(signal)
        for name, signal in signals.items()
    }
    if trace is not None:
        names = [column.name for column in output_columns(scene)]
        yield _step_by_step(kernel, given, h, steps, guard, trace, names, checked)
        return
    try:
        blocks = list(_by_blocks(kernel, given, h, steps, checked))
        kept = np.max(np.abs(kernel.state["angle"])) <= guard.bound
    except (NonFiniteStateError, VanishingPivotError):
        kept = False
    if not kept:
        _find_divergence(kernel, given, h, steps, guard)
    names = [column.name for column in output_columns(scene)]
    yield np.array([[row[name] for name in names] for block in blocks for row in block])


def _by_blocks(
    kernel: Any, given: Mapping[str, Any], h: float, steps: int, checked: Unsolved | None
) -> Iterator[list[dict[str, float]]]:
    """Run compiled C from one step to look at to the next; yield outputs, the first block with the start."""
    kernel.prepare(step=h)
    kernel.initialise({name: value(0.0) if callable(value) else value for name, value in given.items()})
    yield [kernel.output()]
    taken = 0
    for index in checked.instants() if checked is not None else [steps]:
        if checked is None:
            yield kernel.advance(given, taken, index - taken)
        else:
            yield kernel.advance(given, taken, index - 1 - taken)
            before = kernel.state
            yield kernel.advance(given, index - 1, 1)
            checked.look(index, before, kernel.state)
        taken = index


def _find_divergence(kernel: Any, given: Mapping[str, Any], h: float, steps: int, guard: Guard) -> None:
    """Run once more, looking at each step, until the guard raises."""
    _step_by_step(kernel, given, h, steps, guard, None, [], None)


def _step_by_step(
    kernel: Any,
    given: Mapping[str, Any],
    h: float,
    steps: int,
    guard: Guard,
    trace: Trace | None,
    names: list[str],
    checked: Unsolved | None,
) -> Array:
    """Run compiled C, looking at each step; returns some of its outputs, (steps + 1, names)."""
    from tmm_gen.native import NonFiniteStateError

    def read(time: float) -> dict[str, float]:
        return {name: value(time) if callable(value) else value for name, value in given.items()}

    def row() -> list[float]:
        if trace is not None:
            trace.add(kernel.state)
        found = kernel.output() if names else {}
        return [found[name] for name in names]

    kernel.prepare()
    kernel.initialise(read(0.0))
    instants = kernel.program.stage_instants
    longest = max(len(each) for each in instants)
    looks = set(checked.instants()) if checked is not None else set()
    rows = [row()]
    for index in range(steps):
        stages = [read((index + at) * h) for at in instants[min(index, len(instants) - 1)]]
        stages += stages[-1:] * (longest - len(stages))
        values = {
            name: [stage[name] for stage in stages] if longest > 1 else stages[0][name] for name in given
        }
        before = kernel.state if index + 1 in looks else None
        with _located((index + 1) * h), suppress(NonFiniteStateError):  # its state tells where
            kernel.step(values)
        guard.look((index + 1) * h, kernel.state["angle"])
        if checked is not None and before is not None:
            checked.look(index + 1, before, kernel.state)
        rows.append(row())
    return np.array(rows)


@contextmanager
def _located(time: float) -> Iterator[None]:
    """Say when the arithmetic of a step broke down."""
    try:
        yield
    except ArithmeticError as error:
        raise ArithmeticError(f"at t = {time:.6g} s {error}") from error


def _number(signal: Sampled) -> Callable[[float], float]:
    return lambda time: float(signal.at(time))
