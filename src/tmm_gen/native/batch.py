"""Many arms of one scene in compiled C, side by side in vector registers, shared among threads."""

from __future__ import annotations

import ctypes
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tmm_gen.c_language.real import Real, real_of
from tmm_gen.emit.c import emit_c_batch
from tmm_gen.emit.c.structs import structs_of
from tmm_gen.emit.templates import render
from tmm_gen.native.compiler import FLAGS, compile_library
from tmm_gen.native.differences import with_derivatives
from tmm_gen.native.layout import require_sizes, structure_of
from tmm_gen.native.machine import machine, machine_flags, processors
from tmm_gen.native.many import Numbers, arm_count, by_arm, columns, numbers, require_known, shares, whole
from tmm_gen.native.many_inputs import Signal, at_start, sampled, signal_structs
from tmm_gen.program.statements import Program
from tmm_gen.program.variables import Variable
from tmm_gen.scene import Scene


@dataclass(frozen=True)
class BatchRun:
    """What became of many arms.

    Parameters
    ----------
    times : array, shape (kept,)
        Instants (s).
    outputs : dict from str to array, shape (kept, arms)
        Outputs at these instants, NaN where an arm was refused before.
    status : array of int, shape (arms,)
        0 for an arm that came through, otherwise an index of :data:`tmm_gen.emit.numpy.batch.STATUSES`.
    """

    times: NDArray[np.float64]
    outputs: dict[str, Numbers]
    status: NDArray[np.intc]

    def __repr__(self) -> str:
        """Return how many arms, instants and outputs there are."""
        ended = f", {np.count_nonzero(self.status)} refused" if self.status.any() else ""
        names = ", ".join(self.outputs)
        return f"BatchRun({self.status.size} arms{ended}, {self.times.size} instants, outputs: {names})"


def compile_batch(
    program: Program, scene: Scene, cc: str = "gcc", flags: Sequence[str] | None = None
) -> NativeBatch:
    """Emit a program as C for many arms, compile it and load it.

    Parameters
    ----------
    program : Program
        As built for the scene.
    scene : Scene
        Gives the number type and, by ``emit.batch``, how many arms go side by side.
    cc : str
        Compiler that understands gcc's options.
    flags : sequence of str, optional
        Options besides ``-std=c99``; by default optimised for this machine, without fused multiply-add.

    Raises
    ------
    UserError
        If there is no such compiler, or it refuses the sources.
    ValueError
        If the scene asks for no batch.
    """
    starts = program.step in program.initialise.read()
    harness = render(
        "c/batch_harness.c.jinja", name=program.name, given=program.given, starts_from_step=starts
    )
    files = {**emit_c_batch(program, scene), "c/batch-harness.c": harness}
    if flags is None:
        flags = ("-O3", *FLAGS[1:], *machine_flags(cc))
        files["machine.txt"] = machine(cc)  # so that a library is found again only where its instructions are
    handle = ctypes.CDLL(str(compile_library(files, cc, flags)))
    return NativeBatch(program, real_of(scene.emit), handle)


class NativeBatch:
    """Many arms of one scene.

    Parameters
    ----------
    program : Program
        What was emitted.
    real : Real
        Number type.
    handle : ctypes.CDLL
        The shared library.

    Raises
    ------
    RuntimeError
        If compiler and ctypes disagree on the layout of the structs.
    """

    def __init__(self, program: Program, real: Real, handle: ctypes.CDLL) -> None:
        self.program = program
        self._handle = handle
        self._real: Any = np.float32 if real.size == 4 else np.float64
        self._structs = {struct.name: struct for struct in structs_of(program)}
        self._types = {name: structure_of(struct, real) for name, struct in self._structs.items()}
        require_sizes(program.name, self._types, handle.batch_sizes)
        self._run: Any = getattr(handle, f"{program.name}_run_batch")
        self._run.restype = ctypes.c_long

    @property
    def parameters(self) -> dict[str, NDArray[np.float64]]:
        """The scene's parameters by name, as a start for drawing others: shape () or (stations,)."""
        return {v.name: np.asarray(v.default, dtype=float) for v in self.program.parameters}

    def simulate(
        self,
        duration: float,
        inputs: Mapping[str, Signal] | None = None,
        params: Mapping[str, ArrayLike] | None = None,
        step: float | None = None,
        *,
        arms: int | None = None,
        every: int = 1,
        threads: int | None = None,
        **given: ArrayLike,
    ) -> BatchRun:
        """Simulate all arms from time zero in whole steps.

        Parameters
        ----------
        duration : float
            Time to simulate (s); the last instant is the last whole step within it.
        inputs : mapping from str, optional
            What acts: a number, an array of shape (arms,), one of shape (steps, arms) or (steps, 1) held over each
            step, or a function of time (s) that gives one of the first two. Inputs not named are zero, but rate and
            acceleration of a prescribed angle that is a function are its derivatives.
        params : mapping from str, optional
            Parameters that differ from the scene's: a number or an array of shape (arms,); those with one value per
            station: a number or an array of shape (stations,), the same for all arms, (1, arms) or (stations, arms).
        step : float, optional
            Time step (s), by default the scene's.
        arms : int, optional
            How many; by default as many as some array has.
        every : int
            Outputs are kept at the start and after each so many steps.
        threads : int, optional
            That share the work; by default as many as this process has processors.
        **given : array_like
            ``initial_angle`` and ``initial_rate``, where they differ from the scene's, of shape (stations,) or
            (stations, arms).

        Returns
        -------
        BatchRun
            Instants, outputs, and what became of each arm: one that is refused does not stop the others.

        Raises
        ------
        ValueError
            If a name is unknown, a shape does not fit, or a number is out of its range.
        """
        step = float(self.program.step.default) if step is None else float(step)  # type: ignore[arg-type]
        if not (0.0 <= duration < np.inf and 0.0 < step < np.inf):
            raise ValueError(f"duration and step must be times, not {duration!r} and {step!r}")
        every = whole("every", every)
        threads = processors() if threads is None else whole("threads", threads)
        program, values = self.program, {**(params or {}), **given}
        signals = with_derivatives(program, dict(inputs or {}), step)
        require_known(signals, program.inputs, "inputs")
        require_known(params or {}, program.parameters, "parameters")
        require_known(given, program.given, "arguments of the start")
        steps = int(np.floor(duration / step * (1.0 + 1e-12)))
        series = {
            name: sampled(program, name, signal, steps, step, self._real) for name, signal in signals.items()
        }
        count = arm_count(arms, (*program.parameters, *program.given), values, series)
        first = {name: at_start(name, signals[name], array, count) for name, array in series.items()}
        models, states, status = self._started(count, values, step, first)
        lost = status.copy()
        kept = np.full((steps // every + 1, len(program.outputs), count), np.nan, dtype=self._real)
        if not lost.all():
            sound = int(np.argmin(lost != 0))  # what could not start has another's place, and its outputs go
            models[lost != 0], states[lost != 0] = models[sound], states[sound]
            self._advance(steps, every, models, states, series, kept, status, threads)
            status = np.where(lost != 0, lost, status)
            kept[..., lost != 0] = np.nan
        outputs = {v.name: kept[:, index] for index, v in enumerate(program.outputs)}
        return BatchRun(np.arange(kept.shape[0]) * (every * step), outputs, status)

    def _started(
        self, arms: int, values: Mapping[str, ArrayLike], step: float, first: Mapping[str, Numbers]
    ) -> tuple[NDArray[np.uint8], NDArray[np.uint8], NDArray[np.intc]]:
        """Return models, states and statuses of arms that are prepared and started."""
        default = self._types["params"]()
        self._handle.batch_defaults(ctypes.byref(default))
        params = np.tile(np.frombuffer(bytes(default), dtype=self._real), (arms, 1))
        for variable, place in columns(self._structs["params"]):
            if variable.name in values:
                params[:, place] = self._of_arms(variable, values, arms)
        inputs = np.zeros((arms, ctypes.sizeof(self._types["inputs"])), np.uint8).view(self._real)
        for variable, place in columns(self._structs["inputs"]):
            if variable.name in first:
                inputs[:, place] = first[variable.name][:, None]
        starts = [
            np.ascontiguousarray(self._of_arms(v, values, arms)) if v.name in values else None
            for v in self.program.given
        ]
        models, states = (
            np.zeros((arms, ctypes.sizeof(self._types[which])), np.uint8) for which in ("model", "state")
        )
        status = np.zeros(arms, dtype=np.intc)
        number: Any = ctypes.c_float if self._real is np.float32 else ctypes.c_double
        self._handle.batch_start(
            ctypes.c_long(arms),
            _pointer(params),
            number(step),
            *(None if start is None else _pointer(start) for start in starts),
            *map(_pointer, (inputs, models, states, status)),
        )
        return models, states, status

    def _of_arms(self, variable: Variable, values: Mapping[str, ArrayLike], arms: int) -> Numbers:
        """Return a parameter or a start in the kernel's numbers, shape (arms, length)."""
        return numbers(variable.name, by_arm(variable, values[variable.name], arms), self._real)

    def _advance(
        self,
        steps: int,
        every: int,
        models: NDArray[np.uint8],
        states: NDArray[np.uint8],
        series: Mapping[str, Numbers],
        kept: Numbers,
        status: NDArray[np.intc],
        threads: int,
    ) -> None:
        """Take the steps, each thread some of the arms."""
        signals = signal_structs(self.program, series)

        def run(share: tuple[int, int]) -> None:
            numbers = map(ctypes.c_long, (status.size, *share, steps, every))
            arrays = (_pointer(models), _pointer(states), *signals, _pointer(kept), _pointer(status))
            self._run(*numbers, *arrays)

        with ThreadPoolExecutor(threads) as pool:
            list(pool.map(run, shares(status.size, threads)))


def _pointer(array: NDArray[Any]) -> ctypes.c_void_p:
    return ctypes.c_void_p(array.ctypes.data)
