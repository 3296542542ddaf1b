"""Simulating a scene with its generated kernel, in NumPy or in C."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import UserError
from tmm_gen.measure.assembly import assemble
from tmm_gen.measure.columns import output_columns
from tmm_gen.measure.divergence import DivergedError, Watch, watch
from tmm_gen.measure.energy import energy
from tmm_gen.measure.module import numpy_module
from tmm_gen.measure.planar_divergence import PlanarWatch, planar_watch
from tmm_gen.measure.signals import Constant, Signal
from tmm_gen.measure.simulation import Simulation
from tmm_gen.measure.trace import Trace
from tmm_gen.scene import Scene

if TYPE_CHECKING:
    from tmm_gen.measure.unsolved import Unsolved

Array = NDArray[np.float64]
Backend = Literal["numpy", "c"]

Guard = Watch | PlanarWatch

_CHUNK = 1000
"""Steps between two looks at the motion and the progress bar."""


_MOST = 20_000_000
"""Steps whose outputs are sure to fit in memory."""

_FEW = 5
"""Steps over which a load must spread for its work to be known from its values at them."""


def number_of_steps(until: float, step: float) -> int:
    """Return how many steps it takes to reach a time; the last one may end behind it.

    Raises
    ------
    UserError
        If they are too many to keep.
    """
    ratio = until / step
    if not ratio <= _MOST:
        count = f"{ratio:.0f}" if ratio < 1e15 else "far too many"
        raise UserError(
            f"simulating {until:g} s at a step of {step:g} s takes {count} steps, more than {_MOST:.0f}. "
            "Simulate a shorter time (--until) or take larger steps (--step)."
        )
    return max(1, math.ceil(ratio * (1.0 - 1e-12)))


def simulate(
    scene: Scene,
    signals: Mapping[str, Signal],
    until: float,
    backend: Backend = "numpy",
    advance: Callable[[float], None] | None = None,
    kernel: Any = None,
    *,
    trace: bool = False,
    refuse: bool = True,
) -> Simulation:
    """Simulate a scene at its own step.

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
        Called with the number of steps taken since the last call.
    kernel : module or NativeKernel, optional
        The scene's generated NumPy package, or its compiled C, if it is there already.
    trace : bool
        Keep angles and rates of all links too.
    refuse : bool
        Raise where sweeps leave too much of a planar arm's equations unsolved; the share is in the result either way.

    Raises
    ------
    DivergedError
        If the motion leaves all bounds.
    UnsolvedError
        If sweeps leave more unsolved than the scene's ``model.unsolved``.
    UserError
        If the kernel cannot be made, the steps are too many, or a pivot vanishes.
    """
    steps = number_of_steps(until, scene.integrator.step)
    inputs = {item.name: signals.get(item.name, Constant(0.0)) for item in scene.inputs}
    step = scene.integrator.step
    planar = scene.model.kind == "planar"
    guard = planar_watch(scene, until, step) if planar else watch(scene, inputs, until, step)
    run = _numpy if backend == "numpy" else _native
    kept = _trace(scene, steps) if trace else None
    checked = _unsolved(scene, inputs, steps, backend)
    names = [column.name for column in output_columns(scene)]
    outputs = np.empty((steps + 1, len(names)))
    row = 0
    try:
        for block in run(scene, inputs, steps, guard, kernel, kept, checked):
            outputs[row : row + len(block)] = block
            row += len(block)
            if advance is not None:
                advance(len(block))
    except ArithmeticError as error:  # what generated kernels raise
        if isinstance(guard, PlanarWatch) and scene.model.linearisation != "newton":
            raise DivergedError(
                f"scene '{scene.name}': the simulation has diverged: {error}.\n{guard.cause()}"
            ) from error
        smaller = "Look"
        if planar:
            again = ", or --set model.iterations=2" if scene.model.iterations == 1 else ""
            smaller = f"Try a smaller step, --step {step / 10:g}{again}; or look"
        raise UserError(
            f"scene '{scene.name}' cannot be solved: {error}. "
            f"{smaller} for numbers that are far too large or small."
        ) from error
    left = None if checked is None else checked.check() if refuse else checked.share()
    time: Array = scene.integrator.step * np.arange(steps + 1, dtype=float)
    return Simulation(
        scene=scene,
        backend=backend,
        time=time,
        outputs={name: outputs[:, k] for k, name in enumerate(names)},
        inputs={name: signal.at(time) for name, signal in inputs.items()},
        rest=_rest(scene, inputs, float(time[-1])),
        trace=kept,
        imbalance=_imbalance(scene, inputs, time, kept),
        unsolved=left,
    )


def traceable(scene: Scene, steps: int) -> bool:
    """Return whether the motion of all links of a planar arm is little enough to keep."""
    return scene.model.kind == "planar" and steps * scene.stations <= _MOST


def _imbalance(scene: Scene, signals: Mapping[str, Signal], time: Array, trace: Trace | None) -> float | None:
    """Return how well a planar arm's energies balance; None where a load is too abrupt to know its work."""
    abrupt = any(_abrupt(signals[item.name], item.acts, scene.integrator.step) for item in scene.inputs)
    if trace is None or len(time) < 3 or abrupt:
        return None
    return energy(scene, signals, time, trace.angle, trace.rate).imbalance


def _abrupt(signal: Signal, acts: str, step: float) -> bool:
    """Whether a load changes within a few steps, or a prescribed base jerks."""
    knots = signal.knots
    return len(knots) > 0 and (acts == "angle" or bool(np.min(np.diff(knots), initial=np.inf) < _FEW * step))


def _unsolved(scene: Scene, signals: Mapping[str, Signal], steps: int, backend: Backend) -> Unsolved | None:
    """Return who looks at what sweeps leave unsolved; None where nothing is solved by iteration."""
    if scene.model.kind != "planar" or scene.model.linearisation != "newton":
        return None
    from tmm_gen.measure.unsolved import Unsolved  # SymPy comes with it

    real = "compensated" if scene.emit.compensated else scene.emit.real
    return Unsolved(scene, signals, steps, real if backend == "c" else "float64")


def _trace(scene: Scene, steps: int) -> Trace:
    """Return room for the motion of all links."""
    if not traceable(scene, steps):
        raise UserError(
            f"the motion of {scene.stations} links over {steps} steps is too much to keep. "
            "Simulate a shorter time (--until) or take larger steps (--step)."
        )
    return Trace.empty(scene, steps + 1)


def _rest(scene: Scene, signals: Mapping[str, Signal], until: float) -> dict[str, float] | None:
    """Return the outputs at rest under the last values of the inputs; None where there is no such thing."""
    if scene.model.kind == "planar":
        return None
    assembly = assemble(scene)
    moving = any(signal.frequency or np.any(signal.knots > until) for signal in signals.values())
    if moving or assembly.free:
        return None
    last = np.array([float(signal.at(until)) for signal in signals.values()])
    return dict(zip(assembly.outputs, assembly.static(last).tolist(), strict=True))


def _numpy(
    scene: Scene,
    signals: Mapping[str, Signal],
    steps: int,
    guard: Guard,
    kernel: Any,
    trace: Trace | None,
    checked: Unsolved | None,
) -> Iterator[Array]:
    """Yield blocks of outputs, (rows, outputs), the first one with the start."""
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


def _native(
    scene: Scene,
    signals: Mapping[str, Signal],
    steps: int,
    guard: Guard,
    kernel: Any,
    trace: Trace | None,
    checked: Unsolved | None,
) -> Iterator[Array]:
    """Yield all outputs, (steps + 1, outputs)."""
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


def _number(signal: Signal) -> Callable[[float], float]:
    return lambda time: float(signal.at(time))
