"""Taking the steps of a run: by a generated NumPy module, or by compiled C."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from tmm_gen.inputs.signals import Constant, Signal
from tmm_gen.scene import Scene
from tmm_gen.scene.columns import output_columns
from tmm_gen.simulate.divergence import Watch
from tmm_gen.simulate.planar_divergence import PlanarWatch
from tmm_gen.simulate.prescribed import Derivative, kernel_signals
from tmm_gen.simulate.trace import Trace

if TYPE_CHECKING:
    from tmm_gen.simulate.rows import Rows
    from tmm_gen.simulate.unsolved import Unsolved

Array = NDArray[np.float64]
Guard = Watch | PlanarWatch
Backend = Literal["numpy", "c"]

EPSILON = {"float64": 2.0**-52, "float32": 2.0**-23, "compensated": 2.0**-47}
"""The last place of one in each number type."""

_CHUNK = 1000
"""Steps between two looks at the motion and the progress bar."""

_BLOCK = 1 << 25
"""Bytes of states that compiled C may leave between two looks."""


@dataclass(frozen=True, eq=False)
class Course:
    """Steps to take.

    Parameters
    ----------
    scene : Scene
        What moves.
    signals : mapping from str to Signal
        All its inputs by name.
    steps : int
        How many.
    step : float
        s.
    guard : Watch or PlanarWatch
        Looks at the angles after each step.
    trace : Trace, optional
        Keeps the motion of all links.
    checked : Unsolved, optional
        Looks at some of the steps.
    moved : array, (n,), optional
        Added to the initial angles, rad.
    parameters : mapping from str to float
        Of the kernel, where they differ from the scene's.
    rows : Rows, optional
        Finds states between the ends of steps.
    """

    scene: Scene
    signals: Mapping[str, Signal]
    steps: int
    step: float
    guard: Guard
    trace: Trace | None = None
    checked: Unsolved | None = None
    moved: Array | None = None
    parameters: Mapping[str, float] = field(default_factory=dict)
    rows: Rows | None = None

    @property
    def names(self) -> list[str]:
        """Columns of the outputs."""
        return [column.name for column in output_columns(self.scene)]

    @cached_property
    def driven(self) -> dict[str, Signal | Derivative]:
        """What the kernel takes for the signals: the angle of a prescribed base with its rate and acceleration."""
        return kernel_signals(self.scene, self.signals)

    @property
    def start(self) -> dict[str, Array]:
        """Initial angles where they are not the scene's, as kernels take them."""
        return (
            {} if self.moved is None else {"initial_angle": np.array(self.scene.initial.angles) + self.moved}
        )


@dataclass(eq=False)
class Stepper:
    """Takes steps by one generated kernel.

    Parameters
    ----------
    backend : {"numpy", "c"}
        Which.
    kernel : module or NativeKernel
        The generated NumPy package, or its compiled C.
    sweeps : float or None
        Sweeps that the last course took in all; None where the kernel does not count them.
    """

    backend: Backend
    kernel: Any
    sweeps: float | None = None

    @classmethod
    def of(cls, scene: Scene, backend: Backend, kernel: Any = None) -> Stepper:
        """Generate a scene's kernel, with as many sweeps as it takes where the scene leaves their number open.

        Parameters
        ----------
        scene : Scene
            What is to be simulated.
        backend : {"numpy", "c"}
            Which kernel.
        kernel : module or NativeKernel, optional
            That kernel, if it is there already.
        """
        if kernel is not None:
            return cls(backend, kernel)
        from tmm_gen.program.build import build_program

        program = build_program(scene, auto=scene.model.auto)
        if backend == "c":
            from tmm_gen.native import compile_kernel

            return cls(backend, compile_kernel(program, scene))
        from tmm_gen.native.python_module import numpy_module

        return cls(backend, numpy_module(scene, program))

    def default(self, name: str) -> float | None:
        """Return what a parameter of the kernel is where nothing else is said; None where it has no such parameter."""
        if self.backend == "c":
            found = {p.name: p.default for p in self.kernel.program.parameters}
        else:
            found = vars(self.kernel.Params())
        return float(found[name]) if name in found else None

    def real(self, scene: Scene) -> str:
        """Return the number type it computes in: "float64", "float32" or "compensated"."""
        if self.backend == "numpy":
            return "float64"
        return "compensated" if scene.emit.compensated else scene.emit.real

    def take(self, course: Course) -> Iterator[Array]:
        """Take all steps.

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
        return (self._numpy if self.backend == "numpy" else self._native)(course)

    def _numpy(self, course: Course) -> Iterator[Array]:
        module, h, signals, trace = self.kernel, course.step, course.driven, course.trace

        def read(time: float) -> Any:
            return module.Input(**{name: float(signal.at(time)) for name, signal in signals.items()})

        def row() -> list[float]:
            if trace is not None:
                trace.add(vars(state))
            found = module.output(model, state)
            return [float(getattr(found, name)) for name in names]

        names = course.names
        instants = module.STAGE_INSTANTS
        held = all(isinstance(signal, Constant) for signal in signals.values())
        constant = read(0.0)
        looks = set(course.checked.instants()) if course.checked is not None else set()
        with np.errstate(all="ignore"):  # kernel and guard tell what becomes of it
            parameters = module.Params(**course.parameters)
            model = module.prepare(parameters, step=h)
            state = module.initialise(parameters, constant, **course.start)
            rows = [row()]
            passed = [vars(state)]
            for index in range(course.steps):
                given = constant
                if not held:
                    now = index * h
                    stages = [read(now + at * h) for at in instants[min(index, len(instants) - 1)]]
                    given = stages if len(stages) > 1 else stages[0]
                with _located((index + 1) * h):
                    before, state = state, module.step(model, state, given)
                course.guard.look((index + 1) * h, state.angle)
                if course.checked is not None and index + 1 in looks:
                    course.checked.look(index + 1, vars(before), vars(state))
                rows.append(row())
                if course.rows is not None:
                    passed.append(vars(state))
                if len(rows) >= _CHUNK or index + 1 == course.steps:
                    if course.rows is not None:
                        times = h * np.arange(index + 2 - len(passed), index + 2, dtype=float)
                        course.rows.extend(times, {k: np.array([s[k] for s in passed]) for k in passed[0]})
                        passed = passed[-1:]
                    yield np.array(rows)
                    rows = []
        self.sweeps = float(state.sweeps) if hasattr(state, "sweeps") else None

    def _native(self, course: Course) -> Iterator[Array]:
        import ctypes

        from tmm_gen.native.recording import record

        kernel, h = self.kernel, course.step
        kernel.prepare(course.parameters, step=h)
        kernel.initialise(
            {name: float(signal.at(0.0)) for name, signal in course.driven.items()}, **course.start
        )
        first = kernel.output()
        names = course.names
        before = {name: np.asarray(value, float)[None] for name, value in kernel.state.items()}
        if course.trace is not None:
            course.trace.extend(before)
        yield np.array([[first[name] for name in names]])
        looks = np.array(course.checked.instants() if course.checked is not None else [], int)
        most = max(1, min(_CHUNK, _BLOCK // ctypes.sizeof(kernel.types["state"])))
        taken = 0
        while taken < course.steps:
            # the first steps may read inputs at other instants than the later ones
            starting = taken < len(kernel.program.startup)
            count = 1 if starting else min(most, course.steps - taken)
            found = record(kernel, _inputs(kernel.program, course.driven, h, taken, count), count)
            for index, angles in enumerate(found.states["angle"], start=taken + 1):
                course.guard.look(index * h, np.atleast_1d(angles))
            if found.failed is not None:
                when = (taken + len(found.states["angle"])) * h
                raise ArithmeticError(f"at t = {when:.6g} s {found.failed}") from found.failed
            if course.trace is not None:
                course.trace.extend(found.states)
            together = {name: np.concatenate([before[name], found.states[name]]) for name in found.states}
            if course.checked is not None:
                for index in looks[(looks > taken) & (looks <= taken + count)]:
                    ends = (
                        {name: values[index - taken + k] for name, values in together.items()}
                        for k in (-1, 0)
                    )
                    course.checked.look(int(index), *ends)
            if course.rows is not None:
                course.rows.extend(h * np.arange(taken, taken + count + 1, dtype=float), together)
            before = {name: values[-1:] for name, values in together.items()}
            taken += count
            yield np.column_stack([found.outputs[name] for name in names]) if names else np.zeros((count, 0))
        self.sweeps = float(before["sweeps"][0]) if "sweeps" in before else None


def _inputs(
    program: Any, signals: Mapping[str, Signal | Derivative], h: float, taken: int, count: int
) -> dict[str, Array]:
    """Return the inputs of some steps at the instants of their stages, (count,) or (count, stages)."""
    instants = program.stage_instants[min(taken, len(program.startup))]
    times = h * (taken + np.arange(count)[:, None] + np.array(instants))
    values = {}
    for variable in program.inputs:
        found = np.asarray(signals[variable.name].at(times), float)
        if variable.length is None:
            values[variable.name] = found[:, 0]
            continue
        missing = variable.length - found.shape[1]  # a start-up step may have fewer stages
        values[variable.name] = np.concatenate([found, np.repeat(found[:, -1:], missing, axis=1)], axis=1)
    return values


@contextmanager
def _located(time: float) -> Iterator[None]:
    """Say when the arithmetic of a step broke down."""
    try:
        yield
    except ArithmeticError as error:
        raise ArithmeticError(f"at t = {time:.6g} s {error}") from error
